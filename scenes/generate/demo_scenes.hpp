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
void write_two_rooms(const std::filesystem::path& folder);

/// No demo: `count` lamps over a ground of 20 x 20 m, into many_lights_COUNT. range_m 0: such that about
/// eight of them reach each point; else the name ends in _ranged.
void write_many_lights(const std::filesystem::path& folder, int count, float range_m);

}  // namespace candela::scenes
