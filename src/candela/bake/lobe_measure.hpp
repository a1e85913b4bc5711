#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "candela/bake/lobe_fit.hpp"

/// What lobe_fit.hpp's measure is made of.
namespace candela::bake {

/// A bump of light on the sphere and what the lobe sees of it.
struct LobeBump {
    std::size_t width = 0;  ///< index of the octave
    glm::dvec3 centre;
    double weight = 0.0;
    double seen = 0.0;
};

/// A lobe about +Z seen from v in the xz plane, whose x is negative.
struct LobeView {
    glm::vec3 v;
    float perceptual_roughness = 1.0f;
    float fresnel_share = 0.0f;  ///< of its light that the rise of Fresnel's reflectance from f0 to 1 gives
    std::vector<LobeBump> bumps;
    double norm = 0.0;  ///< root of the weighted sum of squares of what the lobe sees
};

/// A direction in which a lobe about +Z sends light, and how much; the weights of all add up to 1.
struct LobeSample {
    glm::dvec3 l;
    double weight = 0.0;
};

/// What a lobe is sampled by: all of it, or one half of one that is the same on both sides of the xz plane.
enum class LobeSide : std::uint8_t { both, one };

/// Any lobe seen from v. middle: unit, in the xz plane, about which the bumps stand as far as a lobe of this
/// scale asks for, and as fine.
[[nodiscard]] LobeView sampled_lobe_view(const glm::vec3& v, const glm::dvec3& middle, double scale_rad,
                                         const std::vector<LobeSample>& samples, LobeSide side);

[[nodiscard]] LobeView lobe_view(float NoV, float perceptual_roughness, float f0);
/// Those of lobe_errors() and of the fit.
[[nodiscard]] const std::vector<LobeView>& lobe_views();

/// By bump: what the reads see more than the lobe, weighted, over the norm. The root of the sum of squares is
/// the error.
[[nodiscard]] std::vector<double> lobe_differences(const LobeView& view,
                                                   const std::vector<shading::LobeRead>& reads);
[[nodiscard]] double lobe_distance(const LobeView& view, const std::vector<shading::LobeRead>& reads);

class ErrorOfViews {
  public:
    void add(double error) {
        sum_ += error;
        largest_ = std::max(largest_, error);
        ++count_;
    }
    [[nodiscard]] LobeErrors result() const { return {sum_ / double(count_), largest_}; }

  private:
    double sum_ = 0.0;
    double largest_ = 0.0;
    int count_ = 0;
};

}  // namespace candela::bake
