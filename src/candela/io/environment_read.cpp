#include "candela/io/environment_read.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "candela/io/environment_faces.hpp"
#include "candela/io/exr_read.hpp"
#include "candela/io/file_kind.hpp"
#include "candela/io/hdr_read.hpp"
#include "candela/io/image_read.hpp"
#include "candela/io/image_read_limits.hpp"
#include "candela/io/texture_read.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

namespace fs = std::filesystem;
using scene::CubeMap;
using scene::CubeSpace;
using scene::Environment;

constexpr std::size_t max_environment_bytes = std::size_t{1} << 31;

/// read_environment's promise about texels that are no luminance.
void sanitize(std::vector<glm::vec3>& texels, const std::string& name, Diagnostics& diagnostics) {
    float largest = 0.0f;
    float least = 0.0f;
    std::size_t negative = 0, undefined = 0, infinite = 0;
    for (const glm::vec3& texel : texels) {
        bool below = false, nan = false, above = false;
        for (int c = 0; c < 3; ++c) {
            if (std::isfinite(texel[c])) largest = std::max(largest, texel[c]);
            least = std::min(least, texel[c]);
            above = above || (std::isinf(texel[c]) && texel[c] > 0.0f);
            below = below || texel[c] < 0.0f;
            nan = nan || std::isnan(texel[c]);
        }
        negative += below ? 1 : 0;
        undefined += nan ? 1 : 0;
        infinite += above ? 1 : 0;
    }
    const auto of_all = [&](std::size_t count) {
        return std::to_string(count) + " of " + std::to_string(texels.size()) + " texels";
    };
    if (negative > 0) {
        char text[32];
        std::snprintf(text, sizeof(text), "%.3g", static_cast<double>(least));
        diagnostics.warn(name + ": negative luminance became 0, in " + of_all(negative) + ", the least " +
                         text + " cd/m2");
    }
    if (undefined > 0)
        diagnostics.warn(name + ": luminance that is not a number became 0, in " + of_all(undefined));
    if (infinite > 0)
        diagnostics.warn(name + ": infinite luminance became the largest finite of the map, in " +
                         of_all(infinite));
    if (negative + undefined + infinite == 0) return;
    for (glm::vec3& texel : texels) {
        for (int c = 0; c < 3; ++c) texel[c] = texel[c] >= 0.0f ? std::min(texel[c], largest) : 0.0f;
    }
}

Environment from_cube(const CubeMap& cube, CubeSpace space) {
    return scene::equirect_from_cube(cube, space, scene::equirect_size_of_cube(cube.size));
}

/// Where a face of a cross is, in faces from the left and from the top.
struct Place {
    std::uint32_t x;
    std::uint32_t y;
    bool upside_down;
};

/// The usual crosses: -X +Z +X (-Z) in a row with +Y above and -Y below +Z; upright, -Z is below -Y.
std::array<Place, 6> places(bool upright) {
    const Place behind = upright ? Place{1, 3, true} : Place{3, 1, false};
    return {{{2, 1, false}, {0, 1, false}, {1, 0, false}, {1, 2, false}, {1, 1, false}, behind}};
}

bool is_cross(const Environment& e) {
    return (e.width % 4 == 0 && e.width / 4 * 3 == e.height) ||
           (e.height % 4 == 0 && e.height / 4 * 3 == e.width);
}

CubeMap cube_of_cross(const Environment& picture) {
    const bool upright = picture.height > picture.width;
    CubeMap cube;
    cube.size = upright ? picture.width / 3 : picture.width / 4;
    cube.texels.reserve(std::size_t{6} * cube.size * cube.size);
    for (const Place& place : places(upright)) {
        for (std::uint32_t y = 0; y < cube.size; ++y) {
            for (std::uint32_t x = 0; x < cube.size; ++x) {
                const std::uint32_t u = place.upside_down ? cube.size - 1 - x : x;
                const std::uint32_t v = place.upside_down ? cube.size - 1 - y : y;
                cube.texels.push_back(
                    picture.luminance_nit[std::size_t{place.y * cube.size + v} * picture.width +
                                          place.x * cube.size + u]);
            }
        }
    }
    return cube;
}

EnvironmentLayout layout_of(const Environment& picture, EnvironmentLayout asked, const std::string& where,
                            Diagnostics& diagnostics) {
    const bool square = picture.width == picture.height;
    if (asked == EnvironmentLayout::cross && !is_cross(picture))
        throw input_error("a cross is 4 x 3 or 3 x 4 square faces", where, "--env-layout");
    if (asked == EnvironmentLayout::octahedral && !square)
        throw input_error("an octahedral picture is square", where, "--env-layout");
    if (asked == EnvironmentLayout::automatic && is_cross(picture)) return EnvironmentLayout::cross;
    // One texel is the same light from everywhere in any layout.
    if (asked == EnvironmentLayout::automatic && square && picture.width > 1) {
        diagnostics.warn(picture.name + ": square, so read as octahedral (--env-layout says otherwise)");
        return EnvironmentLayout::octahedral;
    }
    if (asked != EnvironmentLayout::automatic) return asked;
    if (picture.width != 2 * picture.height)
        diagnostics.warn(picture.name +
                         ": an equirectangular picture is twice as wide as high; this one is stretched");
    return EnvironmentLayout::equirect;
}

