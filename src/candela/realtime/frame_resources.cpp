#include "candela/realtime/frame_resources.hpp"

#include <bit>

namespace candela::realtime {

gpu::Specialization specialization(const FrameResources& frame, const ShadeVariant& variant) {
    const Profile& p = frame.profile;
    const auto bits = [](auto value) { return static_cast<std::uint32_t>(value); };
    return {variant.features, bits(p.specular_aa), bits(p.diffuse), bits(p.visibility), bits(p.fresnel),
            bits(p.energy), bits(p.dfg), bits(p.reflection), bits(variant.layers), variant.light_kinds,
            bits(frame.has_environment), bits(variant.shading_class),
            // A probe sees no lights: the frame reflects them by itself.
            bits(variant.emissive && (frame.local.bits & local_capture) == 0), bits(frame.write_aovs),
            bits(variant.forward), frame.integrate_tables.variant, bits(frame.culled_lights),
            bits(p.area_diffuse), bits(p.area_specular), frame.shadow_kinds, bits(p.shadow_filter),
            bits(p.irradiance), frame.local.bits, bits(p.sun_specular), bits(p.area_direction),
            bits(frame.normal_mapped), bits(p.falloff), std::bit_cast<std::uint32_t>(p.falloff_offset_m2),
            bits(p.normal_map_filter)};
}

std::vector<VkDescriptorType> shading_set_layout() {
    return {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
            VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
            VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
            VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
            VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
            VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
            VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
            VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};
}

std::vector<gpu::Binding> shading_bindings(const FrameResources& frame, const GpuScene& scene) {
    return {gpu::bind_buffer(frame.frame_block),
            gpu::bind_buffer(scene.lights),
            gpu::bind_sampled(frame.dfg.view(), frame.clamp.get()),
            gpu::bind_sampled(frame.environment.specular.view(), frame.clamp.get()),
            gpu::bind_sampled(frame.environment.irradiance.view(), frame.clamp.get()),
            gpu::bind_sampled(frame.environment.background.view(), frame.repeat_u.get()),
            gpu::bind_buffer(frame.integrate_tables.buffer),
            gpu::bind_buffer(frame.light_lists),
            gpu::bind_buffer(scene.light_tables),
            gpu::bind_sampled(frame.ltc.view(), frame.clamp.get()),
            gpu::bind_buffer(frame.shadow_records),
            gpu::bind_sampled(frame.shadow_atlas.view(), frame.nearest.get()),
            gpu::bind_buffer(frame.visibilities),
            gpu::bind_buffer(frame.local.buffer),
            gpu::bind_sampled(frame.local.atlas.view(), frame.clamp.get())};
}

}  // namespace candela::realtime
