#pragma once

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "common/scenes.hpp"

namespace candela::test {

/// Patches of plane in a grid that a parallel camera sees from +Z, each at one angle in all of its pixels, so
/// that the mean of a patch is one integral. A row has one angle, a column one material. Rows are far apart
/// in depth, so that each may have a light of its own.
inline constexpr std::array<float, 4> kPatchNoV{0.95f, 0.6f, 0.35f, 0.2f};
inline constexpr std::array<const char*, 4> kPatchMaterials{"first metal", "metal", "dielectric", "layered"};
inline constexpr float kRowDepth_m = 3.0f;
/// Small, so that all of it sees a light at one angle, and a power of two, so that its edges are exact.
inline constexpr float kPatch_m = 1.0f / 256.0f;
inline constexpr std::uint32_t kPatchesSide = 4;

/// Pixels a side of each patch, and how many of them next to its border do not count.
struct PatchPicture {
    std::uint32_t pixels = 8;
    std::uint32_t border = 1;

    [[nodiscard]] std::uint32_t side() const { return pixels * kPatchesSide; }
};

/// The frame's techniques may read neighbouring pixels.
inline constexpr PatchPicture kFramePicture{8, 1};
/// Few pixels of many samples: the error of Sobol points falls faster with their number than with that of the
/// pixels, whose sequences are independent.
/// At most 64 samples of integrate: all pixels of a sample have one offset, and one of those that follow is
/// so near to a pixel's edge, which is a patch's here, that the rasterizer takes the neighbouring patch.
inline constexpr PatchPicture kIntegralPicture{2, 0};

/// In steps of the G-buffer, so that all modes have the same material.
inline std::vector<scene::Material> patch_materials(float first_roughness) {
    const float c = std::pow(800.0f / 1023.0f, 2.0f);
    std::vector<scene::Material> out(kPatchMaterials.size());
    for (scene::Material& m : out) m.base_color = glm::vec4(c, 0.5f * c, 0.25f * c, 1.0f);
    out[0].perceptual_roughness = first_roughness;
    out[1].perceptual_roughness = 1229.0f / 4095.0f;
    out[2].perceptual_roughness = 1229.0f / 4095.0f;
    out[2].metallic = 0.0f;
    out[3].metallic = 0.0f;
    out[3].perceptual_roughness = 2048.0f / 4095.0f;
    out[3].clearcoat.factor = 1.0f;
    out[3].clearcoat.perceptual_roughness = 77.0f / 255.0f;
    out[3].sheen.color = glm::vec3(std::pow(102.0f / 255.0f, 2.0f));
    out[3].sheen.perceptual_roughness = 128.0f / 255.0f;
    return out;
}

inline glm::vec3 patch_normal(std::uint32_t row, float towards_rad) {
    const float NoV = kPatchNoV[row];
    const float sine = std::sqrt(1.0f - NoV * NoV);
    return {sine * std::cos(towards_rad), sine * std::sin(towards_rad), NoV};
}

/// From the middle of a place to that of one of its rows.
inline glm::vec3 row_middle(std::uint32_t row, float row_depth_m = kRowDepth_m) {
    return {0.0f, kPatch_m * (0.5f * kPatchesSide - 0.5f - static_cast<float>(row)),
            row_depth_m * (0.5f * kPatchesSide - 0.5f - static_cast<float>(row))};
}

/// One patch: what projects to its cell of the picture, tilted towards azimuth `towards_rad`.
inline scene::Primitive patch(std::uint32_t column, std::uint32_t row, float towards_rad, float row_depth_m) {
    const glm::vec3 n = patch_normal(row, towards_rad);
    const float half = 0.5f * kPatch_m;
    const glm::vec3 at =
        row_middle(row, row_depth_m) +
        glm::vec3(kPatch_m * (static_cast<float>(column) + 0.5f - 0.5f * kPatchesSide), 0.0f, 0.0f);
    scene::Primitive p;
    for (const auto& [x, y] : {std::pair{-half, -half}, {half, -half}, {half, half}, {-half, half}}) {
        p.positions.push_back(at + glm::vec3(x, y, -(n.x * x + n.y * y) / n.z));
        p.normals.push_back(n);
        p.tangents.emplace_back(glm::normalize(glm::vec3(n.z, 0.0f, -n.x)), 1.0f);
        p.uv[0].emplace_back(0.0f, 0.0f);
        p.bounds.extend(p.positions.back());
    }
    p.indices = {0, 1, 2, 0, 2, 3};
    p.material = column;
    return p;
}

/// All patches about `middle`.
inline void add_patches(scene::Scene& s, const glm::vec3& middle, float towards_rad,
                        const std::vector<scene::Material>& materials, float row_depth_m = kRowDepth_m) {
    if (s.materials.empty()) s.materials = materials;
    scene::Mesh mesh{"patches", {}};
    for (std::uint32_t row = 0; row < kPatchesSide; ++row) {
        for (std::uint32_t column = 0; column < kPatchesSide; ++column) {
            mesh.primitives.push_back(patch(column, row, towards_rad, row_depth_m));
        }
    }
    s.meshes.push_back(std::move(mesh));
    s.instances.push_back({"patches", static_cast<std::uint32_t>(s.meshes.size() - 1),
                           glm::translate(glm::mat4(1.0f), middle)});
}

inline scene::Camera patch_camera(const glm::vec3& middle) {
    scene::Camera camera = scene::look_at(middle + glm::vec3(0, 0, 10), middle, 0.6f);
    camera.projection = scene::Projection::orthographic;
    camera.xmag_m = camera.ymag_m = 0.5f * kPatch_m * kPatchesSide;
    camera.znear_m = 1.0f;
    camera.zfar_m = 20.0f;
    return camera;
}

/// Mean over the channels of each patch, row by row.
template <class PixelNit>
std::vector<double> patch_means(const PatchPicture& picture, PixelNit&& nit) {
    std::vector<double> out;
    const std::uint32_t end = picture.pixels - picture.border;
    for (std::uint32_t row = 0; row < kPatchesSide; ++row) {
        for (std::uint32_t column = 0; column < kPatchesSide; ++column) {
            double sum = 0.0;
            for (std::uint32_t y = picture.border; y < end; ++y) {
                for (std::uint32_t x = picture.border; x < end; ++x) {
                    const glm::dvec3 c(nit(column * picture.pixels + x, row * picture.pixels + y));
                    sum += (c.x + c.y + c.z) / 3.0;
                }
            }
            const double side = end - picture.border;
            out.push_back(sum / (side * side));
        }
    }
    return out;
}

}  // namespace candela::test
