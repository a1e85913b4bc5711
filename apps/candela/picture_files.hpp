#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "job.hpp"

namespace candela::app {

struct PictureFileOptions {
    std::vector<std::string> outputs;
    int png_bits = 8;
    std::string exr_type = "half";
    std::vector<std::string> aovs;
};

/// Names that --aov knows, in the order of the layers.
[[nodiscard]] std::vector<std::string> aov_names();

/// Throws Error for an extension, an AOV or a folder that does not exist, before anything is rendered.
void check_outputs(const PictureFileOptions& options);

/// Refuses options of a kind of file that is not written. Throws Error (Fault::usage).
void check_picture_file_options(const CLI::App& command, const PictureFileOptions& options);

/// A plane that only some modes have: sample_count and variance of the path tracer.
struct ExtraLayer {
    std::string aov;
    std::string channel;
    std::vector<float> plane;
};

struct PictureInfo {
    std::string mode = "realtime";
    std::string device;
    std::uint32_t samples = 1;
    std::uint32_t seed = 0;
    std::map<std::string, std::string> settings;  ///< further ones, for the header: candela/NAME
    std::vector<ExtraLayer> layers;
};

/// Writes every output. PNG is display-referred (exposure, tone curve, sRGB); EXR is luminance in cd/m^2.
void write_pictures(const PictureFileOptions& options, const Job& job, const realtime::Still& still,
                    const PictureInfo& info);

}  // namespace candela::app
