#include "candela/measure/specular_figure.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "candela/measure/dfg_lookup.hpp"
#include "candela/measure/flip_rgb.hpp"
#include "candela/measure/spheres.hpp"
#include "shading/basis.glsl"

namespace candela::measure {
namespace {

using namespace shading;

constexpr int kDiameter = 56;

/// The light as the surface point sees it, and the view; the point of the sphere is n itself.
struct SurfacePoint {
    ShapedLight light;
    SpecularView view;
};

SurfacePoint surface_point(const SphereColumn& column, const vec3& n, const DfgLookup& dfg) {
    const vec3 to_viewer(0.0f, 0.0f, 1.0f);
    const float NoV = std::max(n.z, 1.0e-3f);
    vec3 t;
    vec3 b;
    orthonormal_basis(n, t, b);
    const vec3 away = n * n.z - to_viewer;
    if (length(away) > 1.0e-4f) t = normalize(away);
    b = cross(n, t);
    SurfacePoint out;
    out.light = column.light;
    out.light.center = to_local(column.light.center - n, t, b, n);
    out.light.right = to_local(column.light.right, t, b, n);
    out.light.up = to_local(column.light.up, t, b, n);
    const vec2 scale_and_bias = dfg.read(NoV, std::sqrt(column.alpha));
    out.view = {vec3(-std::sqrt((1.0f - NoV) * (1.0f + NoV)), 0.0f, NoV), column.alpha,
                scale_and_bias.x + scale_and_bias.y};
    return out;
}

double truth(const ShapedLight& light, const SpecularView& view) {
    return SpecularTruth(view.v.z, view.alpha, view.albedo, 384, 256).integrate(light).value;
}

Panel draw_row(const std::vector<SphereColumn>& columns,
               const std::function<double(const ShapedLight&, const SpecularView&)>& estimate) {
    const DfgLookup dfg(DfgKind::smith_correlated);
    return sphere_grid(1, int(columns.size()), kDiameter, [&](int, int column, const vec3& n) {
        const SurfacePoint at = surface_point(columns[std::size_t(column)], n, dfg);
        return vec3(float(estimate(at.light, at.view)) * at.view.albedo);
    });
}

void append_below(Panel& picture, const Panel& row) {
    picture.width = row.width;
    if (picture.height > 0) {
        constexpr std::uint32_t gap = 6;
        picture.rgb.insert(picture.rgb.end(), std::size_t{3} * gap * row.width, 255);
        picture.height += gap;
    }
    picture.rgb.insert(picture.rgb.end(), row.rgb.begin(), row.rgb.end());
    picture.height += row.height;
}

}  // namespace

ShapedLight light_towards_spheres(LightShape shape, const vec3& center) {
    ShapedLight light;
    light.shape = shape;
    light.center = center;
    if (shape == LightShape::sphere || shape == LightShape::tube) return light;
    const vec3 shine = -normalize(center);
    light.right = normalize(cross(vec3(0.0f, 1.0f, 0.0f), -shine));
    light.up = cross(-shine, light.right);
    return light;
}

void add_specular_figure(Findings& out, const std::string& title, const std::vector<SphereColumn>& columns,
                         const std::vector<std::string>& labels, const std::vector<double>& flip_at_most) {
    const std::vector<SpecularTechnique> known = specular_techniques(columns.front().light.shape);
    const Panel reference = draw_row(columns, truth);
    Panel picture{title, "From above: ", 0, 0, {}, 2};
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const auto technique = std::find_if(known.begin(), known.end(),
                                            [&](const SpecularTechnique& t) { return t.label == labels[i]; });
        if (technique == known.end())
            throw std::logic_error("no technique '" + labels[i] + "' for this light");
        const Panel row = draw_row(columns, technique->estimate);
        out.measured.push_back(at_most(title + ": " + labels[i] + ", mean FLIP",
                                       mean_flip_of_srgb(row.rgb, reference.rgb, row.width, row.height),
                                       flip_at_most[i]));
        picture.caption += labels[i] + ", ";
        append_below(picture, row);
    }
    picture.caption += "truth.";
    append_below(picture, reference);
    out.pictures.push_back(std::move(picture));
}

}  // namespace candela::measure
