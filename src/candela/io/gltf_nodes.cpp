#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "candela/io/gltf_accessor.hpp"
#include "candela/io/gltf_pose.hpp"

namespace candela::io {
namespace {

Node read_node(const GltfDocument& document, std::uint32_t index) {
    const JsonView source = document.element("nodes", index);
    Node node;
    node.name = source["name"].string_or("");
    const JsonView children = source["children"];
    for (std::size_t i = 0; i < children.size(); ++i) {
        node.children.push_back(children[i].required_index_below(document.count("nodes")));
    }
    std::array<double, 3> three{};
    std::array<double, 4> four{};
    std::array<double, 16> sixteen{};
    if (source["translation"].doubles(three)) node.translation = {three[0], three[1], three[2]};
    if (source["scale"].doubles(three)) node.scale = {three[0], three[1], three[2]};
    if (source["rotation"].doubles(four)) {
        const glm::dquat q(four[3], four[0], four[1], four[2]);
        const double length = glm::length(q);
        node.rotation = length > 1e-12 ? q / length : glm::dquat(1.0, 0.0, 0.0, 0.0);
    }
    if (source["matrix"].doubles(sixteen)) {
        glm::dmat4 m;
        for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = sixteen[static_cast<std::size_t>(i)];
        node.matrix = m;
    }
    node.weights.resize(source["weights"].size());
    source["weights"].floats(node.weights);
    return node;
}

void check_forest(const GltfDocument& document, const std::vector<Node>& nodes) {
    std::vector<std::uint32_t> parents(nodes.size(), scene::no_index);
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        for (const std::uint32_t child : nodes[i].children) {
            if (parents[child] != scene::no_index || child == i) {
                document.element("nodes", i)["children"].fail("node " + std::to_string(child) +
                                                              " has more than one parent");
            }
            parents[child] = i;
        }
    }
    // With one parent each, a cycle is what no root leads to: walking up must end.
    std::vector<std::uint8_t> done(nodes.size(), 0);
    for (std::uint32_t start = 0; start < nodes.size(); ++start) {
        std::vector<std::uint32_t> path;
        std::uint32_t at = start;
        while (at != scene::no_index && done[at] == 0) {
            done[at] = 1;
            path.push_back(at);
            at = parents[at];
        }
        if (at != scene::no_index && done[at] == 1)
            document.element("nodes", at).fail("is its own ancestor: the nodes form a cycle");
        for (const std::uint32_t i : path) done[i] = 2;
    }
}

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
    AnimationSampler(const GltfDocument& document, const JsonView& sampler) : where_(sampler.where()) {
        const std::size_t accessors = document.count("accessors");
        AccessorData input = read_accessor(document, sampler["input"].required_index_below(accessors));
        if (input.components != 1) sampler["input"].fail("key times must be SCALAR");
        times_ = std::move(input.values);
        values_ = read_accessor(document, sampler["output"].required_index_below(accessors)).values;
        const std::string mode = sampler["interpolation"].string_or("LINEAR");
        cubic_ = mode == "CUBICSPLINE";
        step_ = mode == "STEP";
        if (!cubic_ && !step_ && mode != "LINEAR")
            sampler["interpolation"].fail("must be LINEAR, STEP or CUBICSPLINE");
        if (times_.empty()) sampler["input"].fail("has no keys");
        // A NaN passes every comparison and would end the search for a key beyond the last.
        if (!std::all_of(times_.begin(), times_.end(), [](float t) { return std::isfinite(t); }))
            sampler["input"].fail("key times must be finite");
        if (!std::is_sorted(times_.begin(), times_.end()))
            sampler["input"].fail("key times must not decrease");
        width_ = values_.size() / times_.size() / (cubic_ ? 3 : 1);
        if (width_ == 0) sampler["output"].fail("has fewer values than keys");
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
    [[nodiscard]] std::vector<float> key(std::size_t index, std::size_t part) const {
        const std::size_t row = cubic_ ? index * 3 + part : index;
        const auto first = values_.begin() + static_cast<std::ptrdiff_t>(row * width_);
        return {first, first + static_cast<std::ptrdiff_t>(width_)};
    }

    std::string where_;
    std::vector<float> times_;
    std::vector<float> values_;
    std::size_t width_ = 0;
    bool cubic_ = false;
    bool step_ = false;
};

void animate_channel(const GltfDocument& document, const JsonView& animation, const JsonView& channel,
                     float time_s, std::vector<Node>& nodes, Diagnostics& diagnostics) {
    const JsonView target = channel["target"];
    const auto node_index = target["node"].index_below(nodes.size());
    if (!node_index) return;
    const JsonView samplers = animation["samplers"];
    const AnimationSampler sampler(document,
                                   samplers[channel["sampler"].required_index_below(samplers.size())]);
    const std::string path = target["path"].string_or("");
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
    } else if (path == "weights") {
        node.weights = v;
    } else {
        diagnostics.warn(
            "an animation of something other than translation, rotation, scale or weights: skipped");
        return;
    }
    if (path != "weights") node.matrix.reset();
}

