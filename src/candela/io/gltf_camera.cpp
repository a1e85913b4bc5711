#include "candela/io/gltf_camera.hpp"

#include <cmath>
#include <limits>

namespace candela::io {
namespace {

/// What stands where a file gives no number that a camera can have.
constexpr float kYfov_rad = 0.7f, kZnear_m = 0.01f, kMag_m = 1.0f, kOrthographicZfar_m = 100.0f;
constexpr float kWidestYfov_rad = 3.1f;

float positive(const JsonView& value, float fallback, const char* repair) {
    const float x = value.float_or(fallback);
    if (x > 0.0f) return x;
    value.repaired(std::string("must be greater than 0: ") + repair);
    return fallback;
}

void check_zfar(const JsonView& zfar, float fallback_m, scene::Camera& camera) {
    if (camera.zfar_m > camera.znear_m) return;
    zfar.repaired("must be greater than znear: read as absent");
    camera.zfar_m = fallback_m;
}

void read_perspective(const JsonView& p, scene::Camera& camera) {
    constexpr float infinite_m = std::numeric_limits<float>::infinity();
    camera.yfov_rad = positive(p["yfov"], kYfov_rad, "read as 0.7 rad");
    if (camera.yfov_rad >= kWidestYfov_rad) {
        p["yfov"].repaired("must be less than 3.1 rad (178 degrees): read as 0.7 rad");
        camera.yfov_rad = kYfov_rad;
    }
    camera.aspect =
        p["aspectRatio"].exists() ? positive(p["aspectRatio"], 0.0f, "that of the picture") : 0.0f;
    camera.znear_m = positive(p["znear"], kZnear_m, "read as 0.01 m");
    if (p["zfar"].exists()) camera.zfar_m = positive(p["zfar"], infinite_m, "read as absent");
    check_zfar(p["zfar"], infinite_m, camera);
}

float magnification(const JsonView& value) {
    const float x = value.float_or(kMag_m);
    if (x < 0.0f) value.repaired("is negative: read as positive");
    if (x == 0.0f) value.repaired("must not be 0: read as 1 m");
    return x == 0.0f ? kMag_m : std::abs(x);
}

void read_orthographic(const JsonView& o, scene::Camera& camera) {
    camera.projection = scene::Projection::orthographic;
    camera.ymag_m = magnification(o["ymag"]);
    camera.xmag_m = magnification(o["xmag"]);
    camera.znear_m = o["znear"].float_or(0.0f);
    if (camera.znear_m < 0.0f) {
        o["znear"].repaired("must be 0 or more: read as 0");
        camera.znear_m = 0.0f;
    }
    camera.zfar_m = positive(o["zfar"], camera.znear_m + kOrthographicZfar_m, "read as 100 m behind znear");
    check_zfar(o["zfar"], camera.znear_m + kOrthographicZfar_m, camera);
}

}  // namespace

std::optional<scene::Camera> read_camera(const JsonView& source, const Node& node) {
    scene::Camera camera;
    const std::string own_name = source["name"].string_or("");
    camera.name = node.name.empty() ? own_name : node.name;
    camera.world = scene::rigid_part(node.world);
    const std::string type = source["type"].one_of({"perspective", "orthographic"}, false);
    if (type.empty()) return std::nullopt;
    if (type == "perspective")
        read_perspective(source["perspective"], camera);
    else
        read_orthographic(source["orthographic"], camera);
    return camera;
}

}  // namespace candela::io
