#pragma once

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "candela/gpu/device.hpp"
#include "candela/measure/path_model.hpp"
#include "candela/realtime/renderer.hpp"
#include "candela/truth/camera_rays.hpp"
#include "candela/truth/path_integrator.hpp"
#include "patches.hpp"

namespace candela::test {

/// Patch means of one place.
using PatchMeans = std::vector<double>;

inline const gpu::Device& shared_device() {
    static const gpu::Device device{[] {
        gpu::DeviceOptions o;
        o.validation = true;
        return o;
    }()};
    return device;
}

/// Patch means at each place, by the frame or, with `samples` of integrals, by integrate. Nothing occludes.
inline std::vector<PatchMeans> rendered(const scene::Scene& s, const std::vector<glm::vec3>& places,
                                        const realtime::Profile& profile, std::uint32_t samples = 0) {
    const PatchPicture picture = samples > 0 ? kIntegralPicture : kFramePicture;
    realtime::RendererOptions o;
    o.width = o.height = picture.side();
    o.samples = samples > 0 ? samples : 4;
    o.profile = profile;
    o.shadows.maps = false;
    if (samples > 0) o.integrate.emplace().draws = 16;
    std::vector<PatchMeans> out;
    realtime::Renderer renderer(shared_device(), s, o);
    for (const glm::vec3& place : places) {
        const realtime::Still still = renderer.render_still(patch_camera(place), fixed_ev(10.0f));
        out.push_back(patch_means(picture, [&](std::uint32_t x, std::uint32_t y) {
            return glm::vec3(still.planes.light_nit[std::size_t{y} * picture.side() + x]);
        }));
    }
    EXPECT_TRUE(shared_device().validation_messages().empty())
        << shared_device().validation_messages().front();
    return out;
}

/// The same by the path tracer: direct light, nothing in its way.
inline std::vector<PatchMeans> traced(const scene::Scene& s, const std::vector<glm::vec3>& places,
                                      const realtime::Profile& profile, std::uint32_t samples) {
    truth::PathOptions o;
    measure::set_model(profile, o);
    o.direct_only = true;
    o.shadows = false;
    const truth::PathIntegrator integrator(s, o);
    const std::uint32_t side = kIntegralPicture.side();
    std::vector<PatchMeans> out;
    for (const glm::vec3& place : places) {
        const truth::CameraRays rays(patch_camera(place), side, side);
        std::vector<glm::dvec3> nit(std::size_t{side} * side, glm::dvec3(0.0));
        tbb::parallel_for(0u, side, [&](std::uint32_t y) {
            for (std::uint32_t x = 0; x < side; ++x) {
                for (std::uint32_t i = 0; i < samples; ++i) {
                    const truth::PathSampler sampler({x, y}, i, 7);
                    const truth::Ray ray = rays.through(glm::vec2(x, y) + sampler.pixel(), glm::vec2(0.5f));
                    nit[std::size_t{y} * side + x] +=
                        glm::dvec3(integrator.trace(ray, sampler).luminance_nit);
                }
            }
        });
        out.push_back(patch_means(kIntegralPicture, [&](std::uint32_t x, std::uint32_t y) {
            return nit[std::size_t{y} * side + x] / double(samples);
        }));
    }
    return out;
}

/// a / b - 1 at each angle, of one column of the grid.
inline std::array<double, kPatchesSide> relative_differences(const PatchMeans& a, const PatchMeans& b,
                                                             std::size_t column) {
    std::array<double, kPatchesSide> out{};
    for (std::size_t row = 0; row < kPatchesSide; ++row) {
        const std::size_t i = row * kPatchesSide + column;
        out[row] = a[i] / b[i] - 1.0;
    }
    return out;
}

inline double mean_magnitude(const std::array<double, kPatchesSide>& differences) {
    double sum = 0.0;
    for (const double d : differences) sum += std::abs(d);
    return sum / double(kPatchesSide);
}

}  // namespace candela::test
