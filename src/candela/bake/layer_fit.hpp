#pragma once

#include <string>
#include <vector>

#include "candela/bake/lobe_fit.hpp"

/// The fits behind shading/layer_reflection.glsl: reads that look most like the lobes of anisotropic metal (D
/// V cos of anisotropic GGX over its albedo) and of sheen (evaluate_sheen cos over its albedo), by the
/// measure of lobe_fit.hpp. Its bumps are as fine as the geometric mean of the widths along and across the
/// grain asks for; for sheen, which has no detail of its own but the horizon's, as a scale of 1 rad does.
namespace candela::bake {

/// A constant of a shader, as it stands there and as the fit finds it.
struct FittedConstant {
    std::string name;
    double committed = 0.0;
    double found = 0.0;
};

struct LayerFit {
    std::string name;
    std::string views;
    std::vector<FittedConstant> constants;
    LobeErrors committed;
    LobeErrors found;
    LobeErrors instead;  ///< of one read in the mirror direction as wide as the narrow side; of irradiance
};

/// Perceptual roughness 0.2 to 0.6, glTF strengths 0.3 to 0.9, NoV 0.25 to 0.95, two azimuths.
[[nodiscard]] LayerFit fit_anisotropic_reads();
/// NoV and sheen roughness 0.1 to 1.
[[nodiscard]] LayerFit fit_sheen_read();

}  // namespace candela::bake
