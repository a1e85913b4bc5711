#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

/// The reflection of area lights by GGX, honestly integrated: the truth for linearly transformed cosines and
/// representative points. Everything is in the surface's frame: z along the normal, the receiver at the
/// origin.
namespace candela::measure {

enum class LightShape : int { sphere, disk, rectangle, tube };

/// One light of uniform luminance, in m.
struct ShapedLight {
    LightShape shape = LightShape::sphere;
    glm::vec3 center{0.0f, 0.0f, 1.0f};
    glm::vec3 right{1.0f, 0.0f, 0.0f};  ///< unit; a tube's axis
    glm::vec3 up{0.0f, 1.0f, 0.0f};  ///< unit; right x up points away from where a disk or a rectangle shines
    float half_width = 0.5f;         ///< half length of a tube; not used by sphere and disk
    float half_height = 0.5f;        ///< not used by sphere, disk and tube
    float radius = 0.5f;             ///< of sphere, disk and tube

    [[nodiscard]] glm::vec3 direction() const { return -glm::cross(right, up); }
};

/// Nearest point that shines on the receiver in the direction l (unit), and its share of solid angle: m^2 per
/// sr; 0 for a miss.
[[nodiscard]] double square_metres_per_steradian(const ShapedLight& light, const glm::vec3& l);

/// The receiver is inside the light or touches it.
[[nodiscard]] bool contains_receiver(const ShapedLight& light);

/// D V cos over a light, divided by the lobe's directional albedo, so that a light all around gives 1.
struct SpecularIntegral {
    double value = 0.0;
    double noise = 0.0;  ///< half the difference of two estimates by half of the samples each
};

/// Directional albedo of D V cos by a fine quadrature.
[[nodiscard]] float specular_albedo(float NoV, float alpha);

/// A view: v = (-sin, 0, cos). Visible normals and points of the light, weighted by the balance heuristic;
/// both from a low-discrepancy sequence, the same ones for all lights.
class SpecularTruth {
  public:
    /// albedo: of the lobe, that `integrate` divides by.
    SpecularTruth(float NoV, float alpha, float albedo, int lobe_samples, int light_samples);

    [[nodiscard]] SpecularIntegral integrate(const ShapedLight& light) const;
    [[nodiscard]] float albedo() const { return albedo_; }
    [[nodiscard]] const glm::vec3& view() const { return v_; }

  private:
    struct LobeSample {
        glm::vec3 l;
        double density;  ///< D V cos, 1/sr
        double pdf;
    };
    [[nodiscard]] double lobe(const glm::vec3& l) const;
    [[nodiscard]] double pdf(const glm::vec3& l) const;

    glm::vec3 v_;
    float alpha_;
    float albedo_;
    int lobe_count_;
    int light_count_;
    std::vector<LobeSample> lobe_;
};

}  // namespace candela::measure
