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

/// Patch means at each place, by the frame or, with `samples` of integrals, by integrate.
inline std::vector<PatchMeans> rendered(const scene::Scene& s, const std::vector<glm::vec3>& places,
                                        const realtime::Profile& profile, std::uint32_t samples = 0) {
    realtime::RendererOptions o;
    o.width = o.height = kPatchPicture;
    o.samples = samples > 0 ? samples : 4;
    o.profile = profile;
    if (samples > 0) o.integrate.emplace();
    std::vector<PatchMeans> out;
    realtime::Renderer renderer(shared_device(), s, o);
    for (const glm::vec3& place : places) {
        const realtime::Still still = renderer.render_still(patch_camera(place), fixed_ev(10.0f));
        out.push_back(patch_means([&](std::uint32_t x, std::uint32_t y) {
            return glm::vec3(still.planes.light_nit[std::size_t{y} * kPatchPicture + x]);
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
    std::vector<PatchMeans> out;
    for (const glm::vec3& place : places) {
        const truth::CameraRays rays(patch_camera(place), kPatchPicture, kPatchPicture);
        std::vector<glm::dvec3> nit(std::size_t{kPatchPicture} * kPatchPicture, glm::dvec3(0.0));
        tbb::parallel_for(0u, kPatchPicture, [&](std::uint32_t y) {
            for (std::uint32_t x = 0; x < kPatchPicture; ++x) {
                for (std::uint32_t i = 0; i < samples; ++i) {
                    const truth::PathSampler sampler({x, y}, i, 7);
                    const truth::Ray ray = rays.through(glm::vec2(x, y) + sampler.pixel(), glm::vec2(0.5f));
                    nit[std::size_t{y} * kPatchPicture + x] +=
                        glm::dvec3(integrator.trace(ray, sampler).luminance_nit);
                }
            }
        });
        out.push_back(patch_means([&](std::uint32_t x, std::uint32_t y) {
            return nit[std::size_t{y} * kPatchPicture + x] / double(samples);
        }));
    }
    return out;
}

/// Mean over the angles of |a / b - 1|, of one column of the grid.
inline double relative_difference(const PatchMeans& a, const PatchMeans& b, std::size_t column) {
    double difference = 0.0;
    double sum = 0.0;
    for (std::size_t i = column; i < b.size(); i += kPatchesSide) {
        difference += std::abs(a[i] / b[i] - 1.0);
        sum += 1.0;
    }
    return difference / sum;
}

}  // namespace candela::test
