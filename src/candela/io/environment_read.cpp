#include "candela/io/environment_read.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>

#include "candela/io/environment_faces.hpp"
#include "candela/io/exr_read.hpp"
#include "candela/io/file_kind.hpp"
#include "candela/io/hdr_read.hpp"
#include "candela/io/image_read.hpp"
#include "candela/io/image_read_codecs.hpp"
#include "candela/io/image_read_limits.hpp"
#include "candela/io/texture_read.hpp"
#include "candela/scene/environment_negative.hpp"
#include "candela/scene/environment_sources.hpp"
#include "candela/scene/error.hpp"
#include "shading/transfer.glsl"

namespace candela::io {
namespace {

namespace fs = std::filesystem;
using scene::CubeMap;
using scene::CubeSpace;
using scene::Environment;

constexpr std::size_t max_environment_bytes = std::size_t{1} << 31;

/// What of the values that a file has is no luminance.
struct Census {
    std::size_t texels = 0;
    std::size_t negative = 0;
    std::size_t undefined = 0;
    std::size_t infinite = 0;
    float least = 0.0f;
};

/// NaN and minus infinity become 0, infinity the largest finite value; negative ones stay.
Census repair(std::vector<glm::vec3>& texels) {
    Census out;
    out.texels = texels.size();
    float largest = 0.0f;
    for (const glm::vec3& texel : texels) {
        bool below = false, nan = false, above = false;
        for (int c = 0; c < 3; ++c) {
            if (std::isfinite(texel[c])) largest = std::max(largest, texel[c]);
            out.least = std::min(out.least, texel[c]);
            above = above || (std::isinf(texel[c]) && texel[c] > 0.0f);
            below = below || texel[c] < 0.0f;
            nan = nan || std::isnan(texel[c]);
        }
        out.negative += below ? 1 : 0;
        out.undefined += nan ? 1 : 0;
        out.infinite += above ? 1 : 0;
    }
    if (out.negative + out.undefined + out.infinite == 0) return out;
    constexpr float lowest = std::numeric_limits<float>::lowest();
    for (glm::vec3& texel : texels) {
        for (int c = 0; c < 3; ++c) texel[c] = texel[c] >= lowest ? std::min(texel[c], largest) : 0.0f;
    }
    return out;
}

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.3g", value);
    return text;
}

/// What was done about negative values does to the light.
std::string change_of_light(double before_lx, double after_lx) {
    if (!(before_lx > 0.0))
        return "the up-facing illuminance of " + short_number(before_lx) + " became " +
               short_number(after_lx);
    const double percent = 100.0 * (after_lx / before_lx - 1.0);
    if (std::abs(percent) < 0.05) return "the up-facing illuminance stays within 0.05 %";
    return "the up-facing illuminance is " + short_number(std::abs(percent)) + " % " +
           (percent > 0.0 ? "higher" : "lower");
}

/// read_environment's promise about negative values, with all that was amiss said.
void settle(const Census& census, NegativeTexels how, ReadEnvironment& e, Diagnostics& diagnostics) {
    const auto of_all = [&](std::size_t count) {
        return std::to_string(count) + " of " + std::to_string(census.texels) + " texels";
    };
    if (census.negative > 0) {
        const bool spread = how == NegativeTexels::spread;
        const double before_lx = scene::upward_illuminance_lx(e);
        if (spread)
            scene::spread_negative(e);
        else
            scene::clamp_negative(e);
        const double after_lx = scene::upward_illuminance_lx(e);
        const bool changed = std::abs(after_lx - before_lx) >= 5.0e-4 * std::abs(before_lx);
        diagnostics.warn(e.name +
                         (spread ? ": negative luminance was taken from its neighbours, in "
                                 : ": negative luminance became 0, in ") +
                         of_all(census.negative) + ", the least " + short_number(double{census.least}) +
                         (e.absolute ? " cd/m2; " : "; ") + change_of_light(before_lx, after_lx) +
                         (spread || !changed ? "" : " (--env-negative spread keeps it)"));
    }
    if (census.undefined > 0)
        diagnostics.warn(e.name + ": luminance that is not a number became 0, in " +
                         of_all(census.undefined));
    if (census.infinite > 0)
        diagnostics.warn(e.name + ": infinite luminance became the largest finite of the map, in " +
                         of_all(census.infinite));
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
    if ((asked == EnvironmentLayout::angular || asked == EnvironmentLayout::mirror_ball) && !square)
        throw input_error("an angular map and the picture of a mirror ball are square", where,
                          "--env-layout; crop it to the circle");
    if (asked == EnvironmentLayout::automatic && is_cross(picture)) return EnvironmentLayout::cross;
    // One texel is the same light from everywhere in any layout.
    if (asked == EnvironmentLayout::automatic && square && picture.width > 1) {
        diagnostics.warn(
            picture.name +
            ": square, so read as octahedral (--env-layout angular, mirror-ball or equirect for others)");
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
    const EnvironmentLayout layout = layout_of(picture, options.layout, where, diagnostics);
    switch (layout) {
        case EnvironmentLayout::cross:
            return from_cube(cube_of_cross(picture), options.cube_space.value_or(CubeSpace::picture));
        case EnvironmentLayout::octahedral:
            return scene::equirect_from_octahedral(picture.luminance_nit, picture.width,
                                                   scene::equirect_size_of_octahedral(picture.width));
        case EnvironmentLayout::angular:
        case EnvironmentLayout::mirror_ball: {
            const auto projection = layout == EnvironmentLayout::angular
                                        ? scene::CircleProjection::angular
                                        : scene::CircleProjection::mirror_ball;
            return scene::equirect_from_circle(picture.luminance_nit, picture.width, projection,
                                               scene::equirect_size_of_circle(projection, picture.width));
        }
        default:
            return picture;
    }
}

/// A picture as its file has it; the faces of a cube one below the other.
struct Read {
    Environment picture;
    bool cube = false;
    std::optional<CubeSpace> space;
    bool absolute = false;
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
    out.absolute = texture.absolute;
    out.cube = texture.faces == 6;
    out.space = texture.space;
    return out;
}

/// A photograph as light: linear, white is 1. PNG pictures of 16 bits a channel keep them.
Environment read_display_picture(std::span<const std::byte> bytes, const std::string& where,
                                 const std::string& name, const scene::MemoryBudget& memory,
                                 Diagnostics& diagnostics) {
    detail::check_memory(decoded_bytes(bytes) / 4, 1, memory, where);
    Environment out;
    const auto fill = [&out](const auto& picture, const auto& samples, std::size_t stride, float full) {
        out.width = picture.width;
        out.height = picture.height;
        std::vector<float> linear(static_cast<std::size_t>(full) + 1);
        for (std::size_t i = 0; i < linear.size(); ++i)
            linear[i] = shading::linear_from_srgb(static_cast<float>(i) / full);
        out.luminance_nit.reserve(std::size_t{out.width} * out.height);
        for (std::size_t i = 0; i + 2 < samples.size(); i += stride)
            out.luminance_nit.emplace_back(linear[samples[i]], linear[samples[i + 1]],
                                           linear[samples[i + 2]]);
    };
    const std::optional<detail::Png16> deep = detail::decode_png_16(bytes, where);
    if (deep) {
        fill(*deep, deep->rgb, 3, 65535.0f);
    } else {
        const scene::Image image = decode_image(bytes, where);
        fill(image, image.rgba, 4, 255.0f);
    }
    diagnostics.warn(name + ": a picture for displays, " + (deep ? "16" : "8") +
                     " bits a channel: what is brighter than white is not in "
                     "it, so a sun and lamps give too little light and no highlights");
    return out;
}

Read read_file_of(const fs::path& file, const EnvironmentOptions& options, Diagnostics& diagnostics) {
    const auto magic = first_bytes(file);
    const std::string where = file.string();
    const auto bytes = [&] { return read_file(file, max_environment_bytes); };
    const scene::MemoryBudget memory = options.memory ? *options.memory : scene::available_memory();
    if (std::memcmp(magic.data(), "\x76\x2f\x31\x01", 4) == 0) {
        ReadEnvironment exr =
            detail::read_exr_environment(file, diagnostics, options.layer, memory, options.progress);
        const bool absolute = exr.absolute;
        return {std::move(exr), false, {}, absolute};
    }
    if (!options.layer.empty())
        throw input_error("has no layers: it is not an OpenEXR picture", where, "leave --env-layer out");
    if (std::memcmp(magic.data(), "#?", 2) == 0)
        return {detail::decode_hdr(bytes(), where, diagnostics, memory, options.progress), false, {}};
    if (detail::is_ktx2(magic)) return from_texture(detail::decode_ktx2(bytes(), where, memory));
    if (detail::is_dds(magic)) return from_texture(detail::decode_dds(bytes(), where, memory));
    if (is_display_picture(magic))
        return {
            read_display_picture(bytes(), where, file.filename().string(), memory, diagnostics), false, {}};
    if (std::error_code ignored; fs::file_size(file, ignored) == 0)
        throw input_error("the file is empty", where, "a picture of the light is expected");
    throw input_error(
        not_a("a Radiance .hdr, OpenEXR, KTX 2, DDS, PNG, JPEG or WebP picture", kind_of_file(file)), where,
        "an environment holds luminance in cd/m^2");
}

CubeMap read_faces(const detail::FaceFiles& files, const EnvironmentOptions& options, bool& absolute,
                   Diagnostics& diagnostics) {
    CubeMap cube;
    double done = 0.0;
    EnvironmentOptions one = options;
    if (options.progress)
        one.progress = [&](double fraction) { options.progress((done + fraction) / double(files.size())); };
    for (const fs::path& file : files) {
        Read face = read_file_of(file, one, diagnostics);
        done += 1.0;
        absolute = face.absolute;
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
    return cube;
}

}  // namespace

std::optional<EnvironmentLayout> layout_by_name(const std::string& name) {
    if (name == "auto") return EnvironmentLayout::automatic;
    if (name == "equirect") return EnvironmentLayout::equirect;
    if (name == "cross") return EnvironmentLayout::cross;
    if (name == "octahedral") return EnvironmentLayout::octahedral;
    if (name == "angular") return EnvironmentLayout::angular;
    if (name == "mirror-ball") return EnvironmentLayout::mirror_ball;
    return std::nullopt;
}

std::optional<CubeSpace> cube_space_by_name(const std::string& name) {
    if (name == "picture") return CubeSpace::picture;
    if (name == "direct") return CubeSpace::direct;
    return std::nullopt;
}

ReadEnvironment read_environment(const fs::path& file, Diagnostics& diagnostics,
                                 const EnvironmentOptions& options) {
    const std::string name =
        file.filename().empty() ? file.parent_path().filename().string() : file.filename().string();
    const CubeSpace space = options.cube_space.value_or(CubeSpace::picture);
    ReadEnvironment out;
    Environment& picture = out;
    Census census;
    const auto from_faces = [&](const detail::FaceFiles& files) {
        CubeMap cube = read_faces(files, options, out.absolute, diagnostics);
        census = repair(cube.texels);
        return from_cube(cube, space);
    };
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) {
        picture = from_faces(detail::faces_of_folder(file));
    } else if (detail::is_face_pattern(file) && !fs::exists(file, ignored)) {
        picture = from_faces(detail::faces_of_pattern(file));
    } else {
        Read read = read_file_of(file, options, diagnostics);
        out.absolute = read.absolute;
        census = repair(read.picture.luminance_nit);
        read.picture.name = name;
        if (read.cube) {
            const CubeMap cube{read.picture.width, std::move(read.picture.luminance_nit)};
            const CubeSpace said = read.space.value_or(CubeSpace::picture);
            picture = from_cube(cube, options.cube_space.value_or(said));
        } else {
            picture = from_picture(std::move(read.picture), options, file.string(), diagnostics);
        }
    }
    out.name = name;
    settle(census, options.negative, out, diagnostics);
    return out;
}

}  // namespace candela::io
