#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "shading/sequence.glsl"

namespace candela::truth {

/// The numbers of one path: an Owen-scrambled Sobol point whose dimensions are named by bounce and purpose,
/// so that a branch not taken does not shift the rest. Depends on pixel, sample and seed alone.
class PathSampler {
  public:
    enum class Slot : std::uint32_t {
        light_choice,
        near_light,
        environment,
        bsdf,
        bsdf_choice,
        distant_light,
        count
    };

    PathSampler(const glm::uvec2& pixel, std::uint32_t sample, std::uint32_t seed)
        : seed_(shading::pixel_seed(pixel, seed)), sample_(sample) {}

    /// Position in the pixel, each in [0,1).
    [[nodiscard]] glm::vec2 pixel() const { return shading::sobol_owen_pair(sample_, 0u, seed_); }
    [[nodiscard]] glm::vec2 lens() const { return shading::sobol_owen_pair(sample_, 1u, seed_); }
    [[nodiscard]] glm::vec2 pair(int bounce, Slot slot) const {
        const std::uint32_t index =
            2u + static_cast<std::uint32_t>(bounce) * static_cast<std::uint32_t>(Slot::count) +
            static_cast<std::uint32_t>(slot);
        return shading::sobol_owen_pair(sample_, index, seed_);
    }
    /// Unstratified numbers for what has no fixed number of uses.
    [[nodiscard]] float loose(int bounce, std::uint32_t use) const {
        return shading::unit_float(shading::hash_combine(
            shading::hash_combine(seed_ ^ sample_ * 0x9e3779b9u, static_cast<std::uint32_t>(bounce)), use));
    }

  private:
    std::uint32_t seed_;
    std::uint32_t sample_;
};

}  // namespace candela::truth
