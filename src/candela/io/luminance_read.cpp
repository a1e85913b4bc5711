#include "candela/io/luminance_read.hpp"

#include <ImfFloatAttribute.h>
#include <ImfHeader.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStringAttribute.h>

#include <array>
#include <cstring>
#include <fstream>

#include "candela/io/exr_read.hpp"
#include "candela/io/hdr_read.hpp"
#include "candela/io/image_read.hpp"
#include "candela/io/image_read_limits.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

constexpr std::size_t max_hdr_bytes = std::size_t{1} << 31;

std::array<char, 4> first_bytes(const std::filesystem::path& file) {
    (void)detail::check_readable(file);
    std::array<char, 4> magic{};
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw input_error("cannot be read", file.string());
    stream.read(magic.data(), magic.size());
    return magic;
}

bool is_exr(const std::array<char, 4>& magic) {
    return std::memcmp(magic.data(), "\x76\x2f\x31\x01", 4) == 0;
}
bool is_hdr(const std::array<char, 4>& magic) {
    return std::memcmp(magic.data(), "#?", 2) == 0;
}

std::map<std::string, ExrAttribute> exr_attributes(const std::filesystem::path& file) {
    std::map<std::string, ExrAttribute> out;
    try {
        const Imf::MultiPartInputFile input(file.string().c_str(), 0);
        const Imf::Header& header = input.header(0);
        for (auto a = header.begin(); a != header.end(); ++a) {
            if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&a.attribute())) {
                out[a.name()] = number->value();
            } else if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute())) {
                out[a.name()] = text->value();
            }
        }
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw input_error(std::string("broken EXR picture: ") + error.what(), file.string());
    }
    return out;
}

}  // namespace

bool is_luminance_file(const std::filesystem::path& file) {
    const auto magic = first_bytes(file);
    return is_exr(magic) || is_hdr(magic);
}

LuminanceImage read_luminance(const std::filesystem::path& file, Diagnostics& diagnostics) {
    const auto magic = first_bytes(file);
    if (!is_exr(magic) && !is_hdr(magic))
        throw input_error("not a Radiance .hdr or OpenEXR picture", file.string());
    scene::Environment read =
        is_exr(magic) ? detail::read_exr_environment(file, diagnostics)
                      : detail::decode_hdr(read_file(file, max_hdr_bytes), file.string(), diagnostics);
    LuminanceImage out;
    out.width = read.width;
    out.height = read.height;
    out.luminance_nit = std::move(read.luminance_nit);
    if (is_exr(magic)) out.attributes = exr_attributes(file);
    return out;
}

}  // namespace candela::io
