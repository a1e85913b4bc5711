#include <png.h>

#include <stdexcept>

#include "candela/io/image_write.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {

std::vector<std::byte> encode_png(const scene::Image& image) {
    if (image.width == 0 || image.height == 0 ||
        image.rgba.size() != std::size_t{4} * image.width * image.height)
        throw std::invalid_argument("encode_png: the pixels are not width x height x 4");
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = image.width;
    header.height = image.height;
    header.format = PNG_FORMAT_RGBA;
    header.flags = PNG_IMAGE_FLAG_FAST;
    std::vector<std::byte> out(PNG_IMAGE_PNG_SIZE_MAX(header));
    png_alloc_size_t size = out.size();
    if (png_image_write_to_memory(&header, out.data(), &size, 0, image.rgba.data(), 0, nullptr) == 0)
        throw machine_error(std::string("cannot be written as PNG: ") + header.message, image.name);
    out.resize(size);
    return out;
}

}  // namespace candela::io
