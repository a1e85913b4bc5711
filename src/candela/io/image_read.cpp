#include "candela/io/image_read.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "candela/io/file_kind.hpp"
#include "candela/io/image_read_codecs.hpp"
#include "candela/io/image_read_limits.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

namespace fs = std::filesystem;

bool starts_with(std::span<const std::byte> bytes, std::string_view magic, std::size_t offset = 0) {
    return bytes.size() >= offset + magic.size() &&
           std::memcmp(bytes.data() + offset, magic.data(), magic.size()) == 0;
}

std::ifstream open(const fs::path& file) {
    (void)detail::check_readable(file);
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw input_error(std::string("cannot be read: ") + std::strerror(errno), file.string());
    return stream;
}

}  // namespace

namespace detail {

std::uint64_t check_readable(const fs::path& file) {
    std::error_code failure;
    const fs::file_status status = fs::status(file, failure);
    const std::string name = file.string();
    if (status.type() == fs::file_type::not_found) throw input_error("no such file", name);
    if (status.type() == fs::file_type::directory) throw input_error("is a folder, not a file", name);
    if (failure) throw input_error("cannot be read: " + failure.message(), name);
    if (status.type() != fs::file_type::regular) throw input_error("is not a regular file", name);
    const std::uintmax_t size = fs::file_size(file, failure);
    if (failure) throw input_error("cannot be read: " + failure.message(), name);
    return size;
}

void check_memory(std::uint64_t width, std::uint64_t height, const std::optional<scene::MemoryBudget>& memory,
                  const std::string& where) {
    if (memory) memory->require(environment_bytes(width * height), "the picture takes", where);
}

void check_size(std::uint64_t width, std::uint64_t height, const std::string& where) {
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    if (width == 0 || height == 0) throw input_error("the picture is empty: " + size, where);
    if (width > max_side_texels || height > max_side_texels || width * height > max_texels) {
        throw input_error("the picture is too large: " + size, where, "at most 16384 on a side");
    }
}

void check_claim(std::uint64_t claimed, std::uint64_t file_bytes, std::uint64_t most_per_byte,
                 const std::string& where) {
    if (claimed / most_per_byte <= file_bytes) return;
    throw input_error(
        "the header claims a larger picture than " + std::to_string(file_bytes) + " bytes of data can hold",
        where);
}

}  // namespace detail

std::vector<std::byte> read_file(const fs::path& file, std::size_t max_bytes) {
    const std::uint64_t size = detail::check_readable(file);
    if (size > max_bytes) {
        throw input_error("the file is too large: " + std::to_string(size) + " bytes", file.string(),
                          "at most " + std::to_string(max_bytes));
    }
    std::ifstream stream = open(file);
    std::vector<std::byte> bytes(size);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (static_cast<std::uintmax_t>(stream.gcount()) != size)
        throw input_error("cannot be read to its end", file.string());
    return bytes;
}

bool is_display_picture(std::span<const std::byte> bytes) {
    return starts_with(bytes, "\x89PNG\r\n\x1a\n") || starts_with(bytes, "\xff\xd8\xff") ||
           (starts_with(bytes, "RIFF") && starts_with(bytes, "WEBP", 8));
}

scene::Image decode_image(std::span<const std::byte> bytes, const std::string& where) {
    if (starts_with(bytes, "\x89PNG\r\n\x1a\n")) return detail::decode_png(bytes, where);
    if (starts_with(bytes, "\xff\xd8\xff")) return detail::decode_jpeg(bytes, where);
    if (starts_with(bytes, "RIFF") && starts_with(bytes, "WEBP", 8)) return detail::decode_webp(bytes, where);
    if (bytes.empty()) throw input_error("the picture is empty", where);
    throw input_error(not_a("a PNG, JPEG or WebP picture", kind_of_file(bytes, where)), where);
}

const std::vector<float>* FloatImage::find(const std::string& channel) const {
    const auto found = std::find(channels.begin(), channels.end(), channel);
    if (found == channels.end()) return nullptr;
    return &data[static_cast<std::size_t>(found - channels.begin())];
}

}  // namespace candela::io
