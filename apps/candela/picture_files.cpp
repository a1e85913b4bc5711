#include "picture_files.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>

#include "candela/io/image_write.hpp"
#include "candela/io/output_folder.hpp"
#include "candela/scene/error.hpp"
#include "candela/version.hpp"
#include "option_rules.hpp"
#include "shading/transfer.glsl"

namespace candela::app {
namespace {

using realtime::Aov;

/// One AOV of the command line: the planes it is made of and the names of its channels in the file, as
/// Mitsuba's aov integrator and pbrt's GBufferFilm users know them.
struct AovLayer {
    std::string name;
    Aov aov;
    std::vector<std::string> channels;
    io::PixelType type;
};

std::vector<AovLayer> color_layers() {
    const auto rgb = [](const std::string& layer) {
        return std::vector<std::string>{layer + ".R", layer + ".G", layer + ".B"};
    };
    return {{"albedo", Aov::albedo, rgb("albedo"), io::PixelType::half},
            {"normal", Aov::normal, {"sh_normal.X", "sh_normal.Y", "sh_normal.Z"}, io::PixelType::half},
            {"depth", Aov::distance, {"depth.Z"}, io::PixelType::float32},
            {"direct_diffuse", Aov::direct_diffuse, rgb("direct_diffuse"), io::PixelType::half},
            {"direct_specular", Aov::direct_specular, rgb("direct_specular"), io::PixelType::half},
            {"indirect_diffuse", Aov::indirect_diffuse, rgb("indirect_diffuse"), io::PixelType::half},
            {"indirect_specular", Aov::indirect_specular, rgb("indirect_specular"), io::PixelType::half},
            {"emissive", Aov::emissive, rgb("emissive"), io::PixelType::half}};
}

/// Owns the planes that the EXR writer looks at.
class Channels {
  public:
    void add(const std::string& name, io::PixelType type, const std::vector<glm::vec4>& texels, int component,
             float factor = 1.0f) {
        std::vector<float>& plane = floats_.emplace_back(texels.size());
        std::transform(texels.begin(), texels.end(), plane.begin(),
                       [&](const glm::vec4& t) { return t[component] * factor; });
        channels_.push_back({name, type, std::span<const float>(plane)});
    }
    void add(const ExtraLayer& layer) {
        channels_.push_back({layer.channel, io::PixelType::float32, std::span<const float>(layer.plane)});
    }
    void add(const std::string& name, const std::vector<glm::uvec2>& texels, int component) {
        std::vector<std::uint32_t>& plane = words_.emplace_back(texels.size());
        std::transform(texels.begin(), texels.end(), plane.begin(),
                       [&](const glm::uvec2& t) { return t[component]; });
        channels_.push_back({name, io::PixelType::uint32, std::span<const std::uint32_t>(plane)});
    }
    [[nodiscard]] const std::vector<io::ExrChannel>& list() const { return channels_; }

