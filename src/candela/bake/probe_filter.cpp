#include "candela/bake/probe_filter.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "candela/bake/cube_pyramid.hpp"
#include "candela/bake/environment.hpp"
#include "candela_shaders/probe_maps_comp.hpp"
#include "shading/environment.glsl"
#include "shading/spherical_harmonics.glsl"

namespace candela::bake {
namespace {

constexpr std::uint32_t kMapSize = 256;
constexpr std::uint32_t kMapLevels = 6;
constexpr VkFormat kFloat4 = VK_FORMAT_R32G32B32A32_SFLOAT;

struct FaceAxes {
    glm::vec3 forward;
    glm::vec3 right;
    glm::vec3 up;
};
constexpr std::array<FaceAxes, 6> kAxes{{{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                         {{-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                         {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                         {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                         {{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},
                                         {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}}}};

/// Push constants of shaders/probe_maps.comp.glsl.
struct MapBlock {
    std::int32_t size;
    float perceptual_roughness;
    float nit_per_unit;
    float visibility_per_unit;
};

std::size_t face_of(const glm::vec3& d) {
    std::size_t best = 0;
    for (std::size_t f = 1; f < kAxes.size(); ++f) {
        if (glm::dot(d, kAxes[f].forward) > glm::dot(d, kAxes[best].forward)) best = f;
    }
    return best;
}

/// An equirectangular picture of one of the faces' two meanings, about as fine as they are.
template <class Part>
scene::Environment equirect(const ProbeFaces& faces, const Part& part) {
    scene::Environment e;
    e.height = 2 * faces.size;
    e.width = 4 * faces.size;
    e.luminance_nit.resize(std::size_t{e.width} * e.height);
    for (std::uint32_t y = 0; y < e.height; ++y) {
        for (std::uint32_t x = 0; x < e.width; ++x) {
            const glm::vec2 uv((float(x) + 0.5f) / float(e.width), (float(y) + 0.5f) / float(e.height));
            e.luminance_nit[std::size_t{y} * e.width + x] =
                part(read_faces(faces, shading::equirect_direction(uv)));
        }
    }
    return e;
}

std::vector<glm::vec4> read_back(const gpu::Device& device, gpu::Commands& commands, gpu::Image& image) {
    const std::size_t texels = std::size_t{image.desc().width} * image.desc().height;
    gpu::Buffer buffer(device, texels * sizeof(glm::vec4), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                       gpu::MemoryKind::readback);
    commands.begin();
    commands.copy(image, buffer);
    commands.submit_and_wait();
    std::vector<glm::vec4> out(texels);
    std::memcpy(out.data(), buffer.mapped(), texels * sizeof(glm::vec4));
    return out;
}

}  // namespace

scene::Camera probe_camera(std::size_t face, const glm::vec3& position) {
    const FaceAxes& a = kAxes.at(face);
    scene::Camera camera;
    camera.world = glm::mat4(glm::vec4(a.right, 0.0f), glm::vec4(a.up, 0.0f), glm::vec4(-a.forward, 0.0f),
                             glm::vec4(position, 1.0f));
    camera.yfov_rad = 0.5f * shading::PI;
    camera.aspect = 1.0f;
    return camera;
}

glm::vec4 read_faces(const ProbeFaces& faces, const glm::vec3& direction) {
    const std::size_t face = face_of(direction);
    const FaceAxes& a = kAxes[face];
    const float depth = glm::dot(direction, a.forward);
    const float size = float(faces.size);
    const float x = (0.5f + 0.5f * glm::dot(direction, a.right) / depth) * size - 0.5f;
    const float y = (0.5f - 0.5f * glm::dot(direction, a.up) / depth) * size - 0.5f;
    const auto at = [&](float ix, float iy) {
        const auto cx = static_cast<std::size_t>(std::clamp(ix, 0.0f, size - 1.0f));
        const auto cy = static_cast<std::size_t>(std::clamp(iy, 0.0f, size - 1.0f));
        return faces.faces[face][cy * faces.size + cx];
    };
    const float x0 = std::floor(x);
    const float y0 = std::floor(y);
    return glm::mix(glm::mix(at(x0, y0), at(x0 + 1, y0), x - x0),
                    glm::mix(at(x0, y0 + 1), at(x0 + 1, y0 + 1), x - x0), y - y0);
}

std::array<glm::vec4, 9> probe_irradiance_sh(const ProbeFaces& faces) {
    std::array<glm::dvec4, 9> sums{};
    const float step = 2.0f / float(faces.size);
    for (std::size_t f = 0; f < kAxes.size(); ++f) {
        const FaceAxes& a = kAxes[f];
        for (std::uint32_t y = 0; y < faces.size; ++y) {
            for (std::uint32_t x = 0; x < faces.size; ++x) {
                const glm::vec2 at((float(x) + 0.5f) * step - 1.0f, 1.0f - (float(y) + 0.5f) * step);
                const glm::vec3 d = glm::normalize(a.forward + at.x * a.right + at.y * a.up);
                const double solid_angle = cube_texel_sr(x, y, faces.size);
                const glm::dvec4 value(faces.faces[f][std::size_t{y} * faces.size + x]);
                for (int k = 0; k < shading::kShCoefficients; ++k)
                    sums[std::size_t(k)] += value * (solid_angle * double(shading::sh_basis(k, d)));
            }
        }
    }
    std::array<glm::vec4, 9> out;
    for (int k = 0; k < shading::kShCoefficients; ++k) {
        out[std::size_t(k)] = glm::vec4(sums[std::size_t(k)] * double(shading::sh_cosine_over_pi(k)));
    }
    return out;
}

scene::ProbeCapture filter_probe(const gpu::Device& device, gpu::Commands& commands,
                                 const ProbeFaces& faces) {
    EnvironmentMaps color = prefilter_environment(
        device, commands, equirect(faces, [](const glm::vec4& t) { return glm::vec3(t); }));
    EnvironmentMaps visibility = prefilter_environment(
        device, commands, equirect(faces, [](const glm::vec4& t) { return glm::vec3(t.w); }));
    const gpu::ComputePipeline pipeline = gpu::create_compute_pipeline(
        device, shaders::probe_maps_comp,
        {{{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
           VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}},
         sizeof(MapBlock)});
    const gpu::Owned<VkSampler> sampler = gpu::create_sampler(device, {});
    scene::ProbeCapture out;
    out.size = kMapSize;
    out.irradiance_sh = probe_irradiance_sh(faces);
    for (std::uint32_t level = 0; level < kMapLevels; ++level) {
        const std::uint32_t size = kMapSize >> level;
        gpu::Image image(device, {size, size, kFloat4, VK_IMAGE_USAGE_STORAGE_BIT});
        const float step = float(level) / float(kMapLevels - 1);
        const MapBlock block{static_cast<std::int32_t>(size), step * step, color.nit_per_unit,
                             visibility.nit_per_unit};
        commands.begin();
        commands.begin_pass("probe maps");
        commands.use(color.specular, gpu::Use::sampled);
        commands.use(visibility.specular, gpu::Use::sampled);
        commands.use(image, gpu::Use::storage_write);
        const std::array bindings{gpu::bind_sampled(color.specular.view(), sampler.get()),
                                  gpu::bind_sampled(visibility.specular.view(), sampler.get()),
                                  gpu::bind_storage(image.view())};
        commands.dispatch(pipeline, bindings, gpu::push(block), (size + 7) / 8, (size + 7) / 8);
        commands.submit_and_wait();
        out.levels.push_back(read_back(device, commands, image));
    }
    return out;
}

}  // namespace candela::bake
