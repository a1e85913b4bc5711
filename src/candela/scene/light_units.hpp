#pragma once

#include <optional>
#include <string>

#include "candela/scene/light.hpp"

/// The one place where a light's strength changes its unit. The formulas are those of
/// shading/lights/units.glsl; here they meet the types of lights (docs/lights.md has the table).
namespace candela::scene {

/// A light's strength as somebody states it.
struct LightStrength {
    float value = 1.0f;
    LightUnit unit = LightUnit::candela;
    float efficacy_lm_per_w = 0.0f;  ///< of watt, and greater than 0 there
};

/// "lm", "cd", "lx", "nit", "EV100", "W".
[[nodiscard]] const char* name_of(LightUnit unit);

/// May a light of this type be stated in this unit? Frostbite Table 8, wider where another carrier has the
/// unit: cd for every punctual light (KHR_lights_punctual), cd/m^2 and EV100 for the sun's disc.
[[nodiscard]] bool accepts(LightType type, LightUnit unit);

/// "lm, cd or W"
[[nodiscard]] std::string accepted_units(LightType type);

/// Light::intensity of a light of this type, shape and convention without a profile that is this strong.
/// Throws Error (Fault::input) at `where` for a unit that the type does not have, with what to do instead.
[[nodiscard]] float intensity_from(const Light& light, const LightStrength& strength,
                                   const std::string& where);

/// Luminous power in lm of Light::intensity (without colour and profile) by the convention of the light's
/// type: a spot's is Light::spot_power's. None for lights infinitely far away.
[[nodiscard]] std::optional<float> power_lm(const Light& light);

/// What a light gives, in every unit that its type has; with its colour's luminance.
struct LightQuantities {
    std::optional<float> power_lm;    ///< by the convention of its type
    std::optional<float> emitted_lm;  ///< what leaves it: differs for spots, whose edge is smooth
    std::optional<float> power_w;     ///< when stated in W
    std::optional<float>
        intensity_cd;  ///< along its axis, a line's and a tube's across it; shapes: from afar
    std::optional<float> illuminance_lx;  ///< directional, sun: at normal incidence
    std::optional<float>
        illuminance_at_1m_lx;  ///< 1 m from its centre along its axis, on a surface facing it
    std::optional<float> luminance_nit;
    std::optional<float> ev100;  ///< of the luminance
};
/// `light` without profile.
[[nodiscard]] LightQuantities quantities(const Light& light);

}  // namespace candela::scene
