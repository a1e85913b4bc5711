#include "candela/io/exr_read.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaYca.h>
#include <ImfStandardAttributes.h>
#include <ImfTileDescriptionAttribute.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "candela/io/exr_layers.hpp"
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

int bytes_of(Imf::PixelType type) {
    return type == Imf::HALF ? 2 : 4;
}

/// Everything in the header that decides how much memory reading `read_channels` of its channels takes.
void check_header(const Imf::Header& header, std::size_t read_channels, std::uint64_t file_bytes,
                  const std::string& where) {
    if (header.hasType() && Imf::isDeepData(header.type())) throw input_error("deep EXR is not read", where);
    const Size data = size_of(header.dataWindow()), display = size_of(header.displayWindow());
    detail::check_size(data.width, data.height, where);
    detail::check_size(display.width, display.height, where);
    const std::uint64_t texels = data.width * data.height;
    std::uint64_t bytes = 0, tile_texel_bytes = 0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        const auto sampling = static_cast<std::uint64_t>(std::max(c.channel().xSampling, 1)) *
                              static_cast<std::uint64_t>(std::max(c.channel().ySampling, 1));
        const auto texel = static_cast<std::uint64_t>(bytes_of(c.channel().type));
        bytes += texels / sampling * texel;
        tile_texel_bytes += texel;
    }
    if (texels * read_channels > detail::max_texels)
        throw input_error("the picture is too large: " + std::to_string(texels * read_channels) + " samples",
                          where, "at most 2^28");
    // The flattest picture in the densest coding (DWAB) stays below this.
    detail::check_claim(bytes, file_bytes, std::uint64_t{1} << 16, where);
    if (!header.hasTileDescription()) return;
    const Imf::TileDescription& tile = header.tileDescription();
    if (tile.xSize > detail::max_side_texels || tile.ySize > detail::max_side_texels ||
        std::uint64_t{tile.xSize} * tile.ySize * tile_texel_bytes > (std::uint64_t{1} << 28)) {
        throw input_error("the tiles are too large", where);
    }
}

/// Runs `read(input, size of the file in bytes)`, with OpenEXR's exceptions turned into ours.
template <class Read>
void read_exr_file(const std::filesystem::path& file, Read&& read) {
    const std::string where = file.string();
    const std::uint64_t bytes = detail::check_readable(file);
    try {
        constexpr std::uint64_t bytes_per_texel = 4;  // a guess is enough to choose threads
        Imf::MultiPartInputFile input(where.c_str(), detail::exr_threads(bytes / bytes_per_texel));
        read(input, bytes);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw input_error(std::string("broken EXR picture: ") + error.what(), where);
    }
}

void check_complete(const Imf::InputPart& part, const std::string& where) {
    if (!part.isComplete()) throw input_error("broken EXR picture: the data ends too early", where);
}

/// A float slice whose texel (x, y) of the data window lies at base[((y - top) * row + x - left) * step].
Imf::Slice slice_of(float* base, const Box2i& window, std::size_t row, std::size_t step) {
    const std::size_t x_stride = step * sizeof(float), y_stride = row * x_stride;
    return Imf::Slice::Make(Imf::FLOAT, base, window, x_stride, y_stride);
}

/// Reads all lines into the frame buffer that is set. Tiles are read at once: in bands they would be decoded
/// more than once.
void read_lines(const Imf::Header& header, Imf::InputPart& part, const ProgressFunction& progress) {
    const Box2i window = header.dataWindow();
    // The most lines that any compression keeps together.
    constexpr int band = 256;
    if (!progress || header.hasTileDescription()) return part.readPixels(window.min.y, window.max.y);
    const double lines = double(window.max.y) - double(window.min.y) + 1.0;
    for (int y = window.min.y; y <= window.max.y; y += band) {
        progress((double(y) - double(window.min.y)) / lines);
        part.readPixels(y, std::min(y + band - 1, window.max.y));
    }
}

/// One channel at every texel of the data window; between the samples of a coarser one bilinearly, samples
/// standing at the coordinates that the sampling rate divides (OpenEXR, "Technical Introduction").
std::vector<float> read_plane(const Imf::Header& header, Imf::InputPart& part, const std::string& name) {
    const Imf::Channel& channel = header.channels()[name.c_str()];
    const Box2i window = header.dataWindow();
    const Size size = size_of(window);
    const auto step_x = static_cast<std::size_t>(channel.xSampling);
    const auto step_y = static_cast<std::size_t>(channel.ySampling);
    const std::size_t columns = (size.width + step_x - 1) / step_x;
    const std::size_t rows = (size.height + step_y - 1) / step_y;
    std::vector<float> samples(columns * rows);
    Imf::FrameBuffer frame;
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, samples.data(), window, sizeof(float),
                                        columns * sizeof(float), channel.xSampling, channel.ySampling));
    part.setFrameBuffer(frame);
    part.readPixels(window.min.y, window.max.y);
    if (step_x == 1 && step_y == 1) return samples;
    std::vector<float> out(size.width * size.height);
    for (std::size_t y = 0; y < size.height; ++y) {
        const std::size_t top = y / step_y, below = std::min(top + 1, rows - 1);
        const float v = static_cast<float>(y % step_y) / static_cast<float>(step_y);
        for (std::size_t x = 0; x < size.width; ++x) {
            const std::size_t left = x / step_x, right = std::min(left + 1, columns - 1);
            const float u = static_cast<float>(x % step_x) / static_cast<float>(step_x);
            const auto row = [&](std::size_t r) {
                return samples[r * columns + left] * (1.0f - u) + samples[r * columns + right] * u;
            };
            out[y * size.width + x] = row(top) * (1.0f - v) + row(below) * v;
        }
    }
    return out;
}

