#pragma once

#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::realtime {

/// Finds surfaces that ask for blending but have alpha 1 everywhere, as exporters often write them: drawn as
/// opaque ones they need no sorting and write depth.
class Opacity {
  public:
    explicit Opacity(const scene::Scene& scene);

    [[nodiscard]] bool needs_blending(const scene::Primitive& primitive) const;

  private:
    const scene::Scene* scene_;
    std::vector<bool> image_is_opaque_;
};

}  // namespace candela::realtime