  private:
    std::deque<std::vector<float>> floats_;
    std::deque<std::vector<std::uint32_t>> words_;
    std::vector<io::ExrChannel> channels_;
};

bool wants(const PictureFileOptions& options, const std::string& aov) {
    return std::any_of(options.aovs.begin(), options.aovs.end(),
                       [&](const std::string& a) { return a == aov || a == "all"; });
}

std::map<std::string, io::ExrAttribute> exr_attributes(const Job& job, const realtime::Still& still,
                                                       const PictureInfo& info) {
    std::map<std::string, io::ExrAttribute> a{
        {"whiteLuminance", 1.0f},
        {"candela/version", std::string(version())},
        {"candela/mode", info.mode},
        {"candela/profile", job.profile.name},
        {"candela/techniques", realtime::describe(job.profile)},
        {"candela/device", info.device},
        {"candela/ev100", still.ev100},
        {"candela/exposure", still.exposure},
        {"candela/samples", std::to_string(info.samples)},
        {"candela/units", std::string(job.emission.relative ? "relative" : "absolute")},
        {"candela/nit_per_emission", job.emission.nit_per_unit},
        {"candela/seed", std::to_string(info.seed)},
        {"candela/camera", job.camera.name}};
    for (const auto& [name, value] : info.settings) a["candela/" + name] = value;
    if (job.exposure.aperture_f) a["aperture"] = *job.exposure.aperture_f;
    if (job.exposure.shutter_s) a["expTime"] = *job.exposure.shutter_s;
    if (job.exposure.iso) a["isoSpeed"] = *job.exposure.iso;
    return a;
}

void write_exr(const std::string& file, const PictureFileOptions& options, const Job& job,
               const realtime::Still& still, const PictureInfo& info) {
    const io::PixelType type = options.exr_type == "float" ? io::PixelType::float32 : io::PixelType::half;
    Channels channels;
    const char* rgb[] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) channels.add(rgb[c], type, still.planes.light_nit, c);
    for (const AovLayer& layer : color_layers()) {
        if (!wants(options, layer.name)) continue;
        const auto& plane = still.planes.aovs[static_cast<std::size_t>(layer.aov)];
        const auto unit_m = static_cast<float>(job.scene.frame.unit_m);
        const float factor = layer.aov == Aov::distance ? unit_m : 1.0f;
        for (int c = 0; c < static_cast<int>(layer.channels.size()); ++c) {
            channels.add(layer.channels[static_cast<std::size_t>(c)], layer.type, plane, c, factor);
        }
    }
    if (wants(options, "object_id")) channels.add("shape_index.I", still.planes.ids, 0);
    if (wants(options, "material_id")) channels.add("material_index.I", still.planes.ids, 1);
    for (const ExtraLayer& layer : info.layers) {
        if (wants(options, layer.aov)) channels.add(layer);
    }
    io::write_exr(file, still.width, still.height, channels.list(), exr_attributes(job, still, info));
}

template <class Word>
std::vector<Word> encode(const Job& job, const realtime::Still& still) {
    constexpr float top = static_cast<float>(std::numeric_limits<Word>::max());
    std::vector<Word> words(still.planes.light_nit.size() * 3);
    std::size_t out = 0;
    for (const glm::vec3& linear : realtime::display_linear(still, job.tone_curve)) {
        const glm::vec3 display = shading::srgb_from_linear(linear);
        for (int c = 0; c < 3; ++c) {
            words[out++] = static_cast<Word>(std::clamp(display[c], 0.0f, 1.0f) * top + 0.5f);
        }
    }
    return words;
}

void write_png(const std::string& file, const PictureFileOptions& options, const Job& job,
               const realtime::Still& still) {
    const std::map<std::string, std::string> text{{"Software", std::string("candela ") + version()}};
    if (options.png_bits == 16) {
        io::write_png(file, still.width, still.height,
                      std::span<const std::uint16_t>(encode<std::uint16_t>(job, still)), text);
    } else {
        io::write_png(file, still.width, still.height,
                      std::span<const std::uint8_t>(encode<std::uint8_t>(job, still)), text);
    }
}

std::string extension(const std::string& file) {
    std::string e = std::filesystem::path(file).extension().string();
    std::transform(e.begin(), e.end(), e.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return e;
}

}  // namespace

std::vector<std::string> aov_names() {
    std::vector<std::string> names;
    for (const AovLayer& layer : color_layers()) names.push_back(layer.name);
    names.emplace_back("object_id");
    names.emplace_back("material_id");
    names.emplace_back("sample_count");
    names.emplace_back("variance");
    names.emplace_back("all");
    return names;
}

void check_outputs(const PictureFileOptions& options) {
    for (const std::string& file : options.outputs) {
        const std::string e = extension(file);
        if (e != ".png" && e != ".exr")
            throw Error(Fault::usage, "unknown kind of picture", file, ".png or .exr");
        io::check_output_file(file);
    }
    refuse_same_output(options.outputs);
    const auto known = aov_names();
    for (const std::string& aov : options.aovs) {
        if (std::find(known.begin(), known.end(), aov) != known.end()) continue;
        std::string list;
        for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
        throw Error(Fault::usage, "no such AOV: " + aov, "--aov", list);
    }
}

void check_picture_file_options(const CLI::App& command, const PictureFileOptions& options) {
    const auto none = [&](const char* kind) {
        return std::none_of(options.outputs.begin(), options.outputs.end(),
                            [&](const std::string& file) { return extension(file) == kind; });
    };
    if (none(".exr"))
        refuse_without_effect(command, {"--aov", "--exr-type"}, "without an EXR file", "-o FILE.exr");
    if (none(".png"))
        refuse_without_effect(command, {"--png-bits", "--tonemap"}, "without a PNG file", "-o FILE.png");
}

void write_pictures(const PictureFileOptions& options, const Job& job, const realtime::Still& still,
                    const PictureInfo& info) {
    for (const std::string& file : options.outputs) {
        if (extension(file) == ".exr") {
            write_exr(file, options, job, still, info);
        } else {
            write_png(file, options, job, still);
        }
    }
}

}  // namespace candela::app
