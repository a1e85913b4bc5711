#include "candela/measure/inline_png.hpp"

#include <png.h>

#include <span>
#include <stdexcept>

#include "candela/scene/error.hpp"

namespace candela::measure {
namespace {

/// RFC 4648, section 4.
std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = std::uint32_t{bytes[i]} << 16u;
        if (count > 1) group |= std::uint32_t{bytes[i + 1]} << 8u;
        if (count > 2) group |= std::uint32_t{bytes[i + 2]};
        for (std::size_t k = 0; k < 4; ++k) out += k <= count ? digits[(group >> (18 - 6 * k)) & 63u] : '=';
    }
    return out;
}

}  // namespace

std::string png_data_uri(const Panel& picture) {
    if (picture.rgb.size() != std::size_t{3} * picture.width * picture.height || picture.rgb.empty())
        throw std::invalid_argument("png_data_uri: the pixels are not width x height x 3");
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = picture.width;
    image.height = picture.height;
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = 0;
    if (png_image_write_get_memory_size(image, size, 0, picture.rgb.data(), 0, nullptr) == 0)
        throw machine_error(std::string("a picture cannot be encoded: ") + image.message);
    std::vector<std::uint8_t> bytes(size);
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr) == 0)
        throw machine_error(std::string("a picture cannot be encoded: ") + image.message);
    bytes.resize(size);
    return "data:image/png;base64," + base64(bytes);
}

}  // namespace candela::measure
