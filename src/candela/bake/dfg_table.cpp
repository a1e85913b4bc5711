#include "candela/bake/environment.hpp"
#include "candela_shaders/dfg_comp.hpp"
#include "shading/dfg.glsl"

namespace candela::bake {
gpu::Image create_dfg_table(const gpu::Device& device, gpu::Commands& commands, DfgModel model) {
    constexpr auto size = static_cast<std::uint32_t>(shading::kDfgSize);
    gpu::Image table(device, {size, size, VK_FORMAT_R32G32B32A32_SFLOAT,
                              VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT});
    const gpu::ComputePipeline pipeline =
        gpu::create_compute_pipeline(device, shaders::dfg_comp, {{{VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}}, 4},
                                     {model == DfgModel::ue4_schlick_smith ? 1u : 0u});
    commands.begin();
    commands.begin_pass("dfg");
    commands.use(table, gpu::Use::storage_write);
    const std::array bindings{gpu::bind_storage(table.view())};
    commands.dispatch(pipeline, bindings, gpu::push(shading::kDfgSamples), size / 8, size / 8);
    commands.use(table, gpu::Use::sampled);
    commands.submit_and_wait();
    return table;
}

}  // namespace candela::bake
