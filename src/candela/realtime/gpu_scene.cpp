#include "candela/realtime/gpu_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <future>
#include <glm/matrix.hpp>
#include <map>
#include <thread>

#include "candela/realtime/light_block.hpp"
#include "candela/realtime/material_block.hpp"
#include "candela/realtime/mipmaps.hpp"
#include "candela/realtime/opacity.hpp"

namespace candela::realtime {
namespace {

std::int16_t snorm16(float x) {
    return static_cast<std::int16_t>(std::lround(std::clamp(x, -1.0f, 1.0f) * 32767.0f));
}
std::uint16_t unorm16(float x) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(x, 0.0f, 1.0f) * 65535.0f));
}

Vertex make_vertex(const scene::Primitive& p, std::size_t i) {
    Vertex v;
    v.position = p.positions[i];
    for (int c = 0; c < 3; ++c) v.normal[c] = snorm16(p.normals[i][c]);
    if (!p.tangents.empty()) {
        for (int c = 0; c < 4; ++c) v.tangent[c] = snorm16(p.tangents[i][c]);
    }
    if (!p.uv[0].empty()) v.uv0 = p.uv[0][i];
    if (!p.uv[1].empty()) v.uv1 = p.uv[1][i];
    for (int c = 0; c < 4; ++c) v.color[c] = p.colors.empty() ? 65535 : unorm16(p.colors[i][c]);
    return v;
}

BlendedSurface blended_surface(const scene::Primitive& p) {
    BlendedSurface surface;
    surface.indices = p.indices;
    for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
        surface.centroids.push_back(
            (p.positions[p.indices[i]] + p.positions[p.indices[i + 1]] + p.positions[p.indices[i + 2]]) /
            3.0f);
    }
    return surface;
}

/// A 1 x 1 white texel stands in for every absent texture, so that each binding is valid.
const scene::Image& white_image() {
    static const scene::Image image{"white", 1, 1, {255, 255, 255, 255}};
    return image;
}

VkSamplerAddressMode address_mode(scene::Wrap wrap) {
    switch (wrap) {
        case scene::Wrap::mirrored_repeat:
            return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
        case scene::Wrap::clamp_to_edge:
            return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
        default:
            return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    }
}

VkFilter filter(scene::Filter f) {
    return f == scene::Filter::nearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
}

gpu::SamplerDesc sampler_desc(const scene::Sampler& sampler) {
    gpu::SamplerDesc desc;
    desc.magnify = filter(sampler.magnify);
    desc.minify = filter(sampler.minify);
    desc.mip = sampler.mip == scene::MipFilter::linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR
                                                       : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    desc.wrap_u = address_mode(sampler.wrap_s);
    desc.wrap_v = address_mode(sampler.wrap_t);
    if (sampler.mip == scene::MipFilter::none)
        desc.max_lod = 0.25f;  // the specification's way to name level 0 only
    const bool all_linear = sampler.magnify == scene::Filter::linear &&
                            sampler.minify == scene::Filter::linear &&
                            sampler.mip == scene::MipFilter::linear;
    desc.anisotropy = all_linear ? 8.0f : 1.0f;
    return desc;
}

/// As the path tracer reads textures: the file's texels, whatever the distance.
gpu::SamplerDesc unfiltered(const scene::Sampler& sampler) {
    scene::Sampler level0 = sampler;
    level0.minify = sampler.magnify;
    level0.mip = scene::MipFilter::none;
    return sampler_desc(level0);
}

using MipChain = std::vector<std::vector<std::uint8_t>>;

gpu::Image upload_image(const gpu::Device& device, gpu::Commands& commands, const scene::Image& source,
                        const MipOptions& options, const MipChain& levels) {
    const bool srgb = options.content == TexelContent::color;
    std::size_t bytes = 0;
    for (const auto& level : levels) bytes += level.size();
    gpu::Buffer staging(device, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::MemoryKind::upload);
    gpu::Image image(device,
                     {source.width, source.height, srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM,
                      VK_IMAGE_USAGE_SAMPLED_BIT, static_cast<std::uint32_t>(levels.size())});
    commands.begin();
    std::size_t offset = 0;
    for (std::uint32_t level = 0; level < levels.size(); ++level) {
        std::memcpy(staging.mapped() + offset, levels[level].data(), levels[level].size());
        commands.copy(staging, image, level, offset);
        offset += levels[level].size();
    }
    commands.use(image, gpu::Use::sampled);
    commands.submit_and_wait();
    return image;
}

struct ImageUse {
    const scene::Image* image;
    MipOptions options;
};

