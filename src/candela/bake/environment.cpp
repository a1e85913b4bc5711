#include "candela/bake/environment.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include "candela/bake/filter_octahedral.hpp"
#include "candela/bake/octahedral_map.hpp"
#include "candela/scene/environment_sources.hpp"
#include "candela/scene/half_range.hpp"
#include "candela_shaders/prefilter_comp.hpp"
#include "shading/microfacet.glsl"
#include "shading/specular_levels.glsl"

namespace candela::bake {
namespace {

/// Of shaders/environment_maps.glsl.
constexpr std::uint32_t kIrradianceSize = 32;
constexpr std::uint32_t kSpecularMips = (shading::kSpecularLevels + 1) / 2;
/// Coarsest source level: 4 texels a side, of which 2 are gutters.
constexpr std::uint32_t kSourceLevels = 8;
/// Source level that irradiance is summed from: 62 texels a side.
constexpr std::uint32_t kIrradianceSource = 3;

constexpr VkFormat kFloat4 = VK_FORMAT_R32G32B32A32_SFLOAT;

/// Push constants of shaders/prefilter.comp.glsl.
struct PrefilterBlock {
    std::int32_t size;
    std::int32_t sample_count;
    float alpha;
    float source_size;
    float source_levels;
    std::int32_t left;
};

float peak_of(const scene::Environment& e) {
    float peak = 0.0f;
    for (const glm::vec3& t : e.luminance_nit) peak = std::max(peak, std::max(t.x, std::max(t.y, t.z)));
    return peak * e.scale;
}

/// Levels of RGBA32F texels, finest first, as one image.
gpu::Image upload_levels(const gpu::Device& device, gpu::Commands& commands, std::uint32_t width,
                         std::uint32_t height, const std::vector<std::span<const glm::vec4>>& levels) {
    std::size_t bytes = 0;
    for (const auto& level : levels) bytes += level.size_bytes();
    gpu::Buffer staging(device, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::MemoryKind::upload);
    gpu::Image image(device, {width, height, kFloat4, VK_IMAGE_USAGE_SAMPLED_BIT,
                              static_cast<std::uint32_t>(levels.size())});
    commands.begin();
    std::size_t offset = 0;
    for (std::uint32_t level = 0; level < levels.size(); ++level) {
        std::memcpy(staging.mapped() + offset, levels[level].data(), levels[level].size_bytes());
        commands.copy(staging, image, level, offset);
        offset += levels[level].size_bytes();
    }
    commands.use(image, gpu::Use::sampled);
    commands.submit_and_wait();
    return image;
}

gpu::Image upload_levels(const gpu::Device& device, gpu::Commands& commands,
                         const std::vector<OctahedralMap>& maps) {
    std::vector<std::span<const glm::vec4>> levels;
    for (const OctahedralMap& level : maps) levels.emplace_back(level.texels);
    return upload_levels(device, commands, maps.front().size, maps.front().size, levels);
}

/// Two levels side by side on each mip.
gpu::Image upload_specular(const gpu::Device& device, gpu::Commands& commands,
                           const std::vector<OctahedralMap>& maps) {
    std::vector<std::vector<glm::vec4>> mips(kSpecularMips);
    std::vector<std::span<const glm::vec4>> levels;
    for (std::size_t mip = 0; mip < mips.size(); ++mip) {
        const std::size_t size = maps[2 * mip].size;
        mips[mip].resize(2 * size * size);
        for (std::size_t half = 0; half < 2 && 2 * mip + half < maps.size(); ++half) {
            const auto& texels = maps[2 * mip + half].texels;
            for (std::size_t y = 0; y < size; ++y)
                std::copy_n(texels.begin() + static_cast<std::ptrdiff_t>(y * size), size,
                            mips[mip].begin() + static_cast<std::ptrdiff_t>((2 * y + half) * size));
        }
        levels.emplace_back(mips[mip]);
    }
    return upload_levels(device, commands, 2 * maps.front().size, maps.front().size, levels);
}

/// A picture of more texels is stored with a shared exponent, 4 bytes a texel instead of 16: relative steps
/// of 2^-9, as its file mostly has.
constexpr std::size_t kLargePicture = std::size_t{1} << 25;
constexpr std::size_t kStagingBytes = std::size_t{1} << 26;

/// Row by row through a small staging buffer: a picture of 16384 texels takes gigabytes in any second copy.
template <class Texel, class Convert>
gpu::Image upload_rows(const gpu::Device& device, gpu::Commands& commands, const scene::Environment& e,
                       VkFormat format, const Convert& convert) {
    const std::size_t row_bytes = e.width * sizeof(Texel);
    const auto rows = static_cast<std::uint32_t>(
        std::min<std::size_t>(std::max<std::size_t>(kStagingBytes / row_bytes, 1), e.height));
    gpu::Buffer staging(device, rows * row_bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::MemoryKind::upload);
    gpu::Image image(device, {e.width, e.height, format, VK_IMAGE_USAGE_SAMPLED_BIT, 1});
    for (std::uint32_t first = 0; first < e.height; first += rows) {
        const std::uint32_t count = std::min(rows, e.height - first);
        const glm::vec3* from = e.luminance_nit.data() + std::size_t{first} * e.width;
        for (std::size_t i = 0; i < std::size_t{count} * e.width; ++i) {
            // What is not a number would be in all that is interpolated with it.
            const Texel texel = convert(glm::mix(from[i], glm::vec3(0.0f), glm::isnan(from[i])));
            std::memcpy(staging.mapped() + i * sizeof(Texel), &texel, sizeof(Texel));
        }
        commands.begin();
        commands.copy_rows(staging, image, first, count);
        if (first + count == e.height) commands.use(image, gpu::Use::sampled);
        commands.submit_and_wait();
    }
    return image;
}

gpu::Image upload_background(const gpu::Device& device, gpu::Commands& commands, const scene::Environment& e,
                             float units_per_nit) {
    if (e.luminance_nit.size() <= kLargePicture) {
        return upload_rows<glm::vec4>(device, commands, e, kFloat4,
                                      [&](const glm::vec3& t) { return glm::vec4(t * units_per_nit, 1.0f); });
    }
    return upload_rows<std::uint32_t>(
        device, commands, e, VK_FORMAT_E5B9G9R9_UFLOAT_PACK32, [&](const glm::vec3& t) {
            return glm::packF3x9_E1x5(glm::clamp(t * units_per_nit, glm::vec3(0.0f), glm::vec3(65408.0f)));
        });
}

/// Smooth levels are large and narrow: few samples; rough ones small and wide.
std::int32_t sample_count(int level) {
    return std::min(128 << (level / 2), 1024);
}

gpu::Image prefilter(const gpu::Device& device, gpu::Commands& commands, gpu::Image& source) {
    gpu::Image specular(device, {2 * shading::kSpecularSize, shading::kSpecularSize, kFloat4,
                                 VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT, kSpecularMips});
    const gpu::ComputePipeline pipeline = gpu::create_compute_pipeline(
        device, shaders::prefilter_comp,
        {{{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}},
         sizeof(PrefilterBlock)});
    const gpu::Owned<VkSampler> sampler = gpu::create_sampler(device, {});
    commands.begin();
    commands.begin_pass("prefilter");
    commands.use(source, gpu::Use::sampled);
    commands.use(specular, gpu::Use::storage_write);
    for (int level = 1; level < shading::kSpecularLevels; ++level) {
        const int size = shading::specular_level_size(level);
        const PrefilterBlock block{
            size,
            sample_count(level),
            shading::alpha_from_perceptual_roughness(shading::specular_level_roughness(level)),
            static_cast<float>(shading::kSpecularSize),
            static_cast<float>(kSourceLevels),
            level % 2 * size};
        const std::array bindings{
            gpu::bind_sampled(source.view(), sampler.get()),
            gpu::bind_storage(specular.mip_view(static_cast<std::uint32_t>(level / 2)))};
        const auto groups = static_cast<std::uint32_t>((size + 7) / 8);
        commands.dispatch(pipeline, bindings, gpu::push(block), groups, groups);
    }
    commands.copy_level(source, specular, 0);
    commands.use(specular, gpu::Use::sampled);
    commands.submit_and_wait();
    return specular;
}

}  // namespace

EnvironmentMaps prefilter_environment(const gpu::Device& device, gpu::Commands& commands,
                                      const scene::Environment& e) {
    // A processor that draws pictures does better with arithmetic of its own than with a shader's.
    return prefilter_environment(
        device, commands, e,
        device.info().kind == gpu::DeviceKind::cpu ? Prefilter::processor : Prefilter::device);
}

EnvironmentMaps prefilter_environment(const gpu::Device& device, gpu::Commands& commands,
                                      const scene::Environment& e, Prefilter where) {
    EnvironmentMaps maps;
    // Scaled so that the brightest texel is far from float's end when it is squared or summed on the way.
    maps.nit_per_unit = scene::unit_for_half(peak_of(e));
    const float units_per_nit = e.scale / maps.nit_per_unit;
    maps.background = upload_background(device, commands, e, units_per_nit);
    if (where == Prefilter::processor) {
        const OctahedralLight light = filter_octahedral(e, units_per_nit, kIrradianceSize);
        maps.specular = upload_specular(device, commands, light.specular);
        maps.irradiance = upload_levels(device, commands, {light.irradiance});
        return maps;
    }
    std::vector<OctahedralMap> source{from_equirect(e, units_per_nit, shading::kSpecularSize)};
    while (source.size() < kSourceLevels) source.push_back(halve(source.back()));
    gpu::Image source_image = upload_levels(device, commands, source);
    maps.specular = prefilter(device, commands, source_image);
    maps.irradiance =
        upload_levels(device, commands, {irradiance_over_pi(source[kIrradianceSource], kIrradianceSize)});
    return maps;
}

float upward_illuminance_lx(const scene::Environment& e) {
    return static_cast<float>(scene::upward_illuminance_lx(e));
}

}  // namespace candela::bake
