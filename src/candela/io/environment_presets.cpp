#include "candela/io/environment_presets.hpp"

#include <array>
#include <cmath>
#include <sstream>

#include "candela/io/cube_file.hpp"
#include "candela/io/environment_harmonics.hpp"
#include "candela/io/image_write.hpp"
#include "candela/scene/environment_resample.hpp"
#include "shading/spherical_harmonics.glsl"

namespace candela::io::detail {
namespace {

using nlohmann::json;
using scene::CubeMap;
using scene::FilteredEnvironment;

constexpr std::array<const char*, 6> kFaces{"px", "nx", "py", "ny", "pz", "nz"};

void write_picture(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
                   std::span<const glm::vec3> texels, float nit_per_unit) {
    std::array<std::vector<float>, 3> planes;
    for (int c = 0; c < 3; ++c) {
        planes[std::size_t(c)].reserve(texels.size());
        for (const glm::vec3& t : texels) planes[std::size_t(c)].push_back(t[c]);
    }
    write_exr(file, width, height,
              {{"R", PixelType::half, std::span<const float>(planes[0])},
               {"G", PixelType::half, std::span<const float>(planes[1])},
               {"B", PixelType::half, std::span<const float>(planes[2])}},
              {{"whiteLuminance", nit_per_unit}});
}

void write_latlong(const std::filesystem::path& file, const CubeMap& cube, float nit_per_unit) {
    const scene::Environment e =
        scene::equirect_from_cube(cube, scene::CubeSpace::direct, scene::equirect_size_of_cube(cube.size));
    write_picture(file, e.width, e.height, e.luminance_nit, nit_per_unit);
}

void write_faces(StagingFolder& files, const std::string& stem, const CubeMap& cube, float nit_per_unit) {
    const std::size_t texels = std::size_t{cube.size} * cube.size;
    for (std::size_t face = 0; face < 6; ++face) {
        write_picture(files.file(stem + "_" + kFaces[face] + ".exr"), cube.size, cube.size,
                      std::span(cube.texels).subspan(face * texels, texels), nit_per_unit);
    }
}

void write_cube(StagingFolder& files, const std::string& stem, std::span<const CubeMap> levels,
                CubeFormat format, float nit_per_unit) {
    const std::map<std::string, std::string> keys{{"candela.cubeSpace", "direct"},
                                                  {"candela.nitPerUnit", digits(nit_per_unit)}};
    if (format == CubeFormat::dds) return write_file(files.file(stem + ".dds"), encode_dds(levels));
    const TexelFormat texels = format == CubeFormat::ktx2 ? TexelFormat::rgba16f : TexelFormat::rgb9e5;
    write_file(files.file(stem + ".ktx2"), encode_ktx2(levels, texels, keys));
}

}  // namespace

void write_text(const std::filesystem::path& file, const std::string& text) {
    write_file(file, std::as_bytes(std::span(text)));
}

void write_harmonics(StagingFolder& files, const FilteredEnvironment& e) {
    write_text(files.file("irradiance_sh.json"), harmonics_json(e));
    write_text(files.file("irradiance_sh.h"), harmonics_c(e));
    write_text(files.file("irradiance_sh.glsl"), harmonics_glsl(e));
}

void write_candela(StagingFolder& files, const FilteredEnvironment& e, CubeFormat format, json& metadata) {
    const bool cube =
        format == CubeFormat::ktx2 || format == CubeFormat::ktx2_rgb9e5 || format == CubeFormat::dds;
    if (cube) {
        write_cube(files, "specular", e.specular, format, e.nit_per_unit);
        write_cube(files, "irradiance", std::span(&e.irradiance, 1), format, e.nit_per_unit);
    }
    for (std::size_t i = 0; !cube && i < e.specular.size(); ++i) {
        const std::string stem = "specular_" + std::to_string(i);
        if (format == CubeFormat::exr)
            write_latlong(files.file(stem + ".exr"), e.specular[i], e.nit_per_unit);
        else
            write_faces(files, stem, e.specular[i], e.nit_per_unit);
    }
    if (format == CubeFormat::exr) write_latlong(files.file("irradiance.exr"), e.irradiance, e.nit_per_unit);
    if (format == CubeFormat::exr_faces) write_faces(files, "irradiance", e.irradiance, e.nit_per_unit);
    write_harmonics(files, e);
    metadata["format"] = io::name_of(format);
    if (format == CubeFormat::exr) {
        metadata["orientation"] = {
            {"picture", "equirectangular, row 0 at +Y, the middle looks down -Z, +X at u = 0.75"}};
    } else {
        metadata["orientation"] = {
            {"faces",
             "+X -X +Y -Y +Z -Z, row 0 on top, laid out as Vulkan, Direct3D and OpenGL sample cubes"},
            {"lookup",
             "a direction of the right-handed world as it is; seen as pictures the faces are mirrored"}};
    }
    if (!cube) metadata["units"]["exr"] = "whiteLuminance in the header is nit_per_unit";
}

// Filament's cmgen, Ktx1Bundle and IndirectLight documentation: KTX 1 with the harmonics under "sh",
// irradiance times 1/pi, scaled by the constants of the basis; the shader looks up the world's direction as
// it is, for which cmgen mirrors its pictures unless it is told not to.
void write_filament(StagingFolder& files, const FilteredEnvironment& e, json& metadata) {
    std::string harmonics;
    for (int i = 0; i < 9; ++i) {
        const glm::vec3 c = e.irradiance_sh[std::size_t(i)] * shading::sh_scale(i);
        harmonics += digits(c.x) + " " + digits(c.y) + " " + digits(c.z) + "\n";
    }
    write_file(files.file("environment_ibl.ktx"), encode_ktx1(e.specular, {{"sh", harmonics}}));
    write_file(files.file("environment_skybox.ktx"), encode_ktx1(std::span(e.specular).first(1), {}));
    write_text(files.file("sh.txt"), harmonics);
    metadata["format"] = "KTX 1, R11F_G11F_B10F";
    metadata["orientation"] = {
        {"lookup", "a direction of the right-handed world as it is: cmgen's default (mirrored)"}};
    metadata["units"]["filament"] =
        "IndirectLight::setIntensity(nit_per_unit) and Skybox intensity nit_per_unit make Filament's "
        "radiance cd/m^2";
    metadata["irradiance"]["sh"] =
        "9 x RGB, irradiance over pi, times the constants of the basis: the shader sums the polynomial";
}

// three.js: EXRLoader with EquirectangularReflectionMapping, whose middle looks down +X (equirectUv in its
// shaders); LightProbe holds the harmonics of the radiance, and its shader convolves with the cosine.
scene::Environment threejs_picture(const FilteredEnvironment& e, const scene::Environment* source) {
    scene::Environment picture;
    double turn = 0.25;  // Candela's middle looks down -Z, a quarter to the left of +X.
    if (source != nullptr) {
        picture = *source;
        const float scale = source->scale / e.nit_per_unit;
        for (glm::vec3& texel : picture.luminance_nit) texel *= scale;
        turn += double{source->rotation_rad} / (2.0 * M_PI);
    } else {
        const CubeMap& cube = e.specular.front();
        picture = scene::equirect_from_cube(cube, scene::CubeSpace::direct,
                                            scene::equirect_size_of_cube(cube.size));
    }
    // By whole texels, so that each stays what it was.
    const double columns = std::round((turn - std::floor(turn)) * picture.width);
    const auto first = static_cast<std::ptrdiff_t>(columns) % std::ptrdiff_t{picture.width};
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        const auto row = picture.luminance_nit.begin() + std::ptrdiff_t{y} * picture.width;
        std::rotate(row, row + first, row + picture.width);
    }
    return picture;
}

