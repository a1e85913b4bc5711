#include <png.h>

#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>

#include "candela/io/image_read_codecs.hpp"
#include "candela/io/image_read_limits.hpp"
#include "candela/scene/error.hpp"

namespace candela::io::detail {
namespace {

/// libpng reports errors by longjmp. Everything that owns memory lives here or in decode_png, and the steps
/// between setjmp and the call that may fail hold nothing with a destructor.
class PngReader {
  public:
    explicit PngReader(std::span<const std::byte> bytes) : left_(bytes) {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &PngReader::fail, [](auto, auto) {});
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
    }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

    [[nodiscard]] bool ready() const noexcept { return info_ != nullptr; }
    [[nodiscard]] const char* message() const noexcept { return message_.data(); }

    [[nodiscard]] bool read_header() {
        if (setjmp(jump_) != 0) return false;
        png_set_read_fn(png_, this, &PngReader::read);
        // The sizes are checked by check_size, with a message of our own.
        png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        // glTF: colour space chunks are ignored. Text may be megabytes of nothing.
        constexpr png_byte skipped[] = "tEXt\0zTXt\0iTXt\0iCCP\0gAMA\0cHRM\0sRGB\0eXIf";
        png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, skipped, 8);
        png_read_info(png_, info_);
        return true;
    }

    [[nodiscard]] std::uint32_t width() const { return png_get_image_width(png_, info_); }
    [[nodiscard]] std::uint32_t height() const { return png_get_image_height(png_, info_); }
    /// As stored, before any expansion, with the filter byte.
    [[nodiscard]] std::uint64_t raw_row_bytes() const { return png_get_rowbytes(png_, info_) + 1; }

    [[nodiscard]] bool has_16_bits() const { return png_get_bit_depth(png_, info_) == 16; }

    [[nodiscard]] bool read_texels(std::uint8_t* rgba) {
        if (setjmp(jump_) != 0) return false;
        png_set_expand(png_);
        png_set_scale_16(png_);
        png_set_gray_to_rgb(png_);
        png_set_add_alpha(png_, 0xff, PNG_FILLER_AFTER);
        read_rows(rgba, std::size_t{4} * width());
        return true;
    }

    /// RGB in the machine's order of bytes.
    [[nodiscard]] bool read_texels_16(std::uint16_t* rgb) {
        if (setjmp(jump_) != 0) return false;
        png_set_gray_to_rgb(png_);
        png_set_strip_alpha(png_);
        if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
        read_rows(reinterpret_cast<std::uint8_t*>(rgb), std::size_t{6} * width());
        return true;
    }

  private:
    void read_rows(std::uint8_t* to, std::size_t row_bytes) {
        const int passes = png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        if (png_get_rowbytes(png_, info_) != row_bytes) png_error(png_, "unexpected row size");
        for (int pass = 0; pass < passes; ++pass) {
            for (std::uint32_t row = 0; row < height(); ++row)
                png_read_row(png_, to + row * row_bytes, nullptr);
        }
        png_read_end(png_, nullptr);
    }

    static void read(png_structp png, png_bytep out, png_size_t count) {
        auto& self = *static_cast<PngReader*>(png_get_io_ptr(png));
        if (count > self.left_.size()) png_error(png, "the data ends too early");
        std::memcpy(out, self.left_.data(), count);
        self.left_ = self.left_.subspan(count);
    }

    [[noreturn]] static void fail(png_structp png, png_const_charp message) {
        auto& self = *static_cast<PngReader*>(png_get_error_ptr(png));
        std::strncpy(self.message_.data(), message, self.message_.size() - 1);
        std::longjmp(self.jump_, 1);
    }

    std::span<const std::byte> left_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    std::array<char, 128> message_{};
    std::jmp_buf jump_{};
};

constexpr std::uint64_t kDeflateRatio = 1032;

Error broken(const PngReader& reader, const std::string& where) {
    return input_error(std::string("broken PNG picture: ") + reader.message(), where);
}

/// Before memory is taken.
void open(PngReader& reader, std::size_t bytes, const std::string& where) {
    if (!reader.ready()) throw machine_error("out of memory", where);
    if (!reader.read_header()) throw broken(reader, where);
    check_size(reader.width(), reader.height(), where);
    check_claim(reader.raw_row_bytes() * reader.height(), bytes, kDeflateRatio, where);
}

}  // namespace

scene::Image decode_png(std::span<const std::byte> bytes, const std::string& where) {
    PngReader reader(bytes);
    open(reader, bytes.size(), where);
    scene::Image image;
    image.width = reader.width();
    image.height = reader.height();
    image.rgba.resize(std::size_t{4} * image.width * image.height);
    if (!reader.read_texels(image.rgba.data())) throw broken(reader, where);
    return image;
}

std::optional<Png16> decode_png_16(std::span<const std::byte> bytes, const std::string& where) {
    if (bytes.size() < 8 || std::memcmp(bytes.data(), "\x89PNG\r\n\x1a\n", 8) != 0) return std::nullopt;
    PngReader reader(bytes);
    open(reader, bytes.size(), where);
    if (!reader.has_16_bits()) return std::nullopt;
    Png16 image{reader.width(), reader.height(), {}};
    image.rgb.resize(std::size_t{3} * image.width * image.height);
    if (!reader.read_texels_16(image.rgb.data())) throw broken(reader, where);
    return image;
}

}  // namespace candela::io::detail
