#include "candela/realtime/shadow_pass.hpp"

#include <algorithm>
#include <cstring>

#include "candela/realtime/mesh_pipelines.hpp"
#include "candela/realtime/visible_depths.hpp"
#include "candela_shaders/shadow_frag.hpp"
#include "candela_shaders/shadow_masked_frag.hpp"
#include "candela_shaders/shadow_vert.hpp"

namespace candela::realtime {
namespace {

/// Texels to a pixel of a still's cascades, which are drawn once for all of its samples.
constexpr float kStillTexels = 2.0f;

/// What a shadow needs to know of a material: nothing, or all that its mask depends on.
std::uint32_t shadow_features(const Draw& draw) {
    constexpr std::uint32_t of_masks =
        feature_alpha_mask | feature_base_color_texture | feature_vertex_color | feature_uv1;
    return draw.features & feature_alpha_mask ? draw.features & of_masks : 0;
}

bool casts(const Draw& draw) {
    return !draw.blended;
}

/// False when all corners of the box are beyond one side of the view.
bool in_view(const glm::mat4& world_to_clip, const scene::Aabb& box) {
    std::uint32_t outside = 0x1fu;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec4 p = world_to_clip * glm::vec4((corner & 1) ? box.max.x : box.min.x,
                                                      (corner & 2) ? box.max.y : box.min.y,
                                                      (corner & 4) ? box.max.z : box.min.z, 1.0f);
        outside &= (p.x < -p.w ? 1u : 0u) | (p.x > p.w ? 2u : 0u) | (p.y < -p.w ? 4u : 0u) |
                   (p.y > p.w ? 8u : 0u) | (p.z > p.w ? 16u : 0u);
    }
    return outside == 0;
}

/// Other sizes are worth a new atlas when one of them is wrong by more than a power of two.
bool still_fits(const std::vector<ShadowRequest>& planned, const std::vector<ShadowRequest>& wanted) {
    return std::equal(planned.begin(), planned.end(), wanted.begin(), wanted.end(),
                      [](const ShadowRequest& a, const ShadowRequest& b) {
                          return a.light == b.light && a.size <= 2 * b.size && b.size <= 2 * a.size;
                      });
}

std::vector<scene::Aabb> boxes_of(const GpuScene& gpu_scene) {
    std::vector<scene::Aabb> boxes;
    for (const Draw& draw : gpu_scene.draws) boxes.push_back(draw.world_bounds);
    return boxes;
}

/// Of the scene, then of emissive surfaces; none when nothing has shadows.
std::vector<scene::Light> lights_of(const FrameResources& frame, const GpuScene& gpu_scene,
                                    const scene::Scene& scene) {
    if (!frame.shadow_kinds) return {};
    std::vector<scene::Light> lights = scene.lights;
    const std::vector<scene::Light>& emissive = gpu_scene.light_list.emissive_shapes;
    lights.insert(lights.end(), emissive.begin(), emissive.end());
    return lights;
}

}  // namespace

std::uint32_t shadow_kind_bits(const scene::Scene& scene, std::span<const scene::Light> emissive_shapes) {
    std::uint32_t kinds = 0;
    const auto add = [&](const scene::Light& light) {
        if (!light.casts_shadow) return;
        const bool soft = scene::has_extent(light.type) || light.type == scene::LightType::line;
        kinds |= 1u << static_cast<std::uint32_t>(shadow_kind(light)) | (soft ? 8u : 16u);
    };
    std::for_each(scene.lights.begin(), scene.lights.end(), add);
    std::for_each(emissive_shapes.begin(), emissive_shapes.end(), add);
    return scene::world_bounds(scene).empty() ? 0 : kinds;
}

ShadowPass::ShadowPass(const gpu::Device& device, const FrameResources& frame, const GpuScene& gpu_scene,
                       const scene::Scene& scene, std::uint32_t atlas_texels)
    : device_(&device),
      budget_texels_(atlas_texels),
      bounds_(scene::world_bounds(scene)),
      boxes_(boxes_of(gpu_scene)),
      lights_(lights_of(frame, gpu_scene, scene)),
      visibility_(device, frame, lights_),
      first_emissive_(static_cast<std::uint32_t>(scene.lights.size())),
      layout_(device, {{{}, GpuScene::material_set_layout()}, 64}),
      descriptors_(device) {
    if (!frame.shadow_kinds) return;
    make_pipelines(frame, gpu_scene);
}

