#include <algorithm>
#include <cmath>

#include "candela/io/image_write.hpp"
#include "candela/io/output_folder.hpp"
#include "local_light.hpp"
#include "shading/environment.glsl"
#include "shading/octahedral.glsl"
#include "shading/transfer.glsl"

namespace candela::app {
namespace {

constexpr std::uint32_t kWidth = 512;
constexpr std::uint32_t kHeight = 256;
/// Of the mean luminance, on a display's scale.
constexpr float kGrey = 0.25f;

glm::vec4 read_map(const scene::ProbeCapture& capture, const glm::vec3& direction) {
    const float interior = static_cast<float>(capture.size) - 2.0f;
    const glm::vec2 at = (shading::octahedral_encode(direction) * 0.5f + 0.5f) * interior + 0.5f;
    const auto x = static_cast<std::size_t>(at.x);
    const auto y = static_cast<std::size_t>(at.y);
    const auto& texels = capture.levels.front();
    const auto texel = [&](std::size_t i, std::size_t j) { return texels[j * capture.size + i]; };
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), at.x - std::floor(at.x)),
                    glm::mix(texel(x, y + 1), texel(x + 1, y + 1), at.x - std::floor(at.x)),
                    at.y - std::floor(at.y));
}

std::vector<std::uint8_t> picture_of(const scene::ProbeCapture& capture) {
    std::vector<glm::vec4> texels(std::size_t{kWidth} * kHeight);
    double sum = 0.0;
    double seen = 1e-9;
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            const glm::vec2 uv((float(x) + 0.5f) / kWidth, (float(y) + 0.5f) / kHeight);
            const glm::vec4 t = read_map(capture, shading::equirect_direction(uv));
            texels[std::size_t{y} * kWidth + x] = t;
            sum += double(shading::luminance(glm::vec3(t)));
            seen += double(t.w);
        }
    }
    const float scale = kGrey / std::max(float(sum / seen), 1e-12f);
    std::vector<std::uint8_t> rgb;
    rgb.reserve(6 * texels.size());
    const auto put = [&](const glm::vec3& linear) {
        const glm::vec3 code = shading::srgb_from_linear(shading::saturate(linear));
        for (int c = 0; c < 3; ++c) rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0f * code[c])));
    };
    for (const glm::vec4& t : texels) put(glm::vec3(t) * scale);
    for (const glm::vec4& t : texels) put(glm::vec3(t.w));
    return rgb;
}

/// A probe's name without what a file's may not have.
std::string stem_of(const scene::ReflectionProbe& probe, std::size_t index) {
    std::string name = probe.name.empty() ? "probe " + std::to_string(index) : probe.name;
    for (char& c : name) {
        if (c == '/' || c == '\\' || static_cast<unsigned char>(c) < 32) c = '_';
    }
    return (name[0] == '.' ? "_" : "") + name;
}

}  // namespace

std::vector<std::filesystem::path> write_probe_pictures(const Job& job, const std::filesystem::path& folder) {
    (void)io::make_output_folder(folder);
    std::vector<std::filesystem::path> files;
    for (std::size_t i = 0; i < job.scene.reflection_probes.size(); ++i) {
        const scene::ReflectionProbe& probe = job.scene.reflection_probes[i];
        const std::string stem = stem_of(probe, i);
        std::filesystem::path file = folder / (stem + ".png");
        // Probes of one name are told apart.
        for (std::size_t k = i; std::find(files.begin(), files.end(), file) != files.end(); ++k)
            file = folder / (stem + " " + std::to_string(k) + ".png");
        files.push_back(file);
        io::write_png(files.back(), kWidth, 2 * kHeight,
                      std::span<const std::uint8_t>(picture_of(probe.capture)));
    }
    return files;
}

}  // namespace candela::app
