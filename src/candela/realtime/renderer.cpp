#include "candela/realtime/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "candela/bake/ltc_table.hpp"
#include "candela/realtime/classify_pass.hpp"
#include "candela/realtime/cull_pass.hpp"
#include "candela/realtime/exposure_control.hpp"
#include "candela/realtime/exposure_meter.hpp"
#include "candela/realtime/forward_pass.hpp"
#include "candela/realtime/gbuffer_pass.hpp"
#include "candela/realtime/lighting_pass.hpp"
#include "candela/realtime/metering.hpp"
#include "candela/realtime/shadow_pass.hpp"
#include "candela/realtime/shape_pass.hpp"
#include "candela/realtime/still.hpp"
#include "candela/scene/half_range.hpp"
#include "shading/exposure.glsl"
#include "shading/sequence.glsl"

namespace candela::realtime {
namespace {

FrameResources create_frame(const gpu::Device& device, gpu::Commands& commands, const scene::Scene& scene,
                            const GpuScene& gpu_scene, const RendererOptions& options) {
    FrameResources frame;
    frame.width = options.width;
    frame.height = options.height;
    frame.tiles_x = groups(options.width, kTileSize);
    frame.tiles_y = groups(options.height, kTileSize);
    frame.most_storage_bytes = device.limits().maxStorageBufferRange;
    frame.profile = options.integrate ? integrand(options.profile) : options.profile;
    if (options.integrate) frame.integrate = options.integrate->strategy;
    // Blending of 32 bit floats is an option of Vulkan; only devices without it show stills of half floats.
    const bool blends_floats = !gpu_scene.any_blended ||
                               device.supports(kPictureFormat, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT);
    frame.half_light = (options.half_light || !blends_floats) && !options.integrate && !options.capture;
    frame.write_aovs = options.aovs;
    frame.has_environment = scene.environment.has_value();
    if (options.shadows.maps && !options.integrate)
        frame.shadow_kinds = shadow_kind_bits(scene, gpu_scene.light_list.emissive_shapes);
    frame.normal_mapped = gpu_scene.any_normal_mapped;
    frame.all_targets =
        gpu_scene.any_emissive || gpu_scene.any_layered || options.aovs || frame.normal_mapped;

    const auto one_texel = [&](VkFormat format, VkImageUsageFlags usage) {
        return gpu::Image(device, {1, 1, format, usage | VK_IMAGE_USAGE_SAMPLED_BIT});
    };
    frame.no_layers = one_texel(kGBufferFormat, 0);
    frame.no_normals = one_texel(kSurfaceNormalFormat, 0);
    frame.has_unlit = gpu_scene.any_unlit && !options.capture;
    frame.shadow_atlas = one_texel(kDepthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    frame.shadow_records = gpu::Buffer(device, sizeof(ShadowRecord), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                       gpu::MemoryKind::upload);
    frame.visibilities = gpu::Buffer(device, sizeof(std::uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                     gpu::MemoryKind::device);
    frame.frame_block =
        gpu::Buffer(device, sizeof(FrameBlock), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, gpu::MemoryKind::upload);

    frame.clamp = gpu::create_sampler(device, {});
    gpu::SamplerDesc repeat_u;
    repeat_u.wrap_u = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    frame.repeat_u = gpu::create_sampler(device, repeat_u);
    gpu::SamplerDesc nearest;
    nearest.magnify = nearest.minify = VK_FILTER_NEAREST;
    nearest.mip = VK_SAMPLER_MIPMAP_MODE_NEAREST;
    frame.nearest = gpu::create_sampler(device, nearest);

    frame.dfg = bake::create_dfg_table(device, commands,
                                       options.profile.visibility == VisibilityTechnique::smith_correlated
                                           ? bake::DfgModel::smith_correlated
                                           : bake::DfgModel::ue4_schlick_smith);
    const bool ltc = frame.profile.area_specular == AreaSpecularTechnique::ltc;
    frame.ltc = ltc && (gpu_scene.light_list.kinds & kAreaKinds) != 0
                    ? bake::create_ltc_table(device, commands)
                    : one_texel(kPictureFormat, 0);
    create_light_lists(device, commands, gpu_scene, options.cull_lights && !options.integrate, frame);
    // Not as one expression: it would copy the picture.
    frame.environment = scene.environment
                            ? bake::prefilter_environment(device, commands, *scene.environment)
                            : bake::prefilter_environment(device, commands, bake::constant_environment(0.0f));
    frame.integrate_tables = upload_integrate_tables(device, commands, scene, options.integrate);
    if (!options.integrate) frame.local.bits = local_light_bits(scene, options.capture);
    upload_local_light(device, commands, scene.reflection_probes, scene.irradiance_volumes, frame.local);
    return frame;
}

/// Rays from the camera through the picture, linear in the pixel.
void write_rays(FrameBlock& block, const glm::vec2& size) {
    const glm::vec3 backward(block.camera_backward);
    const glm::dmat4 clip_to_world = glm::inverse(glm::dmat4(block.world_to_clip));
    const auto through = [&](float x, float y) {
        if (block.camera_position.w < 0.5f) return -backward;
        const glm::dvec4 clip(x / size.x * 2.0f - 1.0f, y / size.y * 2.0f - 1.0f, 0.5, 1.0);
        const glm::dvec4 p = clip_to_world * clip;
        const glm::vec3 ray(glm::dvec3(p) / p.w - glm::dvec3(block.camera_position));
        // Only rays that end on one plane differ linearly from pixel to pixel.
        return ray / -glm::dot(ray, backward);
    };
    const glm::vec3 origin = through(0.5f, 0.5f);
    block.ray = glm::vec4(origin, 0.0f);
    block.ray_dx = glm::vec4((through(size.x - 0.5f, 0.5f) - origin) / std::max(size.x - 1.0f, 1.0f), 0.0f);
    block.ray_dy = glm::vec4((through(0.5f, size.y - 0.5f) - origin) / std::max(size.y - 1.0f, 1.0f), 0.0f);
}

/// Where the lists of lights are. The cells before the camera run from the nearest to the farthest point of
/// the scene's bounds.
void write_light_places(FrameBlock& block, const FrameResources& frame, const GpuScene& scene,
                        const scene::Aabb& bounds) {
    const LightListPlaces& places = frame.light_places;
    const std::vector<LightBlock>& lights = scene.light_list.blocks;
    const auto sun = std::find_if(lights.begin(), lights.end(), [](const LightBlock& light) {
        return light.color_type.w == static_cast<float>(LightKind::sun);
    });
    block.lights =
        glm::ivec4(places.first_all, places.first_room, places.room, static_cast<int>(sun - lights.begin()));
    block.light_cells = glm::ivec4(places.cells, places.first_cell);
    float near_m = 1e30f;
    float far_m = 0.0f;
    for (int i = 0; i < 8 && !bounds.empty(); ++i) {
        const glm::vec3 corner((i & 1) != 0 ? bounds.max.x : bounds.min.x,
                               (i & 2) != 0 ? bounds.max.y : bounds.min.y,
                               (i & 4) != 0 ? bounds.max.z : bounds.min.z);
        const float depth_m =
            glm::dot(glm::vec3(block.camera_position) - corner, glm::vec3(block.camera_backward));
        near_m = std::min(near_m, depth_m);
        far_m = std::max(far_m, depth_m);
    }
    near_m = std::max(near_m, std::max(1e-3f * far_m, 1e-3f));
    const float stops = std::log(std::max(far_m / near_m, 1.1f));
    block.light_slices =
        glm::vec4(near_m, static_cast<float>(std::max(places.cells.z, 1)) / stops, 0.0f, 0.0f);
}

}  // namespace

struct Renderer::State {
    State(const gpu::Device& device_in, const scene::Scene& scene, const RendererOptions& options_in)
        : device(&device_in),
          options(options_in),
          commands(device_in),
          gpu_scene(device_in, commands, scene, !options_in.integrate, !options_in.integrate,
                    options_in.profile.fully_rough),
          frame(create_frame(device_in, commands, scene, gpu_scene, options_in)),
          shadows(device_in, frame, gpu_scene, scene, options_in.shadows.atlas_texels),
          gbuffer(device_in, frame, gpu_scene),
          shapes(device_in, frame, gpu_scene),
          classify(device_in, frame, gpu_scene),
          cull(device_in, frame),
          lighting(device_in, frame, gpu_scene),
          forward(device_in, frame, gpu_scene),
          metering(device_in),
          light_limits(estimate_light(scene)),
          scene_bounds(scene::world_bounds(scene)) {
        if (!scene.reflection_probes.empty()) volumes = scene.irradiance_volumes;
        if (scene.environment) {
            environment_rotation_rad = scene.environment->rotation_rad;
            environment_scale = scene.environment->scale;
            environment_visible = scene.environment->visible;
        }
    }

    /// The light buffer's exposure is the picture's (Frostbite 5.2). With half floats up to 6 stops less,
    /// where that brings the brightest thing that can be seen into them: a display's black still has 16 steps
    /// then. What is brighter is clamped.
    [[nodiscard]] float pre_exposure(float exposure) const {
        if (!frame.half_light || !(light_limits.peak_nit > 0.0f)) return exposure;
        return std::clamp(scene::kLargestHalfUnits / light_limits.peak_nit, exposure / 64.0f, exposure);
    }

    void write_frame_block(const scene::Camera& camera, float pre, const glm::vec2& jitter_px,
                           float footprint, std::uint32_t sample, std::uint32_t draws);
    /// The graph of a kind of frame, made when it is first needed.
    template <class Build>
    gpu::FrameGraph& graph(std::unique_ptr<gpu::FrameGraph>& of, const Build& build);
    /// Draws a frame: prepares what follows the camera, executes, waits.
    void execute(gpu::FrameGraph& graph, const scene::Camera& camera, bool moving);
    [[nodiscard]] float meter(const scene::Camera& camera, bool moving, bool& found);

    const gpu::Device* device;
    RendererOptions options;
    gpu::Commands commands;
    GpuScene gpu_scene;
    FrameResources frame;
    ShadowPass shadows;
    GBufferPass gbuffer;
    ShapePass shapes;
    ClassifyPass classify;
    CullPass cull;
    LightingPass lighting;
    ForwardPass forward;
    MeteringPass metering;
    std::optional<PicturePass> picture;
    std::optional<PresentPass> present;
    FrameView view;
    std::shared_ptr<gpu::TransientMemory> memory = std::make_shared<gpu::TransientMemory>();
    std::unique_ptr<gpu::FrameGraph> metered_frame;
    std::unique_ptr<gpu::FrameGraph> still_sample;
    std::unique_ptr<gpu::FrameGraph> shown_frame;
    std::unique_ptr<gpu::FrameGraph> shown_metered_frame;
    std::unique_ptr<gpu::FrameGraph> captured_view;
    gpu::ImageRef captured_light;
    LightEstimate light_limits;
    scene::Aabb scene_bounds;
    std::vector<scene::IrradianceVolume> volumes;  ///< to be uploaded again beside other probes
    float environment_rotation_rad = 0.0f;
    float environment_scale = 1.0f;
    bool environment_visible = true;
    std::optional<float> followed_ev100;
};

void Renderer::State::write_frame_block(const scene::Camera& camera, float pre, const glm::vec2& jitter_px,
                                        float footprint, std::uint32_t sample, std::uint32_t draws) {
    const float aspect = static_cast<float>(frame.width) / static_cast<float>(frame.height);
    glm::mat4 shift(1.0f);
    shift[3][0] = 2.0f * jitter_px.x / static_cast<float>(frame.width);
    shift[3][1] = 2.0f * jitter_px.y / static_cast<float>(frame.height);
    FrameBlock block{};
    block.world_to_clip = shift * scene::view_projection(camera, aspect);
    block.clip_to_world = glm::mat4(glm::inverse(glm::dmat4(block.world_to_clip)));
    block.camera_position = glm::vec4(glm::vec3(camera.world[3]),
                                      camera.projection == scene::Projection::perspective ? 1.0f : 0.0f);
    block.camera_backward = glm::vec4(glm::normalize(glm::vec3(camera.world[2])), 0.0f);
    block.exposure = glm::vec4(pre, 1.0f / pre, footprint, frame.light_limit());
    block.environment = glm::vec4(std::cos(environment_rotation_rad), std::sin(environment_rotation_rad),
                                  frame.environment.nit_per_unit, environment_visible ? 1.0f : 0.0f);
    block.size = glm::ivec4(frame.width, frame.height, gpu_scene.light_count, 0);
    block.tiles = glm::ivec4(frame.tiles_x, frame.tiles_y, frame.tile_count(), frame.has_unlit ? 1 : 0);
    write_light_places(block, frame, gpu_scene, scene_bounds);
    block.random = glm::uvec4(sample, options.seed, draws, 0);
    write_rays(block, glm::vec2(frame.width, frame.height));
    std::memcpy(frame.frame_block.mapped(), &block, sizeof(block));
}

template <class Build>
gpu::FrameGraph& Renderer::State::graph(std::unique_ptr<gpu::FrameGraph>& of, const Build& build) {
    if (of) return *of;
    auto made = std::make_unique<gpu::FrameGraph>(*device, memory);
    build(FrameBuild{*made, frame, gpu_scene, view, import_inputs(*made, frame, gpu_scene)},
          FramePasses{shadows, gbuffer, shapes, classify, cull, lighting, forward});
    made->compile();
    of = std::move(made);
    return *of;
}

void Renderer::State::execute(gpu::FrameGraph& graph, const scene::Camera& camera, bool moving) {
    view.camera = &camera;
    shadows.prepare(commands, frame, gpu_scene, camera, moving);
    commands.begin();
    graph.execute(commands);
    commands.submit_and_wait();
}

float Renderer::State::meter(const scene::Camera& camera, bool moving, bool& found) {
    const float guess = shading::ev100_from_luminance(std::max(light_limits.typical_nit, 1e-6f));
    const std::optional<float> metered = meter_ev100(guess, [&](float pre) {
        write_frame_block(camera, pre, glm::vec2(0.0f), 1.0f, 0, kMeterDraws);
        execute(graph(metered_frame,
                      [&](const FrameBuild& build, const FramePasses& passes) {
                          build_metered_frame(build, passes, metering);
                      }),
                camera, moving);
        return metering.bins();
    });
    found = metered.has_value();
    return metered.value_or(guess);
}

Renderer::Renderer(const gpu::Device& device, const scene::Scene& scene, const RendererOptions& options)
    : state_(std::make_unique<State>(device, scene, options)) {}

Renderer::~Renderer() = default;

void Renderer::set_reflection_probes(std::span<const scene::ReflectionProbe> probes) {
    State& s = *state_;
    upload_local_light(*s.device, s.commands, probes, s.volumes, s.frame.local);
}

std::vector<glm::vec4> Renderer::capture_view(const scene::Camera& camera) {
    State& s = *state_;
    const std::size_t pixels = std::size_t{s.frame.width} * s.frame.height;
    gpu::Buffer read(*s.device, pixels * sizeof(glm::vec4), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                     gpu::MemoryKind::readback);
    s.write_frame_block(camera, 1.0f, glm::vec2(0.0f), 1.0f, 0, kMeterDraws);
    gpu::FrameGraph& graph =
        s.graph(s.captured_view, [&](const FrameBuild& build, const FramePasses& passes) {
            s.captured_light = build_captured_view(build, passes);
        });
    s.execute(graph, camera, false);
    s.commands.begin();
    s.commands.copy(graph.image(s.captured_light), read);
    s.commands.submit_and_wait();
    const std::span<const glm::vec4> texels = read.mapped_as<const glm::vec4>();
    return {texels.begin(), texels.begin() + static_cast<std::ptrdiff_t>(pixels)};
}

std::uint32_t Renderer::unshadowed_lights() const {
    return state_->shadows.unshadowed();
}

Still Renderer::render_still(const scene::Camera& camera, const scene::Exposure& exposure) {
    State& s = *state_;
    if (!s.picture) s.picture.emplace(*s.device, s.frame);
    gpu::FrameGraph& graph = s.graph(s.still_sample, [&](const FrameBuild& build, const FramePasses& passes) {
        build_still_sample(build, passes, *s.picture);
    });
    Still still;
    still.width = s.frame.width;
    still.height = s.frame.height;
    still.ev100 = exposure.automatic() ? s.meter(camera, false, still.metered) : manual_ev100(exposure);
    still.ev100 -= exposure.compensation_ev;
    still.exposure = exposure_at(still.ev100, s.options.profile.exposure);

    const float pre = s.pre_exposure(still.exposure);
    const std::uint32_t samples = std::max(1u, s.options.samples);
    const float footprint = 1.0f / std::sqrt(static_cast<float>(samples));
    const std::uint32_t draws = s.options.integrate ? s.options.integrate->draws : 1;
    for (std::uint32_t i = 0; i < samples; ++i) {
        const glm::vec2 jitter =
            samples == 1 ? glm::vec2(0.0f) : shading::sobol_owen(i, s.options.seed) - glm::vec2(0.5f);
        s.write_frame_block(camera, pre, jitter, footprint, i, draws);
        s.view.nit_per_unit = 1.0f / pre;
        s.view.first_sample = i == 0;
        s.execute(graph, camera, false);
        if (s.options.progress) s.options.progress(double(i + 1) / double(samples));
    }
    still.pass_times = s.commands.pass_times();
    still.planes = s.picture->read(s.commands, graph, samples);
    add_unlit(still);
    return still;
}

std::vector<gpu::PassTime> Renderer::render_frame(const scene::Camera& camera,
                                                  const scene::Exposure& exposure) {
    State& s = *state_;
    if (!s.present) s.present.emplace(*s.device, s.frame, s.options.tone_curve);
    std::unique_ptr<gpu::FrameGraph>& shown = exposure.automatic() ? s.shown_metered_frame : s.shown_frame;
    gpu::FrameGraph& graph = s.graph(shown, [&](const FrameBuild& build, const FramePasses& passes) {
        build_shown_frame(build, passes, exposure.automatic() ? &s.metering : nullptr, *s.present);
    });
    float ev100 = 0.0f;
    bool found = false;
    if (!exposure.automatic()) {
        ev100 = manual_ev100(exposure);
    } else {
        if (!s.followed_ev100) s.followed_ev100 = s.meter(camera, true, found);
        ev100 = *s.followed_ev100;
    }
    const float wanted = exposure_at(ev100 - exposure.compensation_ev, s.options.profile.exposure);
    const float pre = s.pre_exposure(wanted);
    s.write_frame_block(camera, pre, glm::vec2(0.0f), 1.0f, 0, kMeterDraws);
    s.view.exposure_change = wanted / pre;
    s.execute(graph, camera, true);
    if (!exposure.automatic()) return s.commands.pass_times();
    if (const std::optional<MeterReading> reading = read_meter(s.metering.bins()))
        s.followed_ev100 = shading::ev100_from_luminance(std::exp2(reading->stops) / pre);
    return s.commands.pass_times();
}

std::string Renderer::frame_graph(GraphPicture picture, std::span<const gpu::PassTime> times) const {
    const gpu::FrameGraph& graph =
        state_->shown_metered_frame ? *state_->shown_metered_frame : *state_->shown_frame;
    return picture == GraphPicture::svg ? gpu::graph_svg(graph, times) : gpu::graph_dot(graph, times);
}

}  // namespace candela::realtime
