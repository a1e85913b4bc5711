#include "candela/realtime/cull_pass.hpp"

#include <algorithm>

#include "candela_shaders/cull_lights_comp.hpp"

namespace candela::realtime {
namespace {

constexpr std::uint32_t kCellSize = 32;  // of shaders/frame.glsl
constexpr std::uint32_t kCellSlices = 16;
constexpr std::size_t kMostRoom = std::size_t{8} << 20u;  // entries: 32 MiB

bool any_blended(const GpuScene& scene) {
    return std::any_of(scene.draws.begin(), scene.draws.end(), [](const Draw& draw) { return draw.blended; });
}

gpu::ComputePipeline pipeline(const gpu::Device& device, bool cells) {
    return gpu::create_compute_pipeline(
        device, shaders::cull_lights_comp,
        {{{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
           VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}},
         0},
        {cells ? 1u : 0u});
}

}  // namespace

// [0] entries used of the pool; the heads of the tiles' and of the cells' lists; the list of all lights; the
// pool.
void create_light_lists(const gpu::Device& device, gpu::Commands& commands, const GpuScene& scene,
                        bool wanted, FrameResources& frame) {
    const LightList& list = scene.light_list;
    const auto lights = static_cast<std::uint32_t>(list.blocks.size());
    const std::vector<std::uint32_t> all = light_entries(list);
    LightListPlaces& places = frame.light_places;
    frame.culled_lights = wanted && list.bounded >= kLeastCulledLights && lights <= kMostCulledLights;
    std::vector<std::uint32_t> words{0};
    if (frame.culled_lights) {
        if (any_blended(scene)) {
            places.cells =
                glm::ivec3(groups(frame.width, kCellSize), groups(frame.height, kCellSize), kCellSlices);
        }
        const std::size_t tiles = frame.tile_count();
        const std::size_t cells =
            std::size_t(places.cells.x) * std::size_t(places.cells.y) * std::size_t(places.cells.z);
        places.first_cell = static_cast<std::int32_t>(1 + tiles);
        places.first_all = static_cast<std::int32_t>(1 + tiles + cells);
        places.first_room = places.first_all + static_cast<std::int32_t>(all.size());
        const std::size_t room = (tiles + cells) * (std::min(lights, kRoomForLights) + 1u);
        places.room = static_cast<std::int32_t>(std::min(room, kMostRoom));
        words.resize(static_cast<std::size_t>(places.first_room) + static_cast<std::size_t>(places.room));
    } else {
        places.first_all = 1;
        words.resize(1 + all.size());
    }
    std::fill(words.begin() + 1, words.begin() + places.first_all,
              static_cast<std::uint32_t>(places.first_all));
    std::copy(all.begin(), all.end(), words.begin() + places.first_all);
    frame.light_lists = gpu::upload_buffer(device, commands, std::as_bytes(std::span(words)),
                                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

CullPass::CullPass(const gpu::Device& device, const FrameResources& frame)
    : zero_(device, sizeof(std::uint32_t), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::MemoryKind::upload) {
    zero_.mapped_as<std::uint32_t>()[0] = 0;
    if (!frame.culled_lights) return;
    tiles_ = pipeline(device, false);
    if (frame.light_places.cells.x > 0) cells_ = pipeline(device, true);
}

gpu::BufferRef CullPass::add(const FrameBuild& build, const Tiles& tiles) const {
    if (!tiles_) return build.in.light_lists;
    FrameResources& frame = build.frame;
    GpuScene& scene = build.scene;
    gpu::PassBuilder pass = build.graph.pass("cull lights");
    pass.read(build.in.light_reaches);
    pass.read(tiles.bounds);
    // The list of all lights stays.
    const gpu::BufferRef lists = pass.write(build.in.light_lists, gpu::Load::keep);
    pass.record([this, &frame, &scene, tiles](gpu::PassContext& c) {
        c.commands.copy(zero_, frame.light_lists, sizeof(std::uint32_t));
        c.commands.use(frame.light_lists, gpu::Use::storage_write);
        const std::array bindings{gpu::bind_buffer(frame.frame_block), gpu::bind_buffer(scene.light_reaches),
                                  gpu::bind_buffer(c.buffer(tiles.bounds)),
                                  gpu::bind_buffer(frame.light_lists)};
        c.commands.dispatch(*tiles_, bindings, {}, groups(frame.tiles_x, 8), groups(frame.tiles_y, 8));
        if (!cells_) return;
        const glm::uvec3 cells(frame.light_places.cells);
        c.commands.dispatch(*cells_, bindings, {}, groups(cells.x, 4), groups(cells.y, 4),
                            groups(cells.z, 4));
    });
    return lists;
}

}  // namespace candela::realtime