glm::dmat4 local_matrix(const Node& node) {
    if (node.matrix) return *node.matrix;
    return glm::translate(glm::dmat4(1.0), node.translation) * glm::mat4_cast(node.rotation) *
           glm::scale(glm::dmat4(1.0), node.scale);
}

/// Explicit stack: a chain of a million nodes must not end in the machine's.
void place(std::vector<Node>& nodes, std::uint32_t root, bool reachable) {
    std::vector<std::pair<std::uint32_t, glm::dmat4>> stack{{root, glm::dmat4(1.0)}};
    while (!stack.empty()) {
        const auto [index, parent] = stack.back();
        stack.pop_back();
        Node& node = nodes[index];
        node.placed = parent * local_matrix(node);
        node.world = glm::mat4(node.placed);
        node.reachable = reachable;
        for (const std::uint32_t child : node.children) stack.emplace_back(child, node.placed);
    }
}

}  // namespace

std::vector<Node> read_posed_nodes(const GltfDocument& document, float time_s, Diagnostics& diagnostics) {
    std::vector<Node> nodes;
    for (std::uint32_t i = 0; i < document.count("nodes"); ++i) nodes.push_back(read_node(document, i));
    check_forest(document, nodes);
    for (std::size_t a = 0; a < document.count("animations"); ++a) {
        const JsonView animation = document.element("animations", a);
        const JsonView channels = animation["channels"];
        for (std::size_t c = 0; c < channels.size(); ++c) {
            animate_channel(document, animation, channels[c], time_s, nodes, diagnostics);
        }
    }

    std::vector<bool> is_child(nodes.size(), false);
    for (const Node& node : nodes) {
        for (const std::uint32_t child : node.children) is_child[child] = true;
    }
    const bool has_scenes = document.count("scenes") > 0;
    // Nodes outside the scene are placed too: they may be joints.
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        if (!is_child[i]) place(nodes, i, !has_scenes);
    }
    if (has_scenes) {
        const std::uint32_t scene =
            document.root()["scene"].index_below(document.count("scenes")).value_or(0);
        const JsonView roots = document.element("scenes", scene)["nodes"];
        for (std::size_t r = 0; r < roots.size(); ++r) {
            const std::uint32_t root = roots[r].required_index_below(nodes.size());
            if (is_child[root])
                roots[r].fail("a scene lists roots, and node " + std::to_string(root) + " has a parent");
            if (nodes[root].reachable)
                roots[r].fail("the scene lists node " + std::to_string(root) + " twice");
            place(nodes, root, true);
        }
    }
    return nodes;
}

std::vector<glm::dmat4> joint_matrices(const GltfDocument& document, std::uint32_t skin,
                                       const std::vector<Node>& nodes) {
    const JsonView source = document.element("skins", skin);
    const JsonView joints = source["joints"];
    std::vector<glm::mat4> inverse_bind(joints.size(), glm::mat4(1.0f));
    if (const auto accessor = source["inverseBindMatrices"].index_below(document.count("accessors"))) {
        const auto read = as_mat4(read_accessor(document, *accessor), source["inverseBindMatrices"].where());
        if (read.size() < inverse_bind.size())
            source["inverseBindMatrices"].fail("has fewer matrices than the skin has joints");
        inverse_bind = read;
    }
    std::vector<glm::dmat4> out;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        out.push_back(nodes[joints[j].required_index_below(nodes.size())].placed *
                      glm::dmat4(inverse_bind[j]));
    }
    if (out.empty()) joints.fail("a skin needs joints");
    return out;
}

}  // namespace candela::io
