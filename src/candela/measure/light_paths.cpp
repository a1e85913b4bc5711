#include "candela/measure/light_paths.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include "shading/language.glsl"

namespace candela::measure {
namespace {

using Luminance = std::vector<double>;

Luminance luminance_of(const Picture& picture) {
    Luminance out;
    out.reserve(picture.pixels.size());
    for (const glm::vec3& pixel : picture.pixels) out.push_back(double(shading::luminance(pixel)));
    return out;
}

PathError compare_path(const std::string& path, const Luminance& x, const Luminance& r) {
    if (x.size() != r.size()) throw std::invalid_argument("light paths: the pictures are not of one size");
    PathError out;
    out.path = path;
    double count = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!std::isfinite(x[i]) || !std::isfinite(r[i])) continue;
        out.picture_mean_nit += x[i];
        out.reference_mean_nit += r[i];
        out.mean_absolute_nit += std::abs(x[i] - r[i]);
        count += 1.0;
    }
    if (count == 0.0) return out;
    out.picture_mean_nit /= count;
    out.reference_mean_nit /= count;
    out.mean_absolute_nit /= count;
    return out;
}

/// The direct light that shadows take away.
Luminance shadowed(const LightPaths& paths) {
    Luminance out = luminance_of(paths.unshadowed_direct);
    const Luminance diffuse = luminance_of(paths.direct_diffuse);
    const Luminance specular = luminance_of(paths.direct_specular);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] -= diffuse.at(i) + specular.at(i);
    return out;
}

}  // namespace

std::vector<PathError> split_error(const LightPaths& x, const LightPaths& r) {
    const std::array<std::pair<const char*, Picture LightPaths::*>, 5> paths{
        {{"direct diffuse", &LightPaths::direct_diffuse},
         {"direct specular", &LightPaths::direct_specular},
         {"environment and indirect diffuse", &LightPaths::indirect_diffuse},
         {"environment and indirect specular", &LightPaths::indirect_specular},
         {"emission", &LightPaths::emission}}};
    std::vector<PathError> out;
    double sum = 0.0;
    for (const auto& [name, path] : paths) {
        out.push_back(compare_path(name, luminance_of(x.*path), luminance_of(r.*path)));
        sum += out.back().mean_absolute_nit;
    }
    for (PathError& row : out) row.share = sum > 0.0 ? row.mean_absolute_nit / sum : 0.0;
    if (!x.unshadowed_direct.pixels.empty() && !r.unshadowed_direct.pixels.empty())
        out.push_back(compare_path("shadows (in direct)", shadowed(x), shadowed(r)));
    if (!x.occluded_environment.pixels.empty() && !r.occluded_environment.pixels.empty())
        out.push_back(compare_path("occlusion (in environment)", luminance_of(x.occluded_environment),
                                   luminance_of(r.occluded_environment)));
    return out;
}

}  // namespace candela::measure
