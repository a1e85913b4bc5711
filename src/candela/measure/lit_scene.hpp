#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "candela/measure/experiment.hpp"

/// Small pictures of a white floor and white balls in the light of one lamp, without shadows: technique
/// beside truth.
namespace candela::measure {

/// z is up, the floor is z = 0, metres.
struct LitScene {
    glm::dvec3 eye{0.0, -7.0, 3.2};
    glm::dvec3 target{0.0, 0.0, 0.6};
    double field_of_view_rad = 0.75;                                             ///< across the width
    std::vector<glm::dvec4> balls{{-1.6, 0.2, 0.5, 0.5}, {1.6, 0.2, 0.5, 0.5}};  ///< centres and radii
    /// Distance along a ray to the lamp, infinite where it is not met; it is drawn white. Empty: not drawn.
    std::function<double(const glm::dvec3& origin, const glm::dvec3& direction)> lamp;
    std::uint32_t width = 240;
    std::uint32_t height = 150;
};

/// Illuminance, in any unit, at a point with this normal.
using Illuminance = std::function<double(const glm::dvec3& normal, const glm::dvec3& position)>;
/// Linear display value of a point; black around everything.
using ShadePoint = std::function<glm::vec3(const glm::dvec3& normal, const glm::dvec3& position)>;

[[nodiscard]] Panel render(const LitScene& scene, const ShadePoint& shade);
/// With `white` as the illuminance that a diffuse white surface needs to reach display white; a filmic
/// shoulder above.
[[nodiscard]] Panel render(const LitScene& scene, const Illuminance& illuminance, double white);

/// Left to right, on white; all of one height.
[[nodiscard]] Panel beside(const std::vector<Panel>& pictures, std::string title, std::string caption);

struct LabelledIlluminance {
    std::string label;
    Illuminance illuminance;
    double flip_at_most = 0.0;
};

/// Adds a picture of these techniques and the truth, in this order, and the mean FLIP of each, as a number
/// and in a table.
void add_lit_figure(Findings& out, const LitScene& scene, const std::string& title,
                    const std::vector<LabelledIlluminance>& techniques, const Illuminance& truth,
                    double white);

/// The lamps for LitScene::lamp.
[[nodiscard]] double ray_to_sphere(const glm::dvec3& origin, const glm::dvec3& direction,
                                   const glm::dvec3& center, double radius);
[[nodiscard]] double ray_to_disk(const glm::dvec3& origin, const glm::dvec3& direction,
                                 const glm::dvec3& center, const glm::dvec3& normal, double radius);
[[nodiscard]] double ray_to_rectangle(const glm::dvec3& origin, const glm::dvec3& direction,
                                      const glm::dvec3& center, const glm::dvec3& half_right,
                                      const glm::dvec3& half_up);
[[nodiscard]] double ray_to_capsule(const glm::dvec3& origin, const glm::dvec3& direction,
                                    const glm::dvec3& center, const glm::dvec3& axis, double half_length,
                                    double radius);

}  // namespace candela::measure
