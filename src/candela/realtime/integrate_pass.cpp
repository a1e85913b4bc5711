#include "candela/realtime/integrate_pass.hpp"

#include <vector>

#include "candela/bake/environment_distribution.hpp"

namespace candela::realtime {
namespace {

/// Share of the draws that go to all directions alike. Beside a sun of 10^9 cd/m^2 a dim texel's step in a
/// float table is below the spacing of the random numbers; this keeps every row's step above 10^-5.
constexpr float kUniformShare = 0.1f;

}  // namespace

Profile integrand(Profile profile) {
    profile.dfg = DfgTechnique::table;
    profile.specular_aa = SpecularAaTechnique::none;
    return profile;
}

gpu::Buffer upload_environment_distribution(const gpu::Device& device, gpu::Commands& commands,
                                            const scene::Environment* environment) {
    std::vector<float> table{0.0f};
    if (environment) {
        bake::EnvironmentDistribution d =
            bake::environment_distribution(*environment, {.uniform = kUniformShare});
        table = std::move(d.row_cdf);
        table.insert(table.end(), d.column_cdf.begin(), d.column_cdf.end());
    }
    return gpu::upload_buffer(device, commands, std::as_bytes(std::span(table)),
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

}  // namespace candela::realtime
