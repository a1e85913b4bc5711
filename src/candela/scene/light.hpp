#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <string>

#include "candela/scene/index.hpp"

namespace candela::scene {

/// Every kind of light that has a place of its own. The numbers are those of realtime/shaders/lights.glsl.
enum class LightType : std::uint8_t {
    point,
    spot,
    directional,  ///< from infinitely far, without extent
    frustum,      ///< a point that shines into a rectangular pyramid
    line,         ///< a diffuse cylinder too thin to have a luminance
    tube,         ///< a capsule: a cylinder between two half spheres
    sun,          ///< a disc infinitely far away
    sphere,
    disk,
    rectangle,
};

/// In which of its units a light's strength was stated (Frostbite Tables 8, 9 and 12). `intensity` below is
/// already converted; this is kept so that a file can be written as it was read.
enum class LightUnit : std::uint8_t { candela, lumen, lux, nit, ev100, watt };

/// How a spot's luminous power becomes its intensity (Frostbite Table 9).
enum class SpotPower : std::uint8_t {
    frostbite,  ///< I = power / pi, whatever the cone: the reflector absorbs what leaves it (equation 17)
    exact,      ///< all power within the outer cone (equation 16)
};

/// One light in world space. `color * intensity` is what shines, per Rec.709 channel.
///
/// Its own frame is that of a glTF node: it shines down -Z (`direction`), `right` is +X, up() is +Y.
struct Light {
    std::string name;
    LightType type = LightType::point;
    glm::vec3 position{0.0f};                ///< m, the centre of a shape; not of directional and sun
    glm::vec3 direction{0.0f, 0.0f, -1.0f};  ///< unit, the way the light travels
    glm::vec3 right{1.0f, 0.0f, 0.0f};       ///< unit, perpendicular to direction; the axis of line and tube
    glm::vec3 color{1.0f};                   ///< linear Rec.709
    /// point, spot, frustum: cd (with a profile: the factor on its cd). line: cd perpendicular to its axis.
    /// directional, sun: lx at normal incidence. sphere, disk, rectangle, tube: cd/m^2.
    float intensity = 1.0f;
    float range_m = std::numeric_limits<float>::infinity();  ///< window attenuation about `position`

    float inner_cone_rad = 0.0f;                ///< spot, disk with a cone: half angle
    float outer_cone_rad = 0.785398163f;        ///< spot, disk with a cone: half angle
    bool cone = false;                          ///< disk: fades by angle as a spot does (Frostbite listing 9)
    float horizontal_angle_rad = 0.785398163f;  ///< frustum: full opening angle along `right`
    float vertical_angle_rad = 0.785398163f;    ///< frustum: full opening angle along up()
    float angular_diameter_rad = 0.0093f;       ///< sun: 0.533 degrees
    bool limb_darkening = false;                ///< sun: darker towards its edge

    float radius_m = 0.0f;  ///< sphere, disk, tube
    float half_width_m =
        0.0f;  ///< rectangle: along `right`; line, tube: half the length between the end points
    float half_height_m = 0.0f;  ///< rectangle: along up()

    bool two_sided = false;  ///< disk, rectangle: shine both ways
    bool visible = true;     ///< shapes and sun: the camera sees them with their luminance
    bool casts_shadow = true;

    std::uint32_t profile =
        no_index;  ///< point, spot: index into Scene::profiles; turned with the light's frame
    std::uint32_t image = no_index;  ///< rectangle: index into Scene::images, sRGB, multiplies the luminance

    LightUnit unit = LightUnit::candela;  ///< as stated
    float efficacy_lm_per_w = 0.0f;       ///< as stated; 0: not in watts
    SpotPower spot_power = SpotPower::frostbite;
    float color_temperature_k = 0.0f;  ///< as stated; 0: the colour was given as RGB
    std::string carrier;               ///< where it was read from, for people: a glTF extension, "stage"

    /// Unit: cross(right, direction).
    [[nodiscard]] glm::vec3 up() const noexcept {
        return {right.y * direction.z - right.z * direction.y, right.z * direction.x - right.x * direction.z,
                right.x * direction.y - right.y * direction.x};
    }
};

/// From infinitely far: the same everywhere.
[[nodiscard]] constexpr bool is_distant(LightType type) noexcept {
    return type == LightType::directional || type == LightType::sun;
}
/// Of a size: has a luminance, and other ways of drawing directions than its own can find it.
[[nodiscard]] constexpr bool has_extent(LightType type) noexcept {
    return type >= LightType::tube;
}
[[nodiscard]] constexpr bool is_shape(LightType type) noexcept {
    return type == LightType::tube || type >= LightType::sphere;
}

/// The name in files and on the command line: "point", "rectangle", ...
[[nodiscard]] const char* name_of(LightType type);

}  // namespace candela::scene
