#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "candela/io/environment_presets.hpp"
#include "candela/io/image_write.hpp"
#include "shading/transfer.glsl"

namespace candela::io::detail {
namespace {

using nlohmann::json;
using scene::CubeMap;

constexpr float kLargestRgbd = 255.0f;  ///< white over a divisor of 1/255

/// RGB over A; RGB is sRGB encoded, as the extension's authors say (KhronosGroup/glTF issue 1648).
std::array<std::uint8_t, 4> rgbd_of(const glm::vec3& value) {
    const float peak = std::max({value.x, value.y, value.z});
    const float divisor = peak > 1.0f ? std::max(std::floor(kLargestRgbd / peak), 1.0f) : kLargestRgbd;
    const glm::vec3 encoded =
        shading::srgb_from_linear(glm::clamp(value * (divisor / kLargestRgbd), 0.0f, 1.0f));
    const auto byte = [](float v) { return static_cast<std::uint8_t>(std::lround(255.0f * v)); };
    return {byte(encoded.x), byte(encoded.y), byte(encoded.z), static_cast<std::uint8_t>(divisor)};
}

/// Flipped about its vertical axis, as the extension says: what one sees from inside the right-handed world.
std::vector<std::byte> face_png(const CubeMap& cube, std::uint32_t face, float scale) {
    scene::Image image;
    image.width = image.height = cube.size;
    for (std::uint32_t y = 0; y < cube.size; ++y) {
        for (std::uint32_t x = cube.size; x-- > 0;) {
            const auto texel = rgbd_of(cube.texels[cube.index(face, x, y)] * scale);
            image.rgba.insert(image.rgba.end(), texel.begin(), texel.end());
        }
    }
    return encode_png(image);
}

float peak_of(const scene::FilteredEnvironment& e) {
    float peak = 0.0f;
    for (const CubeMap& level : e.specular) {
        for (const glm::vec3& t : level.texels) peak = std::max({peak, t.x, t.y, t.z});
    }
    return peak;
}

}  // namespace

// EXT_lights_image_based (KhronosGroup/glTF, extensions/2.0/Vendor): levels map evenly to perceptual
// roughness, RGBD PNG faces, 9 x 3 harmonics of the irradiance, without 1/pi.
void write_gltf_light(StagingFolder& files, const scene::FilteredEnvironment& e, json& metadata) {
    constexpr std::array<const char*, 6> faces{"px", "nx", "py", "ny", "pz", "nz"};
    const float scale = 1.0f / std::max(peak_of(e) / kLargestRgbd, 1.0f);
    json images = json::array(), levels = json::array(), sh = json::array();
    for (std::size_t i = 0; i < e.specular.size(); ++i) {
        levels.push_back(json::array());
        for (std::uint32_t face = 0; face < 6; ++face) {
            const std::string name = "specular_" + std::to_string(i) + "_" + faces[face] + ".png";
            write_file(files.file(name), face_png(e.specular[i], face, scale));
            levels.back().push_back(images.size());
            images.push_back({{"uri", name}, {"mimeType", "image/png"}});
        }
    }
    for (const glm::vec3& c : e.irradiance_sh) {
        const glm::vec3 irradiance = c * (std::numbers::pi_v<float> * scale);
        sh.push_back({irradiance.x, irradiance.y, irradiance.z});
    }
    const json light{{"name", "environment"},
                     {"intensity", e.nit_per_unit / scale},
                     {"irradianceCoefficients", sh},
                     {"specularImageSize", e.specular.front().size},
                     {"specularImages", levels}};
    const json gltf{{"asset", {{"version", "2.0"}, {"generator", "candela"}}},
                    {"extensionsUsed", {"EXT_lights_image_based"}},
                    {"extensions", {{"EXT_lights_image_based", {{"lights", {light}}}}}},
                    {"images", images},
                    {"scenes", {{{"extensions", {{"EXT_lights_image_based", {{"light", 0}}}}}}}},
                    {"scene", 0}};
    write_text(files.file("environment.gltf"), gltf.dump(2) + "\n");
    metadata["format"] = "PNG, RGBD: sRGB-encoded RGB over A";
    metadata["orientation"] = {
        {"faces", "+X -X +Y -Y +Z -Z of the glTF world, as the extension orders them"},
        {"flip", "each face about its vertical axis: the picture seen from inside, unmirrored"}};
    metadata["units"]["gltf"] = "RGB over A, times the light's intensity, is cd/m^2";
    metadata["irradiance"] = {{"sh", "9 x RGB of the irradiance in lx over intensity"},
                              {"one_over_pi", "not included: the reader divides"}};
}

}  // namespace candela::io::detail