void ShadowPass::make_pipelines(const FrameResources& frame, const GpuScene& gpu_scene) {
    gpu::GraphicsDesc desc;
    desc.vertex = shaders::shadow_vert;
    describe_vertices(desc);
    desc.depth_format = kDepthFormat;
    // A surface stops light on both of its sides.
    desc.cull_back_faces = false;
    for (const Draw& draw : gpu_scene.draws) {
        if (!casts(draw)) continue;
        const std::uint32_t features = shadow_features(draw);
        if (!pipelines_.contains(features)) {
            ShadeVariant variant;
            variant.features = features;
            desc.constants = specialization(frame, variant);
            desc.fragment = features ? shaders::shadow_masked_frag : shaders::shadow_frag;
            pipelines_.emplace(features, gpu::create_graphics_pipeline(*device_, desc, layout_));
        }
        if (!features) continue;
        if (material_sets_.size() <= draw.material) material_sets_.resize(draw.material + 1);
        if (!material_sets_[draw.material]) {
            material_sets_[draw.material] =
                descriptors_.allocate(layout_, 1, gpu_scene.material_bindings(draw.material));
        }
    }
}

void ShadowPass::set_plan(gpu::Commands& commands, FrameResources& frame, GpuScene& gpu_scene,
                          ShadowPlan plan) {
    plan_ = std::move(plan);
    const std::uint32_t side = std::max(plan_.atlas_texels, 1u);
    if (frame.shadow_atlas.desc().width != side) {
        frame.shadow_atlas =
            gpu::Image(*device_, {side, side, kDepthFormat,
                                  VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT});
        fresh_atlas_ = true;
    }
    std::vector<int> slots(lights_.size(), -1);
    records_.assign(std::max<std::size_t>(1, plan_.lights.size()) * kRecordsPerLight, {});
    pending_.clear();
    cascades_.clear();
    for (std::size_t slot = 0; slot < plan_.lights.size(); ++slot) {
        const LightShadow& shadow = plan_.lights[slot];
        slots[shadow.light] = static_cast<int>(slot);
        if (shadow.kind == ShadowKind::cascades) continue;
        LightViews views = local_views(lights_[shadow.light], shadow);
        for (ShadowView& view : views.views) view.of_emissive_surface = shadow.light >= first_emissive_;
        set_records(slot, views.records);
        pending_.insert(pending_.end(), views.views.begin(), views.views.end());
    }
    gpu_scene.link_shadows(*device_, commands, slots);
    const std::size_t bytes = records_.size() * sizeof(ShadowRecord);
    if (frame.shadow_records.size() < bytes) {
        frame.shadow_records = gpu::Buffer(
            *device_, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
            gpu::MemoryKind::upload);
    }
    ShadowVisibilityPass::reserve(*device_, frame, plan_.lights.size());
}

void ShadowPass::set_records(std::size_t slot, std::span<const ShadowRecord> records) {
    ShadowRecord* out = &records_[slot * kRecordsPerLight];
    std::copy(records.begin(), records.end(), out);
    for (std::size_t i = 0; i < records.size(); ++i)
        out[i].extent.w = 1.0f / static_cast<float>(plan_.atlas_texels);
}

void ShadowPass::prepare(gpu::Commands& commands, FrameResources& frame, GpuScene& gpu_scene,
                         const scene::Camera& camera, bool moving) {
    if (!frame.shadow_kinds) return;
    const std::vector<ShadowRequest> wanted =
        shadow_requests(lights_, bounds_, camera, frame.width, frame.height, moving ? 1.0f : kStillTexels);
    if (!still_fits(planned_for_, wanted)) {
        planned_for_ = wanted;
        set_plan(commands, frame, gpu_scene,
                 plan_shadows(wanted, budget_texels_, ShadowVisibilityPass::most_lights(frame)));
    }
    const float aspect = static_cast<float>(frame.width) / static_cast<float>(frame.height);
    std::vector<ShadowView> cascades;
    const glm::vec2 visible_m = visible_depths_m(camera, aspect, boxes_);
    for (std::size_t slot = 0; slot < plan_.lights.size(); ++slot) {
        const LightShadow& shadow = plan_.lights[slot];
        if (shadow.kind != ShadowKind::cascades) continue;
        const LightViews views =
            cascade_views(lights_[shadow.light], shadow, camera, aspect, bounds_, visible_m);
        set_records(slot, views.records);
        cascades.insert(cascades.end(), views.views.begin(), views.views.end());
    }
    std::memcpy(frame.shadow_records.mapped(), records_.data(), records_.size() * sizeof(ShadowRecord));
    if (moving || cascades != cascades_) {
        pending_.insert(pending_.end(), cascades.begin(), cascades.end());
        cascades_ = std::move(cascades);
    }
}

