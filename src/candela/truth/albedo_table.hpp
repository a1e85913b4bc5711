#pragma once

#include <glm/vec4.hpp>
#include <vector>

namespace candela::truth {

/// shading/dfg.glsl's table on the CPU, read as the device reads it: what energy compensation divides by.
class AlbedoTable {
  public:
    /// ue4: of Schlick's visibility instead of the height-correlated one.
    explicit AlbedoTable(bool ue4);
    /// NoV and perceptual_roughness in [0,1].
    [[nodiscard]] glm::vec4 read(float NoV, float perceptual_roughness) const;

  private:
    std::vector<glm::vec4> texels_;
};

}  // namespace candela::truth
