#include "candela/io/exr_read.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfTileDescriptionAttribute.h>

#include <algorithm>
#include <cmath>

#include "candela/io/exr_threads.hpp"
#include "candela/io/image_read.hpp"
#include "candela/io/image_read_limits.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

using Imath::Box2i;

struct Size {
    std::uint64_t width = 0;
    std::uint64_t height = 0;
};

Size size_of(const Box2i& box) {
    const auto extent = [](int low, int high) {
        return static_cast<std::uint64_t>(std::max<std::int64_t>(std::int64_t{high} - low + 1, 0));
    };
    return {extent(box.min.x, box.max.x), extent(box.min.y, box.max.y)};
}

std::string channel_list(const Imf::ChannelList& channels) {
    std::string names;
    for (auto c = channels.begin(); c != channels.end(); ++c)
        names += std::string(names.empty() ? "" : ", ") + c.name();
    return names;
}

int bytes_of(Imf::PixelType type) {
    return type == Imf::HALF ? 2 : 4;
}

/// Everything in the header that decides how much memory reading takes.
void check_header(const Imf::Header& header, std::uint64_t file_bytes, const std::string& where) {
    if (header.hasType() && Imf::isDeepData(header.type())) throw input_error("deep EXR is not read", where);
    const Size data = size_of(header.dataWindow()), display = size_of(header.displayWindow());
    detail::check_size(data.width, data.height, where);
    detail::check_size(display.width, display.height, where);
    std::uint64_t texel_bytes = 0, channels = 0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c, ++channels) {
        if (c.channel().xSampling != 1 || c.channel().ySampling != 1) {
            throw input_error(std::string("subsampled channel ") + c.name(), where,
                              "save luminance-chroma pictures as RGB");
        }
        texel_bytes += static_cast<std::uint64_t>(bytes_of(c.channel().type));
    }
    const std::uint64_t texels = data.width * data.height;
    if (texels * channels > detail::max_texels)
        throw input_error("the picture is too large: " + std::to_string(texels * channels) + " samples",
                          where, "at most 2^28");
    // The flattest picture in the densest coding (DWAB) stays below this.
    detail::check_claim(texels * texel_bytes, file_bytes, std::uint64_t{1} << 16, where);
    if (!header.hasTileDescription()) return;
    const Imf::TileDescription& tile = header.tileDescription();
    if (tile.xSize > detail::max_side_texels || tile.ySize > detail::max_side_texels ||
        std::uint64_t{tile.xSize} * tile.ySize * texel_bytes > (std::uint64_t{1} << 28)) {
        throw input_error("the tiles are too large", where);
    }
}

/// Runs `read(header, part)` on the first part, with OpenEXR's exceptions turned into ours.
template <class Read>
void read_first_part(const std::filesystem::path& file, Read&& read) {
    const std::string where = file.string();
    const std::uint64_t bytes = detail::check_readable(file);
    try {
        constexpr std::uint64_t bytes_per_texel = 4;  // a guess is enough to choose threads
        Imf::MultiPartInputFile input(where.c_str(), detail::exr_threads(bytes / bytes_per_texel));
        const Imf::Header& header = input.header(0);
        check_header(header, bytes, where);
        Imf::InputPart part(input, 0);
        if (!part.isComplete()) throw input_error("broken EXR picture: the data ends too early", where);
        read(header, part);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw input_error(std::string("broken EXR picture: ") + error.what(), where);
    }
}

/// A float slice whose texel (x, y) of the data window lies at base[((y - top) * row + x - left) * step].
Imf::Slice slice_of(float* base, const Box2i& window, std::size_t row, std::size_t step) {
    const std::size_t x_stride = step * sizeof(float), y_stride = row * x_stride;
    return Imf::Slice::Make(Imf::FLOAT, base, window, x_stride, y_stride);
}

std::vector<std::string> luminance_channels(const Imf::ChannelList& channels, const std::string& where) {
    const bool rgb = channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B");
    if (rgb) return {"R", "G", "B"};
    if (channels.findChannel("Y") != nullptr) return {"Y"};
    throw input_error("has neither R, G, B nor Y", where, "its channels are " + channel_list(channels));
}

