#pragma once

#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::truth {

/// How a scene's irradiance volumes stand in it, as rays find it: where walls are, a grid of probes and its
/// light end. Shares are 0 to 1. What rays cannot tell counts for nothing.
struct VolumeSurvey {
    /// Of each volume, the part of its probes that stand outside of the walls: cut off from probes that see
    /// no sky while they see it themselves, or with the back of surfaces on one side and the sky on the
    /// other. Probes inside of something solid are left out.
    std::vector<double> outside;
    /// Of the surfaces that hardly see the sky and are in a volume, or in sight of its probes that have a
    /// roof, the part that no volume and no reflection probe reaches: the distant light comes to them as if
    /// there were nothing in its way.
    double uncovered = 0.0;
};

/// The same for any number of threads.
[[nodiscard]] VolumeSurvey survey_volumes(const scene::Scene& scene);

}  // namespace candela::truth
