#include "stage_file.hpp"

#include <span>

#include "candela/io/image_write.hpp"

namespace candela::scenes {

nlohmann::json manual_exposure(float aperture_f, float shutter_s, float iso, float compensation_ev) {
    nlohmann::json exposure = {{"aperture_f", aperture_f}, {"shutter_s", shutter_s}, {"iso", iso}};
    if (compensation_ev != 0.0f) exposure["compensation_ev"] = compensation_ev;
    return exposure;
}

void write_stage(const std::filesystem::path& file, const nlohmann::json& stage) {
    const std::string text = stage.dump(4) + "\n";
    io::write_file(file, std::as_bytes(std::span(text)));
}

}  // namespace candela::scenes
