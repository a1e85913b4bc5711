#pragma once

#include <cstdint>
#include <string>

namespace candela::app {

/// Writes the table of directional albedos as EXR, with its metadata beside it.
int bake_dfg_table(const std::string& output, const std::string& visibility, std::uint32_t size, bool json);

}  // namespace candela::app
