#pragma once

#include <algorithm>
#include <array>
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

/// By the names of local_lights().
inline Bounds local_light_bounds(const realtime::Profile& p, const std::string& light) {
    if (light == "point" || light == "spot" || light == "frustum" || light == "IES")
        return {0.005, 0.005, 0.005, 0.005};
    // Coarse, until the figures of each technique stand here: a profile's visibility left out makes a factor
    // of three.
    using realtime::AreaSpecularTechnique;
    if (p.area_specular == AreaSpecularTechnique::ltc)
        return light == "emissive" ? Bounds{0.6, 0.6, 0.6, 0.6} : Bounds{0.2, 0.15, 0.2, 0.15};
    // The teaching page's point, which its ratio hardly moves; of other shapes Karis's.
    const bool page = p.area_specular == AreaSpecularTechnique::teaching_page;
    if (page && light == "sphere") return {0.055, 0.53, 0.48, 0.39};
    // One point of a large light for a narrow lobe: the papers' techniques are this far off.
    if (page || p.area_specular == AreaSpecularTechnique::representative_point) return {0.6, 1.9, 1.9, 1.1};
    return {0.6, 3.0, 1.5, 1.1};
}

}  // namespace candela::test
