#include "candela/scene/strokes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace candela::scene {
namespace {

/// How long half the stroke's width is at a point, and which way the camera looks at it.
class StrokeView {
  public:
    StrokeView(const Camera& camera, std::uint32_t width, std::uint32_t height, float width_px)
        : perspective_(camera.projection == Projection::perspective),
          eye_(camera.world[3]),
          right_(camera.world[0]),
          up_(camera.world[1]),
          forward_(-camera.world[2]),
          nearest_m_(camera.znear_m) {
        const glm::mat4 m = view_projection(camera, static_cast<float>(width) / static_cast<float>(height));
        // A step to the right by 1 m at a clip-space w of 1, in units of half the picture's width.
        const float step = std::abs(glm::dot(glm::vec3(m[0][0], m[1][0], m[2][0]), right_));
        half_width_per_w_ = width_px / (static_cast<float>(width) * std::max(step, 1e-30f));
    }

    [[nodiscard]] float depth_m(const glm::vec3& p) const { return glm::dot(p - eye_, forward_); }
    [[nodiscard]] bool perspective() const noexcept { return perspective_; }
    [[nodiscard]] float nearest_m() const noexcept { return nearest_m_; }
    /// Behind the camera as wide as at the same distance before it.
    [[nodiscard]] float half_width_m(const glm::vec3& p) const {
        return half_width_per_w_ * (perspective_ ? std::max(std::abs(depth_m(p)), nearest_m_) : 1.0f);
    }
    [[nodiscard]] glm::vec3 to_camera(const glm::vec3& p) const {
        const glm::vec3 way = eye_ - p;
        return perspective_ && glm::dot(way, way) > 0.0f ? glm::normalize(way) : -forward_;
    }
    /// Unit, across the segment as the camera sees it.
    [[nodiscard]] glm::vec3 across(const glm::vec3& a, const glm::vec3& b, const glm::vec3& at) const {
        const glm::vec3 side = glm::cross(b - a, to_camera(at));
        const float length = glm::length(side);
        return length > 1e-12f * glm::length(b - a) && std::isfinite(length) ? side / length : right_;
    }
    [[nodiscard]] const glm::vec3& right() const noexcept { return right_; }
    [[nodiscard]] const glm::vec3& up() const noexcept { return up_; }

  private:
    bool perspective_;
    glm::vec3 eye_;
    glm::vec3 right_;
    glm::vec3 up_;
    glm::vec3 forward_;
    float nearest_m_;
    float half_width_per_w_ = 0.0f;
};

/// A vertex of a stroke in world space, with the attributes that it has.
struct End {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
    std::array<glm::vec2, 2> uv{};
    glm::vec4 color{1.0f};
};

End mix(const End& a, const End& b, float t) {
    End out;
    out.position = glm::mix(a.position, b.position, t);
    const glm::vec3 normal = glm::mix(a.normal, b.normal, t);
    out.normal = glm::dot(normal, normal) > 0.0f ? glm::normalize(normal) : a.normal;
    for (std::size_t set = 0; set < out.uv.size(); ++set) out.uv[set] = glm::mix(a.uv[set], b.uv[set], t);
    out.color = glm::mix(a.color, b.color, t);
    return out;
}

class Widener {
  public:
    Widener(const Primitive& source, const glm::mat4& world, const StrokeView& view)
        : source_(&source), world_(world), view_(&view) {
        const glm::mat3 m(world);
        cofactors_ = glm::mat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
        out_.material = source.material;
    }

    void add_point(std::uint32_t index) {
        const End p = end(index);
        const float half_m = view_->half_width_m(p.position);
        const glm::vec3 x = half_m * view_->right();
        const glm::vec3 y = half_m * view_->up();
        add_quad({p, p, p, p}, {-x - y, x - y, x + y, y - x});
    }

    void add_segment(std::uint32_t first, std::uint32_t second) {
        const End a = end(first);
        const End b = end(second);
        const float depth_a = view_->depth_m(a.position);
        const float depth_b = view_->depth_m(b.position);
        const float plane = view_->nearest_m();
        // The width is linear in depth on either side of the camera's plane only.
        if (view_->perspective() && (depth_a < plane) != (depth_b < plane)) {
            const End middle = mix(a, b, std::clamp((plane - depth_a) / (depth_b - depth_a), 0.0f, 1.0f));
            add_ribbon(a, middle);
            add_ribbon(middle, b);
        } else {
            add_ribbon(a, b);
        }
    }

    [[nodiscard]] Primitive take() {
        for (const glm::vec3& p : out_.positions) out_.bounds.extend(p);
        return std::move(out_);
    }

