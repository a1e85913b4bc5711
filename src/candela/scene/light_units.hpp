#pragma once

#include <optional>
#include <string>

#include "candela/scene/light.hpp"
#include "candela/scene/photometric.hpp"

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

/// How strong a light with a photometric profile is (Frostbite section 4.5).
enum class ProfileScale : std::uint8_t {
    absolute,  ///< as the file says, times a number
    mask,      ///< Frostbite's: the profile over its peak dims a light of the stated strength
    power,     ///< the web's shape, so strong that all of it together has the stated lm
};

/// Light::intensity, the factor on the profile's cd, of a light that is to be this strong; not for absolute.
/// Throws Error (Fault::input) at `where` as intensity_from does, and for a profile that is dark.
[[nodiscard]] float profile_factor_from(const Light& light, const PhotometricProfile& profile,
                                        ProfileScale scale, const LightStrength& strength,
                                        const std::string& where);

/// Luminous power in lm of Light::intensity (without colour and profile) by the convention of the light's
/// type: a spot's is Light::spot_power's. None for lights infinitely far away.
[[nodiscard]] std::optional<float> power_lm(const Light& light);

/// What a light gives, in every unit that its type has; with its colour's luminance.
struct LightQuantities {
    std::optional<float> power_lm;    ///< by the convention of its type; with a profile, of the whole web
    std::optional<float> emitted_lm;  ///< what leaves it: differs for spots, whose edge is smooth
    std::optional<float> power_w;     ///< when stated in W
    std::optional<float>
        intensity_cd;              ///< along its axis, a line's and a tube's across it; shapes: from afar
    std::optional<float> peak_cd;  ///< with a profile
    std::optional<float> illuminance_lx;  ///< directional, sun: at normal incidence
    std::optional<float>
        illuminance_at_1m_lx;  ///< 1 m from its centre along its axis, on a surface facing it
    std::optional<float> luminance_nit;
    std::optional<float> ev100;  ///< of the luminance
};
/// `profile`: Light::profile's, null without one.
[[nodiscard]] LightQuantities quantities(const Light& light, const PhotometricProfile* profile = nullptr);

}  // namespace candela::scene