/// Makes mip chains ahead, one a processor, and hands them to upload(use, levels) in order.
template <class Upload>
void for_each_mip_chain(const std::vector<ImageUse>& uses, std::size_t max_levels, const Upload& upload) {
    const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
    std::deque<std::future<MipChain>> ahead;
    std::size_t started = 0;
    for (const ImageUse& use : uses) {
        for (; started < uses.size() && ahead.size() < processors; ++started) {
            ahead.push_back(std::async(std::launch::async, [next = uses[started], max_levels] {
                return mip_chain(*next.image, next.options, max_levels);
            }));
        }
        const MipChain levels = ahead.front().get();
        ahead.pop_front();
        upload(use, levels);
    }
}

}  // namespace

GpuScene::GpuScene(const gpu::Device& device, gpu::Commands& commands, const scene::Scene& scene,
                   bool with_emissive, bool filtered_textures, scene::FullyRoughRule fully_rough)
    : light_list(realtime::light_list(scene, with_emissive)) {
    upload_geometry(device, commands, scene, fully_rough);
    upload_textures(device, commands, scene, filtered_textures);
    upload_materials(device, commands, scene);
    upload_lights(device, commands);
    visible_shapes = static_cast<std::uint32_t>(shape_lights(light_list).size());
}

void GpuScene::upload_geometry(const gpu::Device& device, gpu::Commands& commands, const scene::Scene& scene,
                               scene::FullyRoughRule fully_rough) {
    std::vector<Vertex> all_vertices;
    std::vector<std::uint32_t> all_indices;
    std::vector<std::vector<Draw>> mesh_draws(scene.meshes.size());
    const Opacity opacity(scene);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        for (const scene::Primitive& p : scene.meshes[m].primitives) {
            if (p.indices.empty()) continue;
            Draw draw;
            draw.first_index = static_cast<std::uint32_t>(all_indices.size());
            draw.index_count = static_cast<std::uint32_t>(p.indices.size());
            draw.vertex_offset = static_cast<std::int32_t>(all_vertices.size());
            draw.material = p.material;
            draw.world_bounds = p.bounds;
            draw.world_center = p.bounds.empty() ? glm::vec3(0.0f) : 0.5f * (p.bounds.min + p.bounds.max);
            const scene::Material& material = scene.materials[p.material];
            draw.features = material_features(material, fully_rough);
            if (!p.colors.empty()) draw.features |= feature_vertex_color;
            draw.blended = opacity.needs_blending(p);
            if (draw.blended) {
                draw.blended_surface = static_cast<std::uint32_t>(blended_surfaces.size());
                blended_surfaces.push_back(blended_surface(p));
            }
            mesh_draws[m].push_back(draw);
            for (std::size_t i = 0; i < p.positions.size(); ++i) all_vertices.push_back(make_vertex(p, i));
            all_indices.insert(all_indices.end(), p.indices.begin(), p.indices.end());
        }
    }
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const scene::Instance& instance = scene.instances[i];
        for (Draw draw : mesh_draws[instance.mesh]) {
            draw.instance = i;
            draw.world = instance.world;
            draw.world_center = glm::vec3(instance.world * glm::vec4(draw.world_center, 1.0f));
            draw.world_bounds = transformed(draw.world_bounds, instance.world);
            draw.mirrored = glm::determinant(glm::mat3(instance.world)) < 0.0f;
            any_unlit |= (draw.features & feature_unlit) != 0;
            any_blended |= draw.blended;
            constexpr std::uint32_t mapped = feature_normal_texture | feature_clearcoat_normal_texture;
            any_normal_mapped |= (draw.features & mapped) != 0 && (draw.features & feature_unlit) == 0;
            if (!draw.blended) {
                any_emissive |= (draw.features & (feature_emissive | feature_unlit)) != 0;
                any_layered |= (draw.features & feature_layered) != 0;
            }
            draws.push_back(draw);
        }
    }
    // Draws that share a pipeline and a material stand together, so that state changes are few.
    std::stable_sort(draws.begin(), draws.end(), [](const Draw& a, const Draw& b) {
        return std::tie(a.blended, a.features, a.material) < std::tie(b.blended, b.features, b.material);
    });
    if (all_vertices.empty()) return;
    vertices = gpu::upload_buffer(device, commands, std::as_bytes(std::span(all_vertices)),
                                  VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    indices = gpu::upload_buffer(device, commands, std::as_bytes(std::span(all_indices)),
                                 VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
}

void GpuScene::upload_textures(const gpu::Device& device, gpu::Commands& commands, const scene::Scene& scene,
                               bool filtered) {
    std::vector<ImageUse> uses{{&white_image(), {}}};
    samplers_.push_back(gpu::create_sampler(device, {}));

    std::map<std::pair<std::uint32_t, MipOptions>, std::uint32_t> known_images;
    struct KnownSampler {
        scene::Sampler sampler;
        bool cutout;
        std::uint32_t index;
    };
    std::vector<KnownSampler> known_samplers;
    const auto image_of = [&](std::uint32_t index, const MipOptions& options) {
        if (index >= scene.images.size() || scene.images[index].rgba.empty()) return 0u;
        const auto [entry, fresh] =
            known_images.try_emplace({index, options}, static_cast<std::uint32_t>(uses.size()));
        if (fresh) uses.push_back({&scene.images[index], options});
        return entry->second;
    };
    const auto sampler_of = [&](const scene::Sampler& sampler, bool cutout) {
        for (const KnownSampler& known : known_samplers) {
            if (known.sampler == sampler && known.cutout == cutout) return known.index;
        }
        gpu::SamplerDesc desc = filtered ? sampler_desc(sampler) : unfiltered(sampler);
        // Coverage is kept for bilinear reading; a wider average brings alpha below the cutoff again.
        if (cutout) desc.anisotropy = 1.0f;
        const auto index = static_cast<std::uint32_t>(samplers_.size());
        samplers_.push_back(gpu::create_sampler(device, desc));
        known_samplers.push_back({sampler, cutout, index});
        return index;
    };
    for (const scene::Material& material : scene.materials) {
        std::array<TextureSlot, kMaterialTextures> slots{};
        const auto refs = texture_refs(material);
        for (std::size_t slot = 0; slot < refs.size(); ++slot) {
            if (!*refs[slot] || refs[slot]->texture >= scene.textures.size()) continue;
            const scene::Texture& texture = scene.textures[refs[slot]->texture];
            const MipOptions options = mip_options(slot, material);
            slots[slot] = {image_of(texture.image, options),
                           sampler_of(texture.sampler, options.alpha == AlphaUse::cutout)};
        }
        material_textures_.push_back(slots);
    }
    for_each_mip_chain(uses, filtered ? kAllLevels : 1, [&](const ImageUse& use, const MipChain& levels) {
        images_.push_back(upload_image(device, commands, *use.image, use.options, levels));
    });
}

void GpuScene::upload_materials(const gpu::Device& device, gpu::Commands& commands,
                                const scene::Scene& scene) {
    const VkDeviceSize alignment =
        std::max<VkDeviceSize>(16, device.limits().minUniformBufferOffsetAlignment);
    material_bytes_ = sizeof(MaterialBlock);
    material_stride_ = (sizeof(MaterialBlock) + alignment - 1) / alignment * alignment;
    std::vector<std::byte> bytes(std::max<std::size_t>(1, scene.materials.size()) * material_stride_);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const MaterialBlock block = material_block(scene.materials[i]);
        std::memcpy(bytes.data() + i * material_stride_, &block, sizeof(block));
    }
    materials = gpu::upload_buffer(device, commands, bytes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
}

void GpuScene::upload_lights(const gpu::Device& device, gpu::Commands& commands) {
    const auto upload = [&](auto list) {
        if (list.empty()) list.emplace_back();
        return gpu::upload_buffer(device, commands, std::as_bytes(std::span(list)),
                                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    };
    light_count = static_cast<std::uint32_t>(light_list.blocks.size());
    lights = upload(light_list.blocks);
    light_reaches = upload(light_list.reaches);
    light_tables = upload(light_list.tables);
}

void GpuScene::link_shadows(const gpu::Device& device, gpu::Commands& commands, std::span<const int> places) {
    if (light_list.blocks.empty()) return;
    for (std::size_t i = 0; i < light_list.blocks.size(); ++i) {
        const std::uint32_t source = light_list.sources[i];
        if (source < places.size()) light_list.blocks[i].links.z = places[source];
    }
    lights = gpu::upload_buffer(device, commands, std::as_bytes(std::span(light_list.blocks)),
                                VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

std::vector<VkDescriptorType> GpuScene::material_set_layout() {
    std::vector<VkDescriptorType> types{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER};
    types.insert(types.end(), kMaterialTextures, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    return types;
}

std::vector<gpu::Binding> GpuScene::material_bindings(std::uint32_t material) const {
    gpu::Binding block = gpu::bind_buffer(materials);
    block.offset = material * material_stride_;
    block.range = material_bytes_;
    std::vector<gpu::Binding> bindings{block};
    for (const TextureSlot& slot : material_textures_.at(material)) {
        bindings.push_back(
            gpu::bind_sampled(images_.at(slot.image).view(), samplers_.at(slot.sampler).get()));
    }
    return bindings;
}

}  // namespace candela::realtime