  private:
    [[nodiscard]] End end(std::uint32_t i) const {
        End e;
        e.position = glm::vec3(world_ * glm::vec4(source_->positions[i], 1.0f));
        if (!source_->normals.empty()) {
            const glm::vec3 n = cofactors_ * source_->normals[i];
            e.normal = glm::dot(n, n) > 0.0f ? glm::normalize(n) : glm::vec3(0.0f);
        }
        for (std::size_t set = 0; set < e.uv.size(); ++set)
            if (!source_->uv[set].empty()) e.uv[set] = source_->uv[set][i];
        if (!source_->colors.empty()) e.color = source_->colors[i];
        return e;
    }

    void add_ribbon(const End& a, const End& b) {
        const glm::vec3 side = view_->across(a.position, b.position, 0.5f * (a.position + b.position));
        const glm::vec3 at_a = side * view_->half_width_m(a.position);
        const glm::vec3 at_b = side * view_->half_width_m(b.position);
        add_quad({a, b, b, a}, {at_a, at_b, -at_b, -at_a});
    }

    /// Counter-clockwise seen from the camera.
    void add_quad(const std::array<End, 4>& ends, const std::array<glm::vec3, 4>& offsets) {
        const auto first = static_cast<std::uint32_t>(out_.positions.size());
        for (std::size_t c = 0; c < 4; ++c) {
            const End& e = ends[c];
            out_.positions.push_back(e.position + offsets[c]);
            const bool own_normal = glm::dot(e.normal, e.normal) > 0.0f;
            out_.normals.push_back(own_normal ? e.normal : view_->to_camera(e.position));
            for (std::size_t set = 0; set < e.uv.size(); ++set)
                if (!source_->uv[set].empty()) out_.uv[set].push_back(e.uv[set]);
            if (!source_->colors.empty()) out_.colors.push_back(e.color);
        }
        const glm::vec3 turn = glm::cross(out_.positions[first + 1] - out_.positions[first],
                                          out_.positions[first + 2] - out_.positions[first]);
        const bool faces = glm::dot(turn, view_->to_camera(ends[0].position)) >= 0.0f;
        for (const std::uint32_t i :
             {0u, faces ? 1u : 2u, faces ? 2u : 1u, 0u, faces ? 2u : 3u, faces ? 3u : 2u})
            out_.indices.push_back(first + i);
    }

    const Primitive* source_;
    glm::mat4 world_;
    glm::mat3 cofactors_{1.0f};
    const StrokeView* view_;
    Primitive out_;
};

Primitive widen(const Stroke& stroke, const glm::mat4& world, const StrokeView& view) {
    Widener widener(stroke.geometry, world, view);
    const std::vector<std::uint32_t>& indices = stroke.geometry.indices;
    if (stroke.kind == StrokeKind::points) {
        for (const std::uint32_t i : indices) widener.add_point(i);
    } else {
        for (std::size_t i = 0; i + 1 < indices.size(); i += 2)
            widener.add_segment(indices[i], indices[i + 1]);
    }
    return widener.take();
}

}  // namespace

StrokeCount count_strokes(const Scene& scene) {
    StrokeCount count;
    for (const Instance& instance : scene.instances) {
        for (const Stroke& stroke : scene.meshes[instance.mesh].strokes) {
            if (stroke.kind == StrokeKind::points) {
                count.points += stroke.geometry.indices.size();
            } else {
                count.segments += stroke.geometry.indices.size() / 2;
            }
        }
    }
    return count;
}

void widen_strokes(Scene& scene, const Camera& camera, std::uint32_t width, std::uint32_t height,
                   float width_px) {
    const StrokeView view(camera, width, height, width_px);
    const std::size_t instances = scene.instances.size();
    for (std::size_t i = 0; i < instances; ++i) {
        const Instance instance = scene.instances[i];
        if (scene.meshes[instance.mesh].strokes.empty()) continue;
        Mesh mesh;
        mesh.name = scene.meshes[instance.mesh].name;
        for (const Stroke& stroke : scene.meshes[instance.mesh].strokes) {
            Primitive p = widen(stroke, instance.world, view);
            if (!p.indices.empty()) mesh.primitives.push_back(std::move(p));
        }
        scene.instances.push_back(
            {instance.name, static_cast<std::uint32_t>(scene.meshes.size()), glm::mat4(1.0f)});
        scene.meshes.push_back(std::move(mesh));
    }
    for (Mesh& mesh : scene.meshes) mesh.strokes.clear();
}

}  // namespace candela::scene
