#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "candela/io/environment_write.hpp"
#include "candela/io/staging_folder.hpp"

/// One function a preset: each writes its files and says in `metadata` what is special about them.
namespace candela::io::detail {

void write_candela(StagingFolder& files, const scene::FilteredEnvironment& environment, CubeFormat format,
                   nlohmann::json& metadata);
void write_filament(StagingFolder& files, const scene::FilteredEnvironment& environment,
                    nlohmann::json& metadata);
void write_threejs(StagingFolder& files, const scene::FilteredEnvironment& environment,
                   const scene::Environment* source, nlohmann::json& metadata);
void write_gltf_light(StagingFolder& files, const scene::FilteredEnvironment& environment,
                      nlohmann::json& metadata);

/// "linear", "frostbite", "filament"
[[nodiscard]] const char* name_of(scene::RoughnessMapping mapping);

void write_text(const std::filesystem::path& file, const std::string& text);
void write_harmonics(StagingFolder& files, const scene::FilteredEnvironment& environment);

}  // namespace candela::io::detail
