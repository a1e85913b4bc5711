#pragma once

#include <filesystem>
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

/// Throws Error (Fault::usage) for an extension or AOV that does not exist, before anything is rendered.
void check_outputs(const PictureFileOptions& options);

struct PictureInfo {
    std::string device;
    std::uint32_t samples = 1;
    std::uint32_t seed = 0;
    std::string mode = "realtime";
};

/// Writes every output. PNG is display-referred (exposure, tone curve, sRGB); EXR is luminance in cd/m^2.
void write_pictures(const PictureFileOptions& options, const Job& job, const realtime::Still& still,
                    const PictureInfo& info);

}  // namespace candela::app
