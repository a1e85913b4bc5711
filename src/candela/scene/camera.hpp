#pragma once

#include "candela/scene/scene.hpp"

namespace candela::scene {

/// The camera whose picture of `aspect` (width / height, > 0) shows all of its author's viewport and more
/// beside it where the shapes differ (glTF 2.0, 3.10.3: a client should not crop). A perspective camera
/// without an aspect keeps its vertical field of view; an orthographic one keeps xmag_m and ymag_m in the
/// picture. Fitting twice changes nothing. view_projection(), shadow cascades and the path tracer's rays all
/// start from this.
[[nodiscard]] Camera fitted(Camera camera, float aspect);

}  // namespace candela::scene
