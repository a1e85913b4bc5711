#include "candela/realtime/integrate_pass.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "candela/bake/environment_distribution.hpp"
#include "candela/realtime/emitters.hpp"
#include "candela/realtime/light_records.hpp"
#include "candela/scene/error.hpp"

namespace candela::realtime {
namespace {

/// Share of the draws that go to all directions alike. Beside a sun of 10^9 cd/m^2 a dim texel's step in a
/// float table is below the spacing of the random numbers; this keeps every row's step above 10^-5.
constexpr float kUniformShare = 0.1f;

/// Of a triangle for rays, without its part of the tree.
constexpr std::size_t kTriangleBytes = 4 * sizeof(Quad);

bake::EnvironmentDistribution distribution(const std::optional<scene::Environment>& environment) {
    if (!environment) return {};
    return bake::environment_distribution(*environment, {.uniform = kUniformShare});
}

/// The parts of the buffer one after the other, each from a multiple of four words on.
class Tables {
  public:
    Tables() { words_.resize(kHeaderWords); }

    /// Appends plain data; returns its first word.
    template <class T>
    std::uint32_t append(const std::vector<T>& data) {
        words_.resize((words_.size() + 3) / 4 * 4);
        return append_packed(data);
    }
    /// The same without room to the multiple of four.
    template <class T>
    std::uint32_t append_packed(const std::vector<T>& data) {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0);
        const std::size_t first = words_.size();
        words_.resize(first + data.size() * (sizeof(T) / 4));
        if (!data.empty()) std::memcpy(words_.data() + first, data.data(), data.size() * sizeof(T));
        return static_cast<std::uint32_t>(first);
    }
    template <class T>
    std::uint32_t append_quads(const std::vector<T>& data) {
        return append(data) / 4;
    }
    void write_header(const std::array<std::uint32_t, 20>& header) {
        std::copy(header.begin(), header.end(), words_.begin());
    }
    [[nodiscard]] const std::vector<std::uint32_t>& words() const noexcept { return words_; }

  private:
    static constexpr std::size_t kHeaderWords = 20;
    std::vector<std::uint32_t> words_;
};

void check_fits(const gpu::Device& device, std::size_t bytes, bool ray_shadows) {
    if (bytes <= device.limits().maxStorageBufferRange) return;
    throw machine_error("the scene is too large for this device in the mode integrate: its tables take " +
                            std::to_string(bytes >> 20u) + " MiB, a buffer holds " +
                            std::to_string(device.limits().maxStorageBufferRange >> 20u) + " MiB",
                        {}, ray_shadows ? "--shadows none, or --mode path" : "--mode path");
}

gpu::Buffer upload(const gpu::Device& device, gpu::Commands& commands, const Tables& tables) {
    return gpu::upload_buffer(device, commands, std::as_bytes(std::span(tables.words())),
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

}  // namespace

Profile integrand(Profile profile) {
    profile.dfg = DfgTechnique::table;
    profile.sun_specular = SunSpecularTechnique::full;
    profile.specular_aa = SpecularAaTechnique::none;
    return profile;
}

IntegrateTables upload_integrate_tables(const gpu::Device& device, gpu::Commands& commands,
                                        const scene::Scene& scene,
                                        const std::optional<IntegrateOptions>& options) {
    Tables tables;
    if (!options) return {upload(device, commands, tables), 0};
    PackedTextures textures(scene);
    AlphaRecords alphas(scene, textures);
    const Emitters emitters = collect_emitters(scene, alphas, textures);
    RayScene rays;
    if (options->ray_shadows) {
        const auto shared = scene::shared_primitives(scene, options->max_copied_triangles);
        // Before minutes go into trees that do not fit.
        check_fits(device, kTriangleBytes * scene::stored_triangles(scene, shared), true);
        rays = build_ray_scene(scene, alphas, shared);
    }
    const LightRecords lights = light_records(scene, textures);

    const auto count = [](std::size_t n) { return static_cast<std::uint32_t>(n); };
    std::array<std::uint32_t, 20> header{};
    const bake::EnvironmentDistribution environment = distribution(scene.environment);
    header[0] = tables.append(environment.row_cdf);
    tables.append_packed(environment.column_cdf);
    header[1] = tables.append_quads(emitters.asked);
    header[2] = count(emitters.asked.size());
    header[3] = tables.append_quads(emitters.nodes);
    header[4] = count(emitters.nodes.size() / 3);
    header[5] = tables.append_quads(emitters.items);
    header[6] = tables.append_quads(emitters.triangles);
    header[7] = tables.append_quads(alphas.quads());
    header[8] = tables.append_quads(textures.records());
    header[9] = tables.append(textures.texels());
    header[10] = tables.append_quads(rays.nodes);
    header[11] = rays.top_nodes;
    header[12] = tables.append_quads(rays.triangles);
    header[13] = tables.append_quads(lights.lights);
    header[14] = tables.append_quads(lights.profiles);
    header[15] = tables.append(lights.profile_cd);
    header[16] = tables.append_quads(rays.instances);
    header[17] = count(static_cast<std::size_t>(environment.width));
    header[18] = count(static_cast<std::size_t>(environment.height));
    tables.write_header(header);
    check_fits(device, tables.words().size() * sizeof(std::uint32_t), options->ray_shadows);

    IntegrateTables out{upload(device, commands, tables), static_cast<std::uint32_t>(options->strategy)};
    const auto has = [&](std::uint32_t bit, bool any) { out.variant |= any ? bit : 0u; };
    has(4, !rays.nodes.empty());
    has(8, !emitters.items.empty());
    has(16, !emitters.asked.empty());
    has(32, !alphas.quads().empty());
    has(64, !rays.instances.empty());
    return out;
}

}  // namespace candela::realtime
