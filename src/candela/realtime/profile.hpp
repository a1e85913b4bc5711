#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "candela/scene/material.hpp"

namespace candela::realtime {

/// The rows a profile picks, one technique for each kind of integral (docs/techniques.md names their
/// sources). The numbers are the constants of the same names in shading/ and in realtime/shaders/.
enum class DiffuseTechnique : std::uint8_t { lambert, disney, disney_renormalized };
enum class VisibilityTechnique : std::uint8_t {
    smith_correlated,
    schlick_smith,
    schlick_smith_half_alpha,
    teaching_page
};
enum class FresnelTechnique : std::uint8_t { schlick, spherical_gaussian, schlick_micro_occlusion };
enum class EnergyTechnique : std::uint8_t { none, compensated };
enum class DfgTechnique : std::uint8_t { table, env_brdf_approx, env_brdf_approx_nonmetal };
enum class ReflectionTechnique : std::uint8_t {
    mirror_direction,
    dominant_direction,
    dominant_direction_fit,
    fitted_direction,
    stretched_2,
    stretched_3
};
/// How lights without extent fade with distance: shading/lights/falloff_windows.glsl.
enum class FalloffTechnique : std::uint8_t { inverse_square, offset, exponent_2, exponent_8 };
/// What directional lights and suns reflect in surfaces without layers.
enum class SunSpecularTechnique : std::uint8_t { full, d_approx, d_approx_printed };
/// Where a surface reads the irradiance of the environment.
enum class IrradianceTechnique : std::uint8_t { normal, dominant_direction };
enum class SpecularAaTechnique : std::uint8_t { none, footprint };
/// What a mip level of a normal map makes of the normals that it averages: shading/footprint.glsl.
enum class NormalMapFilterTechnique : std::uint8_t { convolved, average_length };
/// Of what the shape has none of its own for, the nearest: shaders/area_lights.glsl.
enum class AreaDiffuseTechnique : std::uint8_t {
    exact,
    structured_sampling,
    form_factor,
    most_representative_point,
    most_representative_point_drobot,
    light_position,
    five_times,
};
/// The one direction in which lobes are evaluated that an area light's illuminance multiplies.
enum class AreaDirectionTechnique : std::uint8_t { representative_point, light_position };
enum class AreaSpecularTechnique : std::uint8_t {
    ltc,
    representative_point,
    dominant_direction,
    specular_d_widening,
    dominant_direction_normalized,
    teaching_page
};
enum class ShadowFilterTechnique : std::uint8_t { pcss, pcf };
enum class ContactShadowTechnique : std::uint8_t { none, screen_march };
/// From EV100 to the factor that brings cd/m^2 to exposed values: shading/exposure.glsl.
enum class ExposureTechnique : std::uint8_t { standard_output, saturation };

struct Profile {
    std::string name;
    DiffuseTechnique diffuse = DiffuseTechnique::lambert;
    VisibilityTechnique visibility = VisibilityTechnique::smith_correlated;
    FresnelTechnique fresnel = FresnelTechnique::schlick;
    EnergyTechnique energy = EnergyTechnique::compensated;
    DfgTechnique dfg = DfgTechnique::table;
    scene::FullyRoughRule fully_rough = scene::FullyRoughRule::none;
    SunSpecularTechnique sun_specular = SunSpecularTechnique::full;
    ReflectionTechnique reflection = ReflectionTechnique::stretched_2;
    IrradianceTechnique irradiance = IrradianceTechnique::normal;
    SpecularAaTechnique specular_aa = SpecularAaTechnique::footprint;
    NormalMapFilterTechnique normal_map_filter = NormalMapFilterTechnique::convolved;
    AreaDiffuseTechnique area_diffuse = AreaDiffuseTechnique::exact;
    AreaDirectionTechnique area_direction = AreaDirectionTechnique::representative_point;
    AreaSpecularTechnique area_specular = AreaSpecularTechnique::ltc;
    FalloffTechnique falloff = FalloffTechnique::inverse_square;
    float falloff_offset_m2 = 1.0e-4f;  ///< of FalloffTechnique::offset, >= 0
    ShadowFilterTechnique shadow_filter = ShadowFilterTechnique::pcss;
    ContactShadowTechnique contact_shadows = ContactShadowTechnique::none;
    ExposureTechnique exposure = ExposureTechnique::standard_output;
};

/// best, frostbite, ue4, mobile, lesson or lesson-literal. Throws Error (Fault::usage) at `where` that lists
/// the names.
[[nodiscard]] Profile profile_by_name(const std::string& name, const std::string& where = "profile");
[[nodiscard]] std::vector<std::string> profile_names();

/// Replaces one technique: set_technique(profile, "diffuse", "lambert"). Throws Error (Fault::input) at
/// `where` that lists what exists.
void set_technique(Profile& profile, std::string_view slot, std::string_view technique,
                   const std::string& where);

/// Replaces a number: "falloff-offset-m2", 0 to 1e6. Throws Error (Fault::input) at `where`.
void set_parameter(Profile& profile, std::string_view name, double value, const std::string& where);

/// "diffuse=lambert visibility=smith-correlated ...": for metadata and reports.
[[nodiscard]] std::string describe(const Profile& profile);

}  // namespace candela::realtime
