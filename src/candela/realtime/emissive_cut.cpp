#include "candela/realtime/emissive_cut.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "candela/scene/environment_sources.hpp"
#include "shading/language.glsl"

namespace candela::realtime {
namespace {

constexpr double kMaxReceivers = 16384.0;
constexpr std::size_t kMaxSources = 64;

/// A triangle that may be lit, in world space.
struct Receiver {
    std::array<glm::vec3, 3> corners;
    glm::vec3 normal;
    bool two_sided = false;
};

/// A small emitter: a piece, or one that stands for several.
struct Source {
    glm::vec3 position;
    glm::vec3 normal;
    float area_m2 = 0.0f;
    float nit = 0.0f;
    bool two_sided = false;
};

/// In [0,1), even over any run of indices. By the golden ratio: a fixed stride over a regular mesh would find
/// the same column of every row.
double even_fraction(std::size_t i) {
    const double turn = 0.6180339887498949 * static_cast<double>(i);
    return turn - std::floor(turn);
}

template <class Visit>
void visit_triangles(const scene::Scene& scene, Visit&& visit) {
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& p : scene.meshes[instance.mesh].primitives) {
            const scene::Material& material = scene.materials[p.material];
            if (material.unlit) continue;
            const bool mirrored = glm::determinant(glm::mat3(instance.world)) < 0.0f;
            for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
                Receiver r;
                for (std::size_t c = 0; c < 3; ++c)
                    r.corners[c] = glm::vec3(instance.world * glm::vec4(p.positions[p.indices[i + c]], 1.0f));
                if (mirrored) std::swap(r.corners[1], r.corners[2]);
                r.two_sided = material.double_sided;
                const glm::vec3 twice_area =
                    glm::cross(r.corners[1] - r.corners[0], r.corners[2] - r.corners[0]);
                const float length = glm::length(twice_area);
                if (!(length > 0.0f)) continue;
                r.normal = twice_area / length;
                visit(r, 0.5 * double{length}, i / 3);
            }
        }
    }
}

/// Every triangle that is large, and of the small ones as many as there is capacity for, spread evenly.
std::vector<Receiver> receivers_of(const scene::Scene& scene) {
    double total_m2 = 0.0;
    double triangles = 0.0;
    visit_triangles(scene, [&](const Receiver&, double area_m2, std::size_t) {
        total_m2 += area_m2;
        triangles += 1.0;
    });
    const double large_m2 = total_m2 / (0.5 * kMaxReceivers);
    const double fraction = triangles > kMaxReceivers ? 0.5 * kMaxReceivers / triangles : 1.0;
    std::vector<Receiver> out;
    visit_triangles(scene, [&](const Receiver& r, double area_m2, std::size_t index) {
        if (area_m2 >= large_m2 || even_fraction(index) < fraction) out.push_back(r);
    });
    return out;
}

std::vector<Source> sources_of(const EmissiveGroup& group) {
    const std::size_t size = group.pieces.size();
    const std::size_t count = std::min(size, kMaxSources);
    const auto sampled = [&](std::size_t i) {
        return count == size ? i : static_cast<std::size_t>(even_fraction(i) * static_cast<double>(size));
    };
    std::vector<Source> out;
    float area_m2 = 0.0f;
    for (std::size_t i = 0; i < count; ++i) {
        const EmissivePiece& piece = group.pieces[sampled(i)];
        const glm::vec3 vector = piece.vector_area();
        Source s{piece.centroid(), glm::normalize(vector), glm::length(vector), shading::luminance(piece.nit),
                 piece.two_sided};
        area_m2 += s.area_m2 * (s.two_sided ? 2.0f : 1.0f);
        out.push_back(s);
    }
    // Those that were left out are in the areas of the others.
    for (Source& s : out) s.area_m2 *= group.area_m2 / area_m2;
    return out;
}

/// Ericson 2005, "Real-Time Collision Detection", section 5.1.5, by barycentric regions.
glm::vec3 closest_point(const Receiver& t, const glm::vec3& p) {
    const auto on_edge = [&](const glm::vec3& a, const glm::vec3& b) {
        const glm::vec3 ab = b - a;
        return a + ab * std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0f, 1.0f);
    };
    const glm::vec3 foot = p - t.normal * glm::dot(p - t.corners[0], t.normal);
    glm::vec3 nearest = foot;
    float nearest2 = std::numeric_limits<float>::infinity();
    const glm::vec3 turn = glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
    bool inside = true;
    for (std::size_t c = 0; c < 3; ++c) {
        const glm::vec3& a = t.corners[c];
        const glm::vec3& b = t.corners[(c + 1) % 3];
        if (glm::dot(glm::cross(b - a, foot - a), turn) >= 0.0f) continue;
        inside = false;
        const glm::vec3 q = on_edge(a, b);
        const glm::vec3 d = q - p;
        if (glm::dot(d, d) >= nearest2) continue;
        nearest2 = glm::dot(d, d);
        nearest = q;
    }
    return inside ? foot : nearest;
}

/// Of all sources at a point, without occlusion. The disk's form factor on its axis bounds what is near.
float illuminance_lx(const std::vector<Source>& sources, const glm::vec3& point, const Receiver& r) {
    float sum = 0.0f;
    for (const Source& s : sources) {
        const glm::vec3 to_source = s.position - point;
        const float distance2 = glm::dot(to_source, to_source);
        if (!(distance2 > 0.0f)) continue;
        const float inverse = 1.0f / std::sqrt(distance2);
        float at_receiver = glm::dot(r.normal, to_source) * inverse;
        float at_source = -glm::dot(s.normal, to_source) * inverse;
        if (r.two_sided) at_receiver = std::abs(at_receiver);
        if (s.two_sided) at_source = std::abs(at_source);
        if (at_receiver <= 0.0f || at_source <= 0.0f) continue;
        sum += s.nit * s.area_m2 * at_receiver * at_source / (distance2 + s.area_m2 / shading::PI);
    }
    return sum;
}

float max_illuminance_lx(const EmissiveGroup& group, const std::vector<Receiver>& receivers) {
    const std::vector<Source> sources = sources_of(group);
    float largest = 0.0f;
    for (const Receiver& r : receivers) {
        const glm::vec3 middle = (r.corners[0] + r.corners[1] + r.corners[2]) / 3.0f;
        largest = std::max({largest, illuminance_lx(sources, closest_point(r, group.center), r),
                            illuminance_lx(sources, middle, r)});
    }
    return largest;
}

}  // namespace

std::vector<bool> emitters_that_matter(const scene::Scene& scene, const std::vector<EmissiveGroup>& groups) {
    std::vector<bool> matters(groups.size(), true);
    if (!scene.environment || scene.environment->luminance_nit.empty() || !scene.irradiance_volumes.empty())
        return matters;
    const double mean_nit = shading::luminance(scene::mean_nit(*scene.environment));
    float left_lx = kCutFraction * static_cast<float>(M_PI * mean_nit);
    if (!(left_lx > 0.0f)) return matters;
    const std::vector<Receiver> receivers = receivers_of(scene);
    std::vector<float> lx;
    for (const EmissiveGroup& group : groups) lx.push_back(max_illuminance_lx(group, receivers));
    std::vector<std::size_t> order(groups.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return lx[a] < lx[b]; });
    for (const std::size_t i : order) {
        if (lx[i] > left_lx) break;
        left_lx -= lx[i];
        matters[i] = false;
    }
    return matters;
}

}  // namespace candela::realtime