std::vector<glm::vec3> read_colors(const Imf::Header& header, Imf::InputPart& part,
                                   const std::string& where) {
    const Box2i window = header.dataWindow();
    const Size size = size_of(window);
    std::vector<glm::vec3> texels(size.width * size.height);
    const std::vector<std::string> names = luminance_channels(header.channels(), where);
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < names.size(); ++c)
        frame.insert(names[c], slice_of(&texels[0].x + c, window, size.width, 3));
    part.setFrameBuffer(frame);
    part.readPixels(window.min.y, window.max.y);
    if (names.size() == 1) {
        for (glm::vec3& texel : texels) texel = glm::vec3(texel.x);
    }
    return texels;
}

/// The display window of a picture given as its data window.
std::vector<glm::vec3> display_of(const std::vector<glm::vec3>& texels, const Box2i& data,
                                  const Box2i& display) {
    const Size from = size_of(data), to = size_of(display);
    std::vector<glm::vec3> out(to.width * to.height, glm::vec3(0.0f));
    const int left = std::max(data.min.x, display.min.x), right = std::min(data.max.x, display.max.x);
    for (int y = std::max(data.min.y, display.min.y); y <= std::min(data.max.y, display.max.y); ++y) {
        if (left > right) break;
        const auto offset = [&](const Box2i& box, const Size& size) {
            return static_cast<std::ptrdiff_t>(std::uint64_t(y - box.min.y) * size.width +
                                               std::uint64_t(left - box.min.x));
        };
        std::copy_n(texels.begin() + offset(data, from), right - left + 1, out.begin() + offset(display, to));
    }
    return out;
}

bool is_rec709(const Imf::Chromaticities& c) {
    const Imf::Chromaticities rec709;
    const auto near = [](const Imath::V2f& a, const Imath::V2f& b) { return (a - b).length() < 0.002f; };
    return near(c.red, rec709.red) && near(c.green, rec709.green) && near(c.blue, rec709.blue) &&
           near(c.white, rec709.white);
}

/// Windows far apart must not overflow the differences above.
void check_windows(const Box2i& data, const Box2i& display, const std::string& where) {
    constexpr int farthest = 1 << 24;
    for (const int edge : {data.min.x, data.min.y, data.max.x, data.max.y, display.min.x, display.min.y,
                           display.max.x, display.max.y}) {
        if (edge < -farthest || edge > farthest) throw input_error("the windows are far away", where);
    }
}

}  // namespace

namespace detail {

scene::Environment read_exr_environment(const std::filesystem::path& file, Diagnostics& diagnostics) {
    scene::Environment out;
    const std::string where = file.string();
    read_first_part(file, [&](const Imf::Header& header, Imf::InputPart& part) {
        const Box2i data = header.dataWindow(), display = header.displayWindow();
        check_windows(data, display, where);
        out.luminance_nit = read_colors(header, part, where);
        if (data != display) {
            diagnostics.warn(where + ": its data window is not its display window; what is missing is black");
            out.luminance_nit = display_of(out.luminance_nit, data, display);
        }
        out.width = static_cast<std::uint32_t>(size_of(display).width);
        out.height = static_cast<std::uint32_t>(size_of(display).height);
        if (Imf::hasChromaticities(header) && !is_rec709(Imf::chromaticities(header)))
            diagnostics.warn(where + ": its primaries are not Rec.709's; they are read as if they were");
        if (Imf::hasWhiteLuminance(header)) {
            const float white_nit = Imf::whiteLuminance(header);
            if (!(white_nit > 0.0f) || !std::isfinite(white_nit))
                throw input_error("whiteLuminance is not positive", where);
            for (glm::vec3& texel : out.luminance_nit) texel *= white_nit;
        }
    });
    return out;
}

}  // namespace detail

FloatImage read_exr(const std::filesystem::path& file) {
    FloatImage out;
    read_first_part(file, [&](const Imf::Header& header, Imf::InputPart& part) {
        const Box2i window = header.dataWindow();
        const Size size = size_of(window);
        out.width = static_cast<std::uint32_t>(size.width);
        out.height = static_cast<std::uint32_t>(size.height);
        Imf::FrameBuffer frame;
        const Imf::ChannelList& channels = header.channels();
        for (auto c = channels.begin(); c != channels.end(); ++c) {
            out.channels.emplace_back(c.name());
            out.data.emplace_back(size.width * size.height);
            frame.insert(c.name(), slice_of(out.data.back().data(), window, size.width, 1));
        }
        part.setFrameBuffer(frame);
        part.readPixels(window.min.y, window.max.y);
    });
    return out;
}

}  // namespace candela::io
