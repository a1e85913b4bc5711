#include <cstdio>
// jpeglib.h needs FILE and size_t before it.
#include <jerror.h>
#include <jpeglib.h>

#include <array>
#include <csetjmp>
#include <cstring>

#include "candela/io/image_read_codecs.hpp"
#include "candela/io/image_read_limits.hpp"
#include "candela/scene/error.hpp"

namespace candela::io::detail {
namespace {

/// libjpeg reports errors by a callback that must not return. It jumps back into the step that was called;
/// the steps hold nothing with a destructor, and everything that owns memory outlives them.
class JpegReader {
  public:
    explicit JpegReader(std::span<const std::byte> bytes) : bytes_(bytes) {
        info_.err = jpeg_std_error(&errors_);
        errors_.error_exit = &JpegReader::fail;
        errors_.emit_message = &JpegReader::on_message;
        progress_.progress_monitor = &JpegReader::on_progress;
        info_.client_data = this;
    }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;
    ~JpegReader() { jpeg_destroy_decompress(&info_); }

    [[nodiscard]] const char* message() const noexcept { return message_.data(); }
    [[nodiscard]] std::uint32_t width() const noexcept { return info_.image_width; }
    [[nodiscard]] std::uint32_t height() const noexcept { return info_.image_height; }
    [[nodiscard]] bool arithmetic() const noexcept { return info_.arith_code != 0; }
    [[nodiscard]] bool four_inks() const noexcept { return info_.num_components == 4; }
    /// Adobe's files hold 255 - ink.
    [[nodiscard]] bool inverted() const noexcept { return info_.saw_Adobe_marker != 0; }

    [[nodiscard]] bool read_header() {
        if (setjmp(jump_) != 0) return false;
        jpeg_create_decompress(&info_);
        info_.client_data = this;
        info_.progress = &progress_;
        info_.mem->max_memory_to_use = 512l << 20;
        jpeg_mem_src(&info_, reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size());
        jpeg_read_header(&info_, TRUE);
        return true;
    }

    /// Four bytes a texel: RGBA, or CMYK as stored.
    [[nodiscard]] bool read_texels(std::uint8_t* out) {
        if (setjmp(jump_) != 0) return false;
        info_.out_color_space = four_inks() ? JCS_CMYK : JCS_EXT_RGBA;
        jpeg_start_decompress(&info_);
        const std::size_t row_bytes = std::size_t{4} * width();
        while (info_.output_scanline < info_.output_height) {
            JSAMPROW row = out + info_.output_scanline * row_bytes;
            jpeg_read_scanlines(&info_, &row, 1);
        }
        jpeg_finish_decompress(&info_);
        return true;
    }

  private:
    [[noreturn]] static void fail(j_common_ptr info) {
        auto& self = *static_cast<JpegReader*>(info->client_data);
        info->err->format_message(info, self.message_.data());
        std::longjmp(self.jump_, 1);
    }

    /// libjpeg goes on after lost data and fills the rest with grey; here that is an error.
    static void on_message(j_common_ptr info, int level) {
        const int code = info->err->msg_code;
        const bool lost = code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE ||
                          code == JWRN_NOT_SEQUENTIAL;
        if (level < 0 && lost) fail(info);
    }

    /// A few kilobytes can hold thousands of scans of nothing over a large picture.
    static void on_progress(j_common_ptr info) {
        constexpr int most_scans = 256;
        if (info->is_decompressor == 0) return;
        if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number <= most_scans) return;
        auto& self = *static_cast<JpegReader*>(info->client_data);
        std::strcpy(self.message_.data(), "more than 256 scans");
        std::longjmp(self.jump_, 1);
    }

    std::span<const std::byte> bytes_;
    jpeg_decompress_struct info_{};
    jpeg_error_mgr errors_{};
    jpeg_progress_mgr progress_{};
    std::array<char, JMSG_LENGTH_MAX> message_{};
    std::jmp_buf jump_{};
};

/// Naive inks: there is no profile to honour, and glTF has no CMYK.
void rgba_from_cmyk(std::vector<std::uint8_t>& texels, bool inverted) {
    const int flip = inverted ? 0 : 255;
    for (std::size_t i = 0; i < texels.size(); i += 4) {
        const int paper = texels[i + 3] ^ flip;
        for (std::size_t c = 0; c < 3; ++c)
            texels[i + c] = static_cast<std::uint8_t>(((texels[i + c] ^ flip) * paper + 127) / 255);
        texels[i + 3] = 255;
    }
}

}  // namespace

scene::Image decode_jpeg(std::span<const std::byte> bytes, const std::string& where) {
    constexpr std::uint64_t texels_per_byte = 512;
    JpegReader reader(bytes);
    const auto refuse = [&] {
        return input_error(std::string("broken JPEG picture: ") + reader.message(), where);
    };
    if (!reader.read_header()) throw refuse();
    check_size(reader.width(), reader.height(), where);
    if (reader.arithmetic()) throw input_error("JPEG with arithmetic coding is not supported", where);
    check_claim(std::uint64_t{reader.width()} * reader.height(), bytes.size(), texels_per_byte, where);
    scene::Image image;
    image.width = reader.width();
    image.height = reader.height();
    image.rgba.resize(std::size_t{4} * image.width * image.height);
    if (!reader.read_texels(image.rgba.data())) throw refuse();
    if (reader.four_inks()) rgba_from_cmyk(image.rgba, reader.inverted());
    return image;
}

}  // namespace candela::io::detail
