#pragma once

#include "candela/io/gltf_pose.hpp"

namespace candela::io {

/// The camera of a node; nullopt, with a warning, for one whose type is unknown. Numbers that no lens has are
/// replaced, with a warning.
[[nodiscard]] std::optional<scene::Camera> read_camera(const JsonView& source, const Node& node);

}  // namespace candela::io
