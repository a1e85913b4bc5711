#pragma once

#include "candela/io/gltf_document.hpp"

namespace candela::io {

/// Warns of extensions that are not supported. Throws Error when the scene requires one without which its
/// geometry cannot be drawn, or that is not known.
void check_extensions(const GltfDocument& document, Diagnostics& diagnostics);

}  // namespace candela::io