void write_threejs(StagingFolder& files, const FilteredEnvironment& e, const scene::Environment* source,
                   json& metadata) {
    const scene::Environment picture = threejs_picture(e, source);
    // whiteLuminance stays 1: EXRLoader does not read it.
    write_picture(files.file("environment.exr"), picture.width, picture.height, picture.luminance_nit, 1.0f);
    json sh = json::array();
    for (int i = 0; i < 9; ++i) {
        const glm::vec3 c = e.radiance_sh[std::size_t(i)];
        for (int k = 0; k < 3; ++k) sh.push_back(c[k]);
    }
    const json probe{{"metadata", {{"version", 4.6}, {"type", "Object"}, {"generator", "candela"}}},
                     {"object", {{"type", "LightProbe"}, {"intensity", e.nit_per_unit}, {"sh", sh}}}};
    write_text(files.file("light_probe.json"), probe.dump(2) + "\n");
    metadata["format"] = "EXR, half, unfiltered: three.js filters it itself (PMREMGenerator)";
    metadata["orientation"] = {
        {"picture", "equirectangular, row 0 at +Y, the middle looks down +X, +Z at u = 0.75"},
        {"mapping", "EquirectangularReflectionMapping"}};
    metadata["units"]["threejs"] = "Scene.environmentIntensity = nit_per_unit makes radiance cd/m^2";
    metadata["irradiance"] = {{"sh",
                               "LightProbe.sh: 9 x RGB of the radiance, not convolved, without 1/pi, "
                               "not windowed; its intensity is nit_per_unit"}};
    metadata["specular"].erase("levels");
    metadata["specular"].erase("roughness_mapping");
    metadata["specular"].erase("roughness_mapping_formula");
}

}  // namespace candela::io::detail
