#include "candela/realtime/lighting_pass.hpp"

#include "candela/realtime/lighting_variant.hpp"
#include "candela_shaders/integrate_comp.hpp"
#include "candela_shaders/lighting_comp.hpp"
#include "candela_shaders/lighting_half_comp.hpp"
#include "candela_shaders/lighting_half_plain_comp.hpp"
#include "candela_shaders/lighting_half_shadows_comp.hpp"
#include "candela_shaders/lighting_plain_comp.hpp"
#include "candela_shaders/lighting_shadows_comp.hpp"

namespace candela::realtime {
namespace {

gpu::LayoutDesc layout() {
    std::vector<VkDescriptorType> types = shading_set_layout();
    types.insert(types.end(), 3, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);  // G-buffer, layers, depth
    types.push_back(VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);                        // light
    types.push_back(VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);                       // tiles
    types.insert(types.end(), kLightingAovs, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    types.push_back(VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);           // unlit
    types.push_back(VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);  // normals without maps
    return {{types}, 0};
}

std::string pass_name(ShadingClass shading_class, bool integrate) {
    const std::string name = integrate ? "integrate" : "lighting";
    switch (shading_class) {
        case ShadingClass::background:
            return "background";
        case ShadingClass::layered:
            return name + ", layered";
        case ShadingClass::unlit:
            return "unlit";
        default:
            return name;
    }
}

}  // namespace

LightingPass::LightingPass(const gpu::Device& device, const FrameResources& frame, const GpuScene& scene) {
    const LightingVariants full{shaders::lighting_plain_comp, shaders::lighting_shadows_comp,
                                shaders::lighting_comp};
    const LightingVariants half{shaders::lighting_half_plain_comp, shaders::lighting_half_shadows_comp,
                                shaders::lighting_half_comp};
    const LightingVariants& variants = frame.half_light ? half : full;
    const gpu::SpirV code = frame.integrate ? shaders::integrate_comp : choose(variants, frame, scene);
    const auto add = [&](ShadingClass shading_class) {
        ShadeVariant variant;
        variant.shading_class = shading_class;
        variant.layers = shading_class == ShadingClass::layered;
        variant.light_kinds = scene.light_list.kinds;
        variant.emissive = scene.any_emissive;
        const bool unlit = shading_class == ShadingClass::background || shading_class == ShadingClass::unlit;
        pipelines_.push_back({shading_class, gpu::create_compute_pipeline(
                                                 device, unlit && !frame.integrate ? variants.plain : code,
                                                 layout(), specialization(frame, variant))});
    };
    add(ShadingClass::background);
    bool standard = false;
    for (const Draw& draw : scene.draws) standard |= (draw.features & (feature_layered | feature_unlit)) == 0;
    if (standard) add(ShadingClass::standard);
    if (scene.any_layered) add(ShadingClass::layered);
    if (frame.write_aovs || scene.any_unlit) add(ShadingClass::unlit);
}

Lit LightingPass::add(const FrameBuild& build, const Surfaces& surfaces, const Tiles& tiles) const {
    FrameResources& frame = build.frame;
    GpuScene& scene = build.scene;
    gpu::PassBuilder pass = build.graph.pass("lighting");
    read_shading_inputs(pass, build.in);
    for (const gpu::ImageRef& image : {surfaces.gbuffer, surfaces.layers, surfaces.normals, surfaces.depth})
        pass.read(image);
    pass.read(tiles.lists, gpu::Use::indirect_and_storage_read);
    const auto kept = [](const gpu::ImageRef& image) {
        return image.version > 0 ? gpu::Load::keep : gpu::Load::discard;
    };
    Lit lit;
    lit.light = pass.write(surfaces.light, kept(surfaces.light));
    lit.unlit = pass.write(surfaces.unlit, kept(surfaces.unlit));
    for (std::size_t i = 0; i < kAovCount; ++i) {
        lit.aovs[i] = build.graph.create(
            "aov " + std::to_string(i),
            frame.write_aovs ? build.image(kPictureFormat) : gpu::ImageDesc{1, 1, kPictureFormat});
        if (i < kLightingAovs) lit.aovs[i] = pass.write(lit.aovs[i]);
    }
    pass.times_itself();
    pass.record([this, &frame, &scene, surfaces, tiles, lit](gpu::PassContext& c) {
        std::vector<gpu::Binding> bindings = shading_bindings(frame, scene);
        const auto sampled = [&](const gpu::ImageRef& image) {
            bindings.push_back(gpu::bind_sampled(c.image(image).view(), frame.nearest.get()));
        };
        sampled(surfaces.gbuffer);
        sampled(surfaces.layers);
        sampled(surfaces.depth);
        bindings.push_back(gpu::bind_storage(c.image(lit.light).view()));
        bindings.push_back(gpu::bind_buffer(c.buffer(tiles.lists)));
        for (std::size_t i = 0; i < kLightingAovs; ++i)
            bindings.push_back(gpu::bind_storage(c.image(lit.aovs[i]).view()));
        bindings.push_back(gpu::bind_storage(c.image(lit.unlit).view()));
        sampled(surfaces.normals);
        for (const ClassPipeline& p : pipelines_) {
            const VkDeviceSize arguments = static_cast<std::uint32_t>(p.shading_class) * sizeof(glm::uvec4);
            c.commands.begin_pass(pass_name(p.shading_class, frame.integrate.has_value()));
            c.commands.dispatch_indirect(p.pipeline, bindings, {}, c.buffer(tiles.lists), arguments);
        }
    });
    return lit;
}

}  // namespace candela::realtime
