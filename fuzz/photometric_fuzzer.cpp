#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "candela/io/photometric.hpp"
#include "candela/scene/error.hpp"

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

/// What every consumer of a profile relies on.
void check(const candela::scene::PhotometricProfile& p) {
    require(p.candela.size() == p.vertical_deg.size() * p.horizontal_deg.size());
    require(p.vertical_deg.front() == 0.0 && p.vertical_deg.back() == 180.0);
    require(p.horizontal_deg.front() == 0.0 && p.horizontal_deg.back() == 360.0);
    require(p.lamp_set < p.lamp_sets.size());
    for (std::size_t i = 1; i < p.vertical_deg.size(); ++i)
        require(p.vertical_deg[i] >= p.vertical_deg[i - 1]);
    for (std::size_t i = 1; i < p.horizontal_deg.size(); ++i)
        require(p.horizontal_deg[i] > p.horizontal_deg[i - 1]);
    for (const float value : p.candela) require(value >= 0.0f && std::isfinite(value));
    require(candela::scene::integrated_lm(p) >= 0.0);
    (void)candela::scene::beam_angle(p);
    (void)candela::scene::tilt_factor(p, 30.0);
    const auto grid = candela::scene::fitting_grid(std::span(&p, 1), 72, 73);
    for (const float value : candela::scene::resample(p, grid.width, grid.height))
        require(value >= 0.0f && std::isfinite(value));
}

}  // namespace

// Any bytes are either a whole web or an Error; everything else (a signal, a leak, another exception) is a
// finding.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    candela::Diagnostics diagnostics;
    try {
        check(candela::io::load_photometric_from_memory(std::as_bytes(std::span(data, size)), "fuzz", {},
                                                        diagnostics));
    } catch (const candela::Error&) {
    }
    return 0;
}
