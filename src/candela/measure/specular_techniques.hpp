#pragma once

#include <functional>
#include <string>
#include <vector>

#include "candela/measure/specular_truth.hpp"

/// The estimates of shading/lights/ for the reflection of an area light, in the frame and the unit of
/// SpecularTruth.
namespace candela::measure {

struct SpecularView {
    glm::vec3 v{0.0f, 0.0f, 1.0f};
    float alpha = 1.0f;
    float albedo = 1.0f;  ///< of the lobe, by which D V cos is divided
};

struct SpecularTechnique {
    std::string name;    ///< the function in shading/
    std::string label;   ///< in few words
    std::string source;  ///< paper and section
    std::function<double(const ShapedLight&, const SpecularView&)> estimate;
};

/// Those of a shape; linearly transformed cosines first, then Karis's representative point with its
/// normalization, which is what they are compared with; last the transformed cosines as the frame has them.
[[nodiscard]] std::vector<SpecularTechnique> specular_techniques(LightShape shape);

[[nodiscard]] std::string name_of(LightShape shape);

}  // namespace candela::measure