/// RY = (R - Y) / Y, BY = (B - Y) / Y, Y = w . RGB: OpenEXR, "Technical Introduction", luminance/chroma
/// images.
void set_luminance_chroma(const Imf::Header& header, const std::array<std::vector<float>, 3>& planes,
                          std::vector<glm::vec3>& texels) {
    const Imath::V3f w = Imf::RgbaYca::computeYw(Imf::hasChromaticities(header) ? Imf::chromaticities(header)
                                                                                : Imf::Chromaticities());
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const float y = planes[0][i];
        const float r = (planes[1][i] + 1.0f) * y, b = (planes[2][i] + 1.0f) * y;
        const glm::vec3 color(r, (y - w.x * r - w.z * b) / w.y, b);
        // What chroma between its samples takes below zero is not in the picture.
        texels[i] = y >= 0.0f ? glm::max(color, glm::vec3(0.0f)) : color;
    }
}

bool is_subsampled(const Imf::Header& header, const std::vector<std::string>& names) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        const Imf::Channel& c = header.channels()[name.c_str()];
        return c.xSampling != 1 || c.ySampling != 1;
    });
}

std::vector<glm::vec3> read_colors(const Imf::Header& header, Imf::InputPart& part,
                                   const detail::ExrPicture& picture, const ProgressFunction& progress) {
    const Box2i window = header.dataWindow();
    const Size size = size_of(window);
    std::vector<glm::vec3> texels(size.width * size.height);
    const std::vector<std::string>& names = picture.channels;
    const bool chroma = picture.colors == detail::ExrColors::luminance_chroma;
    if (chroma || is_subsampled(header, names)) {
        std::array<std::vector<float>, 3> planes;
        for (std::size_t c = 0; c < names.size(); ++c) planes[c] = read_plane(header, part, names[c]);
        if (chroma) {
            set_luminance_chroma(header, planes, texels);
            return texels;
        }
        for (std::size_t i = 0; i < texels.size(); ++i) {
            for (std::size_t c = 0; c < names.size(); ++c) texels[i][static_cast<int>(c)] = planes[c][i];
        }
    } else {
        Imf::FrameBuffer frame;
        for (std::size_t c = 0; c < names.size(); ++c)
            frame.insert(names[c], slice_of(&texels[0].x + c, window, size.width, 3));
        part.setFrameBuffer(frame);
        read_lines(header, part, progress);
    }
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

ReadEnvironment read_exr_environment(const std::filesystem::path& file, Diagnostics& diagnostics,
                                     const std::string& layer,
                                     const std::optional<scene::MemoryBudget>& memory,
                                     const ProgressFunction& progress) {
    ReadEnvironment out;
    const std::string where = file.string();
    read_exr_file(file, [&](Imf::MultiPartInputFile& input, std::uint64_t bytes) {
        const ExrPicture picture = choose_exr_picture(input, layer, where, diagnostics);
        const Imf::Header& header = input.header(picture.part);
        check_header(header, picture.channels.size(), bytes, where);
        Imf::InputPart part(input, picture.part);
        check_complete(part, where);
        const Box2i data = header.dataWindow(), display = header.displayWindow();
        check_windows(data, display, where);
        for (const Size& size : {size_of(data), size_of(display)})
            check_memory(size.width, size.height, memory, where);
        out.luminance_nit = read_colors(header, part, picture, progress);
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
            out.absolute = true;
            for (glm::vec3& texel : out.luminance_nit) texel *= white_nit;
        }
    });
    return out;
}

}  // namespace detail

FloatImage read_exr(const std::filesystem::path& file) {
    FloatImage out;
    read_exr_file(file, [&](Imf::MultiPartInputFile& input, std::uint64_t bytes) {
        const Imf::Header& header = input.header(0);
        std::vector<std::string> names;
        for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
            names.emplace_back(c.name());
        check_header(header, names.size(), bytes, file.string());
        if (is_subsampled(header, names)) throw input_error("its channels differ in size", file.string());
        Imf::InputPart part(input, 0);
        check_complete(part, file.string());
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
