#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "candela/io/gltf_accessor.hpp"
#include "candela/io/gltf_pose.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

/// Where in the key times `time` falls: keys i and i + 1, and how far between them.
struct KeySpan {
    std::size_t first = 0;
    std::size_t second = 0;
    float blend = 0.0f;
    float seconds = 0.0f;
};

KeySpan find_keys(const std::vector<float>& times, float time) {
    if (time <= times.front()) return {0, 0, 0.0f, 0.0f};
    if (time >= times.back()) return {times.size() - 1, times.size() - 1, 0.0f, 0.0f};
    const auto upper = std::upper_bound(times.begin(), times.end(), time);
    const auto second = static_cast<std::size_t>(upper - times.begin());
    const float span = times[second] - times[second - 1];
    return {second - 1, second, span > 0.0f ? (time - times[second - 1]) / span : 0.0f, span};
}

glm::quat to_quat(const std::vector<float>& v) {
    const glm::quat q(v[3], v[0], v[1], v[2]);
    const float length = glm::length(q);
    return length > 1e-12f ? q / length : glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
}

/// One animation sampler: `width` numbers a key (three times as many with CUBICSPLINE: in-tangent, value,
/// out-tangent).
class AnimationSampler {
  public:
    AnimationSampler(const GltfDocument& document, const JsonView& sampler) {
        const std::size_t accessors = document.count("accessors");
        AccessorData input = read_accessor(document, sampler["input"].required_index_below(accessors));
        if (input.components != 1) sampler["input"].fail("key times must be SCALAR");
        times_ = std::move(input.values);
        values_ = read_accessor(document, sampler["output"].required_index_below(accessors)).values;
        const std::string mode = sampler["interpolation"].one_of({"LINEAR", "STEP", "CUBICSPLINE"});
        cubic_ = mode == "CUBICSPLINE";
        step_ = mode == "STEP";
        if (times_.empty()) sampler["input"].fail("has no keys");
        // A NaN passes every comparison and would end the search for a key beyond the last.
        if (!std::all_of(times_.begin(), times_.end(), [](float t) { return std::isfinite(t); }))
            sampler["input"].fail("key times must be finite");
        width_ = values_.size() / times_.size() / (cubic_ ? 3 : 1);
        if (width_ == 0) sampler["output"].fail("has fewer values than keys");
        if (!std::is_sorted(times_.begin(), times_.end())) {
            sampler["input"].repaired("key times that do not ascend: the keys are sorted");
            sort_keys();
        }
    }

    [[nodiscard]] std::size_t width() const { return width_; }

    [[nodiscard]] std::vector<float> at(float time, bool rotation) const {
        const KeySpan keys = find_keys(times_, time);
        if (step_ || keys.first == keys.second) return key(keys.first, 1);
        const std::vector<float> a = key(keys.first, 1);
        const std::vector<float> b = key(keys.second, 1);
        if (!cubic_ && rotation && width_ == 4) {
            const glm::quat q = glm::slerp(to_quat(a), to_quat(b), keys.blend);
            return {q.x, q.y, q.z, q.w};
        }
        std::vector<float> out(width_);
        const float t = keys.blend;
        if (!cubic_) {
            for (std::size_t i = 0; i < width_; ++i) out[i] = a[i] + (b[i] - a[i]) * t;
            return out;
        }
        // Hermite spline, glTF 2.0 appendix C.5; tangents are per second.
        const std::vector<float> leave = key(keys.first, 2);
        const std::vector<float> arrive = key(keys.second, 0);
        const float t2 = t * t;
        const float t3 = t2 * t;
        for (std::size_t i = 0; i < width_; ++i) {
            out[i] = (2 * t3 - 3 * t2 + 1) * a[i] + keys.seconds * (t3 - 2 * t2 + t) * leave[i] +
                     (3 * t2 - 2 * t3) * b[i] + keys.seconds * (t3 - t2) * arrive[i];
        }
        return out;
    }

  private:
    void sort_keys() {
        std::vector<std::size_t> order(times_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return times_[a] < times_[b]; });
        const std::size_t row = width_ * (cubic_ ? 3 : 1);
        std::vector<float> times, values;
        for (const std::size_t i : order) {
            times.push_back(times_[i]);
            const auto first = values_.begin() + static_cast<std::ptrdiff_t>(i * row);
            values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(row));
        }
        times_ = std::move(times);
        values_ = std::move(values);
    }

    [[nodiscard]] std::vector<float> key(std::size_t index, std::size_t part) const {
        const std::size_t row = cubic_ ? index * 3 + part : index;
        const auto first = values_.begin() + static_cast<std::ptrdiff_t>(row * width_);
        return {first, first + static_cast<std::ptrdiff_t>(width_)};
    }

    std::vector<float> times_;
    std::vector<float> values_;
    std::size_t width_ = 0;
    bool cubic_ = false;
    bool step_ = false;
};

void animate_channel(const GltfDocument& document, const JsonView& animation, const JsonView& channel,
                     float time_s, std::vector<Node>& nodes) {
    const JsonView target = channel["target"];
    const auto node_index = target["node"].index_below(nodes.size());
    if (!node_index) return;
    const std::string path = target["path"].one_of({"translation", "rotation", "scale", "weights"}, false);
    if (path.empty()) return;
    const JsonView samplers = animation["samplers"];
    const AnimationSampler sampler(document,
                                   samplers[channel["sampler"].required_index_below(samplers.size())]);
    Node& node = nodes[*node_index];
    const std::vector<float> v = sampler.at(time_s, path == "rotation");
    const auto need = [&](std::size_t count) {
        if (v.size() != count) channel.fail("its sampler has the wrong number of values for " + path);
    };
    if (path == "translation") {
        need(3);
        node.translation = {v[0], v[1], v[2]};
    } else if (path == "scale") {
        need(3);
        node.scale = {v[0], v[1], v[2]};
    } else if (path == "rotation") {
        need(4);
        node.rotation = glm::dquat(to_quat(v));
    } else {
        node.weights = v;
    }
    if (path != "weights") node.matrix.reset();
}

/// The animation of this name, or of this number where none is called so.
std::size_t find_animation(const GltfDocument& document, const std::string& name) {
    std::string known;
    const std::size_t count = document.count("animations");
    for (std::size_t a = 0; a < count; ++a) {
        const std::string own = document.element("animations", a)["name"].string_or("");
        if (own == name) return a;
        known += (known.empty() ? "" : ", ") + (own.empty() ? std::to_string(a) : own);
    }
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error == std::errc{} && end == name.data() + name.size() && number < count) return number;
    throw input_error("no animation of this name: " + name, document.name(),
                      known.empty() ? "the scene has no animations" : "it has " + known);
}

}  // namespace

void animate(const GltfDocument& document, const GltfOptions& options, std::vector<Node>& nodes) {
    const std::size_t index = options.animation.empty() ? 0 : find_animation(document, options.animation);
    if (index >= document.count("animations")) return;
    const JsonView animation = document.element("animations", index);
    const JsonView channels = animation["channels"];
    for (std::size_t c = 0; c < channels.size(); ++c) {
        document.try_to_read(channels[c], "this channel does not move its node", [&] {
            animate_channel(document, animation, channels[c], options.time_s, nodes);
        });
    }
}

}  // namespace candela::io
