#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "candela/io/exr_threads.hpp"
#include "candela/io/image_write.hpp"
#include "candela/io/image_write_safe.hpp"
#include "candela/scene/error.hpp"
#include "candela/scene/half_range.hpp"

namespace candela::io {
namespace {

/// OpenEXR writes through this; its own stream would swallow what fails when the file is closed.
class Stream : public Imf::OStream {
  public:
    Stream(detail::SafeFile& file, const std::string& name) : OStream(name.c_str()), file_(file) {}
    void write(const char bytes[], int count) override {
        if (!file_.write(bytes, static_cast<std::size_t>(count))) file_.check();
    }
    std::uint64_t tellp() override { return file_.position(); }
    void seekp(std::uint64_t position) override {
        if (!file_.seek(position)) file_.check();
    }

  private:
    detail::SafeFile& file_;
};

bool fits_half(std::span<const float> values) {
    return std::none_of(values.begin(), values.end(),
                        [](float v) { return std::isfinite(v) && std::abs(v) > scene::kLargestHalf; });
}

/// A channel as OpenEXR wants it: in memory already of the type that goes into the file.
struct Plane {
    std::string name;
    Imf::PixelType type = Imf::FLOAT;
    const char* pixels = nullptr;
    std::vector<Imath::half> halves;
};

Plane plane_of(const ExrChannel& channel, std::size_t texels) {
    const bool words = std::holds_alternative<std::span<const std::uint32_t>>(channel.pixels);
    const std::size_t count = std::visit([](const auto& p) { return p.size(); }, channel.pixels);
    if (count != texels || words != (channel.type == PixelType::uint32))
        throw std::invalid_argument("write_exr: channel " + channel.name + " has other pixels than it says");
    Plane plane;
    plane.name = channel.name;
    if (words) {
        plane.type = Imf::UINT;
        plane.pixels =
            reinterpret_cast<const char*>(std::get<std::span<const std::uint32_t>>(channel.pixels).data());
        return plane;
    }
    const auto values = std::get<std::span<const float>>(channel.pixels);
    if (channel.type == PixelType::half && fits_half(values)) {
        plane.type = Imf::HALF;
        plane.halves.assign(values.begin(), values.end());
        plane.pixels = reinterpret_cast<const char*>(plane.halves.data());
    } else {
        plane.pixels = reinterpret_cast<const char*>(values.data());
    }
    return plane;
}

void add_attributes(Imf::Header& header, const std::map<std::string, ExrAttribute>& attributes) {
    static const std::set<std::string> structural{
        "channels",         "compression",        "dataWindow",        "displayWindow", "lineOrder",
        "pixelAspectRatio", "screenWindowCenter", "screenWindowWidth", "chromaticities"};
    for (const auto& [name, value] : attributes) {
        if (name.empty() || structural.contains(name))
            throw std::invalid_argument("write_exr: attribute " + name + " is not the caller's to set");
        if (const float* number = std::get_if<float>(&value)) {
            header.insert(name, Imf::FloatAttribute(*number));
        } else {
            header.insert(name, Imf::StringAttribute(std::get<std::string>(value)));
        }
    }
}

}  // namespace

void write_exr(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
               const std::vector<ExrChannel>& channels,
               const std::map<std::string, ExrAttribute>& attributes) {
    if (width == 0 || height == 0 || channels.empty()) throw std::invalid_argument("write_exr: no pixels");
    const std::size_t texels = std::size_t{width} * height;
    std::vector<Plane> planes;
    for (const ExrChannel& channel : channels) planes.push_back(plane_of(channel, texels));

    Imf::Header header(static_cast<int>(width), static_cast<int>(height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities());  // Rec.709, D65
    add_attributes(header, attributes);
    Imf::FrameBuffer frame;
    for (const Plane& plane : planes) {
        if (header.channels().findChannel(plane.name) != nullptr)
            throw std::invalid_argument("write_exr: two channels named " + plane.name);
        const std::size_t bytes = plane.type == Imf::HALF ? 2 : 4;
        header.channels().insert(plane.name, Imf::Channel(plane.type));
        // A frame buffer for writing is only read; its type has no const.
        frame.insert(plane.name,
                     Imf::Slice(plane.type, const_cast<char*>(plane.pixels), bytes, bytes * width));
    }

    detail::SafeFile out(file);
    try {
        Stream stream(out, file.string());
        Imf::OutputFile output(stream, header, detail::exr_threads(texels));
        output.setFrameBuffer(frame);
        output.writePixels(static_cast<int>(height));
    } catch (const std::exception& error) {
        out.check();
        throw machine_error(std::string("cannot be written: ") + error.what(), file.string());
    }
    out.commit();
}

}  // namespace candela::io
