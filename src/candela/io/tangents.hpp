#pragma once

#include "candela/scene/scene.hpp"

namespace candela::io {

/// One normal a triangle, as glTF wants where normals are absent: vertices are split.
void add_flat_normals(scene::Primitive& primitive);

/// Tangents in the manner of MikkTSpace (Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", section
/// 4): per corner, weighted by angle, averaged over corners that share position, normal and uv and whose
/// triangles meet along edges with the same orientation in uv; vertices are split where corners disagree.
void add_tangents(scene::Primitive& primitive, std::size_t uv_set);

}  // namespace candela::io
