#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "candela/scene/probe.hpp"

/// What probes hold, as files of half floats. A key says what for: a file of another one is no file.
namespace candela::io {

/// Probes of irradiance volumes, in the order of the volumes. Little-endian: "CIRV", version, key, number of
/// volumes; of each the cells, the cd/m^2 of a unit, and the probes.
[[nodiscard]] std::string encode_irradiance(const std::vector<scene::IrradianceVolume>& volumes,
                                            std::uint64_t key);
/// Puts the probes into volumes of the same cells. False, and nothing is changed, for anything but a whole
/// file of this key.
[[nodiscard]] bool decode_irradiance(const std::string& bytes, std::uint64_t key,
                                     std::vector<scene::IrradianceVolume>& volumes);

/// Captures of reflection probes: "CPRB", version, key, number of probes; of each the size, the levels and
/// the harmonics.
[[nodiscard]] std::string encode_captures(const std::vector<scene::ReflectionProbe>& probes,
                                          std::uint64_t key);
[[nodiscard]] bool decode_captures(const std::string& bytes, std::uint64_t key,
                                   std::vector<scene::ReflectionProbe>& probes);

}  // namespace candela::io
