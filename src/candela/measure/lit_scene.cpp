#include "candela/measure/lit_scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "candela/measure/flip_panel.hpp"
#include "candela/measure/flip_rgb.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/tone_curves.glsl"
#include "shading/transfer.glsl"

namespace candela::measure {
namespace {

using glm::dvec3;

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kGap = 6;  ///< pixels between pictures
constexpr int kSide = 2;           ///< rays a pixel, to the square

/// White where the ray meets the lamp first, what `shade` says on floor and balls, black elsewhere.
glm::vec3 trace(const LitScene& scene, const dvec3& direction, const ShadePoint& shade) {
    double nearest = direction.z < 0.0 ? -scene.eye.z / direction.z : kFar;
    dvec3 normal(0.0, 0.0, 1.0);
    for (const glm::dvec4& ball : scene.balls) {
        const double t = ray_to_sphere(scene.eye, direction, dvec3(ball), ball.w);
        if (t >= nearest) continue;
        nearest = t;
        normal = glm::normalize(scene.eye + t * direction - dvec3(ball));
    }
    if (scene.lamp && scene.lamp(scene.eye, direction) < nearest) return glm::vec3(1.0f);
    if (nearest > 40.0) return glm::vec3(0.0f);
    return shade(normal, scene.eye + nearest * direction);
}

}  // namespace

Panel render(const LitScene& scene, const ShadePoint& shade) {
    const dvec3 forward = glm::normalize(scene.target - scene.eye);
    const dvec3 right = glm::normalize(glm::cross(forward, dvec3(0.0, 0.0, 1.0)));
    const dvec3 up = glm::cross(right, forward);
    const double scale = 2.0 * std::tan(0.5 * scene.field_of_view_rad) / scene.width;
    Panel out;
    out.width = scene.width;
    out.height = scene.height;
    for (std::uint32_t y = 0; y < scene.height; ++y) {
        for (std::uint32_t x = 0; x < scene.width; ++x) {
            glm::vec3 sum(0.0f);
            for (int sample = 0; sample < kSide * kSide; ++sample) {
                const double px = x + (sample % kSide + 0.5) / kSide - 0.5 * scene.width;
                const double py = 0.5 * scene.height - y - (sample / kSide + 0.5) / kSide;
                const dvec3 direction = glm::normalize(forward + scale * (px * right + py * up));
                sum += shading::saturate(trace(scene, direction, shade));
            }
            const glm::vec3 encoded = shading::srgb_from_linear(sum / float(kSide * kSide));
            for (int c = 0; c < 3; ++c) out.rgb.push_back(std::uint8_t(std::lround(255.0f * encoded[c])));
        }
    }
    return out;
}

Panel render(const LitScene& scene, const Illuminance& illuminance, double white) {
    return render(scene, [&](const dvec3& normal, const dvec3& position) {
        const auto exposed = float(illuminance(normal, position) / white);
        return shading::tone_curve(shading::kToneAces, glm::vec3(exposed));
    });
}

Panel beside(const std::vector<Panel>& pictures, std::string title, std::string caption) {
    Panel out{std::move(title), std::move(caption), 0, pictures.front().height, {}, 1};
    for (const Panel& p : pictures) out.width += p.width + (out.width > 0 ? kGap : 0);
    out.rgb.assign(std::size_t{3} * out.width * out.height, 255);
    std::size_t left = 0;
    for (const Panel& p : pictures) {
        for (std::size_t y = 0; y < p.height; ++y)
            std::copy_n(p.rgb.begin() + std::ptrdiff_t(3 * y * p.width), 3 * p.width,
                        out.rgb.begin() + std::ptrdiff_t(3 * (y * out.width + left)));
        left += p.width + kGap;
    }
    return out;
}

void add_lit_figure(Findings& out, const LitScene& scene, const std::string& title,
                    const std::vector<LabelledIlluminance>& techniques, const Illuminance& truth,
                    double white) {
    const Panel reference = render(scene, truth, white);
    std::vector<Panel> pictures;
    std::vector<Panel> flips;
    std::string caption = "From left: ";
    Table table{title + ": difference from the truth as seen", {"technique", "mean FLIP"}, {}};
    for (const LabelledIlluminance& t : techniques) {
        pictures.push_back(render(scene, t.illuminance, white));
        flips.push_back(flip_panel(pictures.back(), reference));
        const double flip =
            mean_flip_of_srgb(pictures.back().rgb, reference.rgb, reference.width, reference.height);
        out.measured.push_back(at_most(title + ", " + t.label + ": mean FLIP", flip, t.flip_at_most));
        table.rows.push_back({t.label, number(flip, 3)});
        caption += t.label + "; ";
    }
    pictures.push_back(reference);
    out.pictures.push_back(beside(pictures, title, caption + "truth."));
    out.pictures.push_back(
        beside(flips, title + ": FLIP", "Of each technique against the truth, black 0, pale yellow 1."));
    out.tables.push_back(std::move(table));
}

double ray_to_sphere(const dvec3& origin, const dvec3& direction, const dvec3& center, double radius) {
    const dvec3 to = center - origin;
    const double along = glm::dot(to, direction);
    const double discriminant = along * along - glm::dot(to, to) + radius * radius;
    if (discriminant < 0.0 || along < 0.0) return kFar;
    return along - std::sqrt(discriminant);
}

double ray_to_disk(const dvec3& origin, const dvec3& direction, const dvec3& center, const dvec3& normal,
                   double radius) {
    const double t = glm::dot(center - origin, normal) / glm::dot(direction, normal);
    if (!(t > 0.0)) return kFar;
    const dvec3 at = origin + t * direction - center;
    return glm::dot(at, at) <= radius * radius ? t : kFar;
}

double ray_to_rectangle(const dvec3& origin, const dvec3& direction, const dvec3& center,
                        const dvec3& half_right, const dvec3& half_up) {
    const dvec3 normal = glm::cross(half_right, half_up);
    const double t = glm::dot(center - origin, normal) / glm::dot(direction, normal);
    if (!(t > 0.0)) return kFar;
    const dvec3 at = origin + t * direction - center;
    const bool inside = std::abs(glm::dot(at, half_right)) <= glm::dot(half_right, half_right) &&
                        std::abs(glm::dot(at, half_up)) <= glm::dot(half_up, half_up);
    return inside ? t : kFar;
}

double ray_to_capsule(const dvec3& origin, const dvec3& direction, const dvec3& center, const dvec3& axis,
                      double half_length, double radius) {
    double nearest = std::min(ray_to_sphere(origin, direction, center - half_length * axis, radius),
                              ray_to_sphere(origin, direction, center + half_length * axis, radius));
    // The cylinder, seen along its axis.
    const dvec3 flat = direction - glm::dot(direction, axis) * axis;
    const dvec3 to = center - origin;
    const dvec3 flat_to = to - glm::dot(to, axis) * axis;
    const double a = glm::dot(flat, flat);
    const double b = glm::dot(flat, flat_to);
    const double discriminant = b * b - a * (glm::dot(flat_to, flat_to) - radius * radius);
    if (a <= 0.0 || discriminant < 0.0) return nearest;
    const double t = (b - std::sqrt(discriminant)) / a;
    if (t > 0.0 && std::abs(glm::dot(origin + t * direction - center, axis)) <= half_length)
        nearest = std::min(nearest, t);
    return nearest;
}

}  // namespace candela::measure
