#include "encoders.hpp"

#include <png.h>
#include <webp/encode.h>

#include <cstdio>
// jpeglib.h needs FILE before it.
#include <jpeglib.h>

#include <cstdlib>
#include <memory>

namespace candela::tests {

Bytes encode_png(const PngKind& kind, const std::vector<std::uint8_t>& rows) {
    Bytes out;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png, &out,
        [](png_structp p, png_bytep data, png_size_t count) {
            auto& bytes = *static_cast<Bytes*>(png_get_io_ptr(p));
            const auto* first = reinterpret_cast<const std::byte*>(data);
            bytes.insert(bytes.end(), first, first + count);
        },
        nullptr);
    png_set_IHDR(png, info, kind.width, kind.height, kind.bits, kind.color_type,
                 kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (!kind.palette.empty()) {
        png_set_PLTE(png, info, reinterpret_cast<const png_color*>(kind.palette.data()),
                     static_cast<int>(kind.palette.size() / 3));
    }
    if (!kind.transparency.empty()) {
        png_color_16 clear{};
        clear.gray = kind.transparency[0];
        png_set_tRNS(png, info, kind.transparency.data(), static_cast<int>(kind.transparency.size()), &clear);
    }
    png_write_info(png, info);
    const std::size_t row_bytes = png_get_rowbytes(png, info);
    std::vector<png_bytep> pointers;
    for (std::uint32_t y = 0; y < kind.height; ++y)
        pointers.push_back(const_cast<png_bytep>(rows.data() + y * row_bytes));
    png_write_image(png, pointers.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return out;
}

Bytes encode_jpeg(const JpegKind& kind, const std::vector<std::uint8_t>& texels) {
    jpeg_compress_struct info{};
    jpeg_error_mgr errors{};
    info.err = jpeg_std_error(&errors);
    jpeg_create_compress(&info);
    unsigned char* memory = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&info, &memory, &size);
    info.image_width = kind.width;
    info.image_height = kind.height;
    info.input_components = kind.components;
    info.in_color_space = kind.components == 1 ? JCS_GRAYSCALE : kind.components == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, 100, TRUE);
    info.write_Adobe_marker = kind.components == 4 && kind.adobe ? TRUE : FALSE;
    if (kind.progressive) jpeg_simple_progression(&info);
    jpeg_start_compress(&info, TRUE);
    while (info.next_scanline < kind.height) {
        auto* row = const_cast<JSAMPROW>(texels.data()) +
                    std::size_t{info.next_scanline} * kind.width * static_cast<std::size_t>(kind.components);
        jpeg_write_scanlines(&info, &row, 1);
    }
    jpeg_finish_compress(&info);
    jpeg_destroy_compress(&info);
    const auto* first = reinterpret_cast<const std::byte*>(memory);
    Bytes out(first, first + size);
    std::free(memory);
    return out;
}

Bytes encode_webp(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& rgba) {
    std::uint8_t* memory = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(
        rgba.data(), static_cast<int>(width), static_cast<int>(height), static_cast<int>(4 * width), &memory);
    const auto* first = reinterpret_cast<const std::byte*>(memory);
    Bytes out(first, first + size);
    WebPFree(memory);
    return out;
}

}  // namespace candela::tests