Environment from_picture(Environment picture, const EnvironmentOptions& options, const std::string& where,
                         Diagnostics& diagnostics) {
    switch (layout_of(picture, options.layout, where, diagnostics)) {
        case EnvironmentLayout::cross:
            return from_cube(cube_of_cross(picture), options.cube_space.value_or(CubeSpace::picture));
        case EnvironmentLayout::octahedral:
            return scene::equirect_from_octahedral(picture.luminance_nit, picture.width,
                                                   scene::equirect_size_of_octahedral(picture.width));
        default:
            return picture;
    }
}

/// A picture as its file has it; the faces of a cube one below the other.
struct Read {
    Environment picture;
    bool cube = false;
    std::optional<CubeSpace> space;
};

std::array<std::byte, 12> first_bytes(const fs::path& file) {
    (void)detail::check_readable(file);
    std::array<std::byte, 12> magic{};
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw input_error(std::string("cannot be read: ") + std::strerror(errno), file.string());
    stream.read(reinterpret_cast<char*>(magic.data()), magic.size());
    return magic;
}

Read from_texture(detail::TextureFile texture) {
    Read out;
    out.picture.width = texture.width;
    out.picture.height = texture.height * texture.faces;
    out.picture.luminance_nit = std::move(texture.texels);
    out.cube = texture.faces == 6;
    out.space = texture.space;
    return out;
}

Read read_file_of(const fs::path& file, Diagnostics& diagnostics) {
    const auto magic = first_bytes(file);
    const std::string where = file.string();
    const auto bytes = [&] { return read_file(file, max_environment_bytes); };
    if (std::memcmp(magic.data(), "\x76\x2f\x31\x01", 4) == 0)
        return {detail::read_exr_environment(file, diagnostics), false, {}};
    if (std::memcmp(magic.data(), "#?", 2) == 0)
        return {detail::decode_hdr(bytes(), where, diagnostics), false, {}};
    if (detail::is_ktx2(magic)) return from_texture(detail::decode_ktx2(bytes(), where));
    if (detail::is_dds(magic)) return from_texture(detail::decode_dds(bytes(), where));
    throw input_error(not_a("a Radiance .hdr, OpenEXR, KTX 2 or DDS picture", kind_of_file(file)), where,
                      "an environment holds luminance in cd/m^2");
}

CubeMap read_faces(const detail::FaceFiles& files, const std::string& name, Diagnostics& diagnostics) {
    CubeMap cube;
    for (const fs::path& file : files) {
        Read face = read_file_of(file, diagnostics);
        const Environment& picture = face.picture;
        if (face.cube || picture.width != picture.height)
            throw input_error("a face of a cube is square", file.string());
        if (cube.size != 0 && cube.size != picture.width)
            throw input_error("the faces of the cube differ in size", file.string());
        if (std::uint64_t{picture.width} * picture.height * 6 > detail::max_texels)
            throw input_error("the faces are too large", file.string(), "at most 2^28 texels in all");
        cube.size = picture.width;
        cube.texels.insert(cube.texels.end(), picture.luminance_nit.begin(), picture.luminance_nit.end());
    }
    sanitize(cube.texels, name, diagnostics);
    return cube;
}

}  // namespace

std::optional<EnvironmentLayout> layout_by_name(const std::string& name) {
    if (name == "auto") return EnvironmentLayout::automatic;
    if (name == "equirect") return EnvironmentLayout::equirect;
    if (name == "cross") return EnvironmentLayout::cross;
    if (name == "octahedral") return EnvironmentLayout::octahedral;
    return std::nullopt;
}

std::optional<CubeSpace> cube_space_by_name(const std::string& name) {
    if (name == "picture") return CubeSpace::picture;
    if (name == "direct") return CubeSpace::direct;
    return std::nullopt;
}

Environment read_environment(const fs::path& file, Diagnostics& diagnostics,
                             const EnvironmentOptions& options) {
    const std::string name =
        file.filename().empty() ? file.parent_path().filename().string() : file.filename().string();
    const CubeSpace space = options.cube_space.value_or(CubeSpace::picture);
    Environment out;
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) {
        out = from_cube(read_faces(detail::faces_of_folder(file), name, diagnostics), space);
    } else if (detail::is_face_pattern(file) && !fs::exists(file, ignored)) {
        out = from_cube(read_faces(detail::faces_of_pattern(file), name, diagnostics), space);
    } else {
        Read read = read_file_of(file, diagnostics);
        sanitize(read.picture.luminance_nit, name, diagnostics);
        read.picture.name = name;
        if (read.cube) {
            const CubeMap cube{read.picture.width, std::move(read.picture.luminance_nit)};
            const CubeSpace said = read.space.value_or(CubeSpace::picture);
            out = from_cube(cube, options.cube_space.value_or(said));
        } else {
            out = from_picture(std::move(read.picture), options, file.string(), diagnostics);
        }
    }
    out.name = name;
    return out;
}

}  // namespace candela::io
