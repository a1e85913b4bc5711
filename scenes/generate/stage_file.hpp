#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace candela::scenes {

/// The exposure section of a stage file.
[[nodiscard]] nlohmann::json manual_exposure(float aperture_f, float shutter_s, float iso,
                                             float compensation_ev = 0.0f);

/// Writes a stage (docs/stage.schema.json) beside its scene.
void write_stage(const std::filesystem::path& file, const nlohmann::json& stage);

}  // namespace candela::scenes
