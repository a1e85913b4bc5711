#pragma once

#include <ImfMultiPartInputFile.h>

#include <cstdint>
#include <string>
#include <vector>

#include "candela/scene/diagnostics.hpp"

/// Which of an EXR file's parts and layers is the picture.
namespace candela::io::detail {

enum class ExrColors : std::uint8_t { rgb, luminance_chroma, grey };

struct ExrPicture {
    int part = 0;
    std::string name;  ///< of part and layer, "ViewLayer.Combined"; empty: the channels have no layer
    ExrColors colors = ExrColors::rgb;
    std::vector<std::string> channels;  ///< full names: R, G, B; Y, RY, BY; or Y
};

/// Every picture of the flat parts, in the file's order. A layer is what stands before the last dot of a
/// channel's name (OpenEXR, "Technical Introduction", channel naming conventions);
/// R, G and B may be lower case or written out.
[[nodiscard]] std::vector<ExrPicture> exr_pictures(const Imf::MultiPartInputFile& input);

/// The picture called `asked`; without a name the one without a layer or with the usual name of a finished
/// picture (Combined, beauty, rgba, ...), else the first, with a warning where another could be meant. Throws
/// Error (Fault::input) that lists what there is.
[[nodiscard]] ExrPicture choose_exr_picture(const Imf::MultiPartInputFile& input, const std::string& asked,
                                            const std::string& where, Diagnostics& diagnostics);

}  // namespace candela::io::detail
