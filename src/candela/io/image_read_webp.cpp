#include <webp/decode.h>

#include "candela/io/image_read_codecs.hpp"
#include "candela/io/image_read_limits.hpp"
#include "candela/scene/error.hpp"

namespace candela::io::detail {
namespace {

const char* reason(VP8StatusCode status) {
    switch (status) {
        case VP8_STATUS_OUT_OF_MEMORY:
            return "out of memory";
        case VP8_STATUS_UNSUPPORTED_FEATURE:
            return "unsupported feature";
        case VP8_STATUS_SUSPENDED:
        case VP8_STATUS_NOT_ENOUGH_DATA:
            return "the data ends too early";
        default:
            return "corrupt data";
    }
}

void check(VP8StatusCode status, const std::string& where) {
    if (status != VP8_STATUS_OK)
        throw input_error(std::string("broken WebP picture: ") + reason(status), where);
}

}  // namespace

scene::Image decode_webp(std::span<const std::byte> bytes, const std::string& where) {
    constexpr std::uint64_t free_texels = 1u << 24, texels_per_byte = 1u << 14;
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    WebPDecoderConfig config;
    if (WebPInitDecoderConfig(&config) == 0) throw machine_error("libwebp is of another version", where);
    check(WebPGetFeatures(data, bytes.size(), &config.input), where);
    if (config.input.has_animation != 0) throw input_error("an animated WebP is not a texture", where);
    scene::Image image;
    image.width = static_cast<std::uint32_t>(config.input.width);
    image.height = static_cast<std::uint32_t>(config.input.height);
    check_size(image.width, image.height, where);
    const std::uint64_t texels = std::uint64_t{image.width} * image.height;
    if (texels > free_texels) check_claim(texels, bytes.size(), texels_per_byte, where);
    image.rgba.resize(4 * texels);
    config.output.colorspace = MODE_RGBA;
    config.output.is_external_memory = 1;
    config.output.u.RGBA.rgba = image.rgba.data();
    config.output.u.RGBA.stride = static_cast<int>(4 * image.width);
    config.output.u.RGBA.size = image.rgba.size();
    const VP8StatusCode status = WebPDecode(data, bytes.size(), &config);
    WebPFreeDecBuffer(&config.output);
    check(status, where);
    return image;
}

}  // namespace candela::io::detail