gpu::ImageRef ShadowPass::add_maps(const FrameBuild& build) {
    if (!build.frame.shadow_kinds) return build.in.shadow_atlas;
    gpu::PassBuilder pass = build.graph.pass("shadows");
    pass.read(build.in.vertices, gpu::Use::vertex_input);
    pass.read(build.in.indices, gpu::Use::vertex_input);
    // Tiles that are up to date stay.
    const gpu::ImageRef maps = pass.write(build.in.shadow_atlas, gpu::Load::keep, gpu::Use::depth_target);
    pass.record([this, &frame = build.frame, &scene = build.scene](gpu::PassContext& c) {
        draw_pending(c.commands, frame, scene);
    });
    return maps;
}

gpu::BufferRef ShadowPass::add_visibility(const FrameBuild& build, const gpu::ImageRef& shadow_maps,
                                          const Surfaces& surfaces) const {
    if (!build.frame.shadow_kinds) return build.in.visibilities;
    return visibility_.add(build, shadow_maps, surfaces, plan_, lights_);
}

void ShadowPass::draw_pending(gpu::Commands& commands, FrameResources& frame, const GpuScene& gpu_scene) {
    if (pending_.empty()) return;
    const gpu::Load load = fresh_atlas_ ? gpu::Load::clear : gpu::Load::keep;
    commands.begin_rendering({}, gpu::DepthTarget{&frame.shadow_atlas, load});
    const auto& vk = device_->vk;
    const VkBuffer vertices = gpu_scene.vertices.handle();
    const VkDeviceSize zero = 0;
    vk.vkCmdBindVertexBuffers(commands.handle(), 0, 1, &vertices, &zero);
    vk.vkCmdBindIndexBuffer(commands.handle(), gpu_scene.indices.handle(), 0, VK_INDEX_TYPE_UINT32);
    vk.vkCmdSetFrontFace(commands.handle(), VK_FRONT_FACE_COUNTER_CLOCKWISE);
    for (const ShadowView& view : pending_) draw(commands, view, gpu_scene);
    commands.end_rendering();
    pending_.clear();
    fresh_atlas_ = false;
}

void ShadowPass::draw(gpu::Commands& commands, const ShadowView& view, const GpuScene& gpu_scene) {
    const auto& vk = device_->vk;
    const VkCommandBuffer buffer = commands.handle();
    const AtlasTile& tile = view.tile;
    const VkViewport viewport{static_cast<float>(tile.x),
                              static_cast<float>(tile.y),
                              static_cast<float>(tile.size),
                              static_cast<float>(tile.size),
                              0.0f,
                              1.0f};
    const VkRect2D area{{static_cast<std::int32_t>(tile.x), static_cast<std::int32_t>(tile.y)},
                        {tile.size, tile.size}};
    vk.vkCmdSetViewport(buffer, 0, 1, &viewport);
    vk.vkCmdSetScissor(buffer, 0, 1, &area);
    if (!fresh_atlas_) {
        const VkClearAttachment clear{VK_IMAGE_ASPECT_DEPTH_BIT, 0, {}};
        const VkClearRect rectangle{area, 0, 1};
        vk.vkCmdClearAttachments(buffer, 1, &clear, 1, &rectangle);
    }
    const Draw* last = nullptr;
    for (const Draw& d : gpu_scene.draws) {
        if (!casts(d) || !in_view(view.world_to_clip, d.world_bounds)) continue;
        // The surface that shines must not stand in its own light, and need not lie within the shape that it
        // is taken for.
        if (view.of_emissive_surface && (d.features & feature_emissive) != 0) continue;
        const std::uint32_t features = shadow_features(d);
        if (!last || shadow_features(*last) != features) {
            vk.vkCmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS,
                                 pipelines_.at(features).pipeline.get());
        }
        if (features && (!last || last->material != d.material)) {
            vk.vkCmdBindDescriptorSets(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.handle(), 1, 1,
                                       &material_sets_.at(d.material), 0, nullptr);
        }
        const glm::mat4 object_to_clip = view.world_to_clip * d.world;
        const auto bytes = gpu::push(object_to_clip);
        vk.vkCmdPushConstants(buffer, layout_.handle(), layout_.push_stages(), 0,
                              static_cast<std::uint32_t>(bytes.size()), bytes.data());
        vk.vkCmdDrawIndexed(buffer, d.index_count, 1, d.first_index, d.vertex_offset, 0);
        last = &d;
    }
}

}  // namespace candela::realtime
