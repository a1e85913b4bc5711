#include "demo_scenes.hpp"

namespace candela::scenes {

const std::vector<Demo>& demos() {
    static const std::vector<Demo> all = {
        {"sphere_grid", "roughness 0.1 to 0.9, plastic and gold, under soft boxes", write_sphere_grid},
        {"grey_card", "Sunny 16: an 18 % card in 100,000 lx of sun", write_grey_card},
        {"grey_plane", "a 50 % Lambertian plane under 10,000 lx", write_grey_plane},
        {"still_life", "fifteen thousand triangles of materials on a table, lit like a room",
         write_still_life},
        {"lamps", "lamps of known candela over a floor, for meters", write_lamps},
        {"cornell_room", "a room of 5.5 m with one luminous panel", write_room},
        {"light_shelf", "a light of every type, each in a cell of its own, in the unit it is sold in",
         write_light_shelf},
        {"two_rooms", "a bright and a dim room with one polished floor, lit and mirrored by probes",
         write_two_rooms},
    };
    return all;
}

}  // namespace candela::scenes
