#include "candela/scene/camera.hpp"

#include <algorithm>
#include <cmath>

namespace candela::scene {

Camera fitted(Camera camera, float aspect) {
    if (camera.projection == Projection::orthographic) {
        camera.ymag_m = std::max(camera.ymag_m, camera.xmag_m / aspect);
        camera.xmag_m = camera.ymag_m * aspect;
        return camera;
    }
    // Where the picture is wider than the author's, it shows more at its sides by itself.
    if (camera.aspect > aspect)
        camera.yfov_rad = 2.0f * std::atan(std::tan(0.5f * camera.yfov_rad) * camera.aspect / aspect);
    if (camera.aspect > 0.0f) camera.aspect = aspect;
    return camera;
}

}  // namespace candela::scene
