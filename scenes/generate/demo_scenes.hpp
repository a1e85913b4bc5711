#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace candela::scenes {

/// One demo: writes NAME.glb, NAME.stage.json and what they refer to into `folder`, which exists. Throws
/// Error.
struct Demo {
    std::string name;
    std::string about;
    void (*write)(const std::filesystem::path& folder);
};

[[nodiscard]] const std::vector<Demo>& demos();

void write_sphere_grid(const std::filesystem::path& folder);
void write_grey_card(const std::filesystem::path& folder);
void write_grey_plane(const std::filesystem::path& folder);
void write_still_life(const std::filesystem::path& folder);
void write_lamps(const std::filesystem::path& folder);
void write_room(const std::filesystem::path& folder);
void write_light_shelf(const std::filesystem::path& folder);

}  // namespace candela::scenes
