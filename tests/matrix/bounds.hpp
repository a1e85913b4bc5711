#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "candela/realtime/profile.hpp"
#include "patches.hpp"

/// How far the frame may be from integrate: the mean over the angles of kPatchNoV, for each of
/// kPatchMaterials. Each figure is what test_matrix prints for the technique, and a quarter more; a wrong
/// model is off by several times that.
namespace candela::test {

using Bounds = std::array<double, kPatchesSide>;

inline Bounds larger(const Bounds& a, const Bounds& b) {
    Bounds out{};
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::max(a[i], b[i]);
    return out;
}

/// Under the same light from everywhere only the albedo counts.
inline Bounds constant_environment_bounds(const realtime::Profile& p) {
    using realtime::DfgTechnique;
    switch (p.dfg) {
        case DfgTechnique::table:
            return {0.004, 0.004, 0.004, 0.005};
        case DfgTechnique::env_brdf_approx:
            return {0.06, 0.12, 0.025, 0.055};
        case DfgTechnique::env_brdf_approx_nonmetal:
            return {0.06, 0.12, 0.06, 0.09};  // no bias by f90 on the default dielectric
        default:
            return {2.0, 2.0, 2.0, 2.0};  // without a specular lobe by intent
    }
}

/// Under bake::studio_environment().
inline Bounds studio_bounds(const realtime::Profile& p) {
    using realtime::ReflectionTechnique;
    Bounds reads{};
    switch (p.reflection) {
        case ReflectionTechnique::mirror_direction:
            reads = {0.013, 0.085, 0.055, 0.055};
            break;
        case ReflectionTechnique::stretched_2:
        case ReflectionTechnique::stretched_3:
            reads = {0.016, 0.07, 0.034, 0.025};
            break;
        default:
            reads = {0.036, 0.095, 0.08, 0.076};
    }
    const Bounds albedo = constant_environment_bounds(p);
    for (std::size_t i = 0; i < reads.size(); ++i) reads[i] += albedo[i];
    return reads;
}

/// The sun's disc.
inline Bounds sun_bounds(const realtime::Profile& p) {
    using realtime::AreaSpecularTechnique;
    // Karis 2014: an approximation of D, and the albedo for the rest.
    if (p.sun_specular != realtime::SunSpecularTechnique::full) return {0.6, 1.05, 0.75, 0.6};
    // The lobe at the sun's centre, widened by its disc.
    if (p.area_specular == AreaSpecularTechnique::ltc) return {0.003, 0.004, 0.004, 0.004};
    return {0.016, 0.105, 0.075, 0.06};
}

/// Lights of a size, by the names of all_local_lights(). Half as wide as the lobes of the metal and the
/// dielectric, and wider than the coat's: a technique that takes one point of them is up to three times too
/// bright. SmallLightsArePoints holds the lobe itself.
using LightBounds = std::map<std::string, Bounds>;

inline const LightBounds& area_light_bounds(realtime::AreaSpecularTechnique technique) {
    using realtime::AreaSpecularTechnique;
    static const LightBounds ltc{
        {"line", {0.009, 0.081, 0.057, 0.052}}, {"sphere", {0.005, 0.005, 0.009, 0.005}},
        {"disk", {0.005, 0.005, 0.01, 0.005}},  {"rectangle", {0.009, 0.02, 0.01, 0.007}},
        {"tube", {0.01, 0.035, 0.012, 0.015}},  {"emissive", {0.005, 0.007, 0.015, 0.006}},
    };
    static const LightBounds representative_point{
        {"line", {0.25, 1.39, 1.41, 1.13}}, {"sphere", {0.13, 0.65, 0.66, 0.54}},
        {"disk", {0.13, 0.66, 0.66, 0.54}}, {"rectangle", {0.25, 2.06, 2.09, 1.71}},
        {"tube", {0.29, 1.97, 2.04, 1.64}}, {"emissive", {0.15, 1.11, 1.06, 0.9}},
    };
    static const LightBounds dominant_direction{
        {"line", {0.3, 0.55, 0.43, 0.14}},   {"sphere", {0.12, 0.77, 0.69, 0.48}},
        {"disk", {0.033, 1.42, 1.25, 0.92}}, {"rectangle", {0.2, 2.59, 2.1, 1.3}},
        {"tube", {0.33, 0.65, 0.5, 0.23}},   {"emissive", {0.088, 2.92, 2.74, 1.95}},
    };
    // The teaching page's point, which its ratio hardly moves; of other shapes Karis's.
    static const LightBounds teaching_page = [] {
        LightBounds out = representative_point;
        out["sphere"] = {0.055, 0.53, 0.48, 0.39};
        return out;
    }();
    switch (technique) {
        case AreaSpecularTechnique::ltc:
            return ltc;
        case AreaSpecularTechnique::teaching_page:
            return teaching_page;
        case AreaSpecularTechnique::representative_point:
            return representative_point;
        default:
            return dominant_direction;
    }
}

inline Bounds local_light_bounds(const realtime::Profile& p, const std::string& light) {
    const LightBounds& bounds = area_light_bounds(p.area_specular);
    const auto found = bounds.find(light);
    // Without a size: exact.
    return found == bounds.end() ? Bounds{0.003, 0.003, 0.003, 0.003} : found->second;
}

}  // namespace candela::test
