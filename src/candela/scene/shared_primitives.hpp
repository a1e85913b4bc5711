#pragma once

#include <cstddef>
#include <set>

#include "candela/scene/scene.hpp"

namespace candela::scene {

/// Triangles that instances may add to what is stored, before structures for rays keep one tree a primitive
/// instead of copies in one tree: a ray is quicker through one tree without transforms.
inline constexpr std::size_t kMaxCopiedTriangles = std::size_t{1} << 17;

/// Primitives that several instances show and that are to be stored once. Empty while all copies together are
/// at most `max_copied_triangles`. Never of an instance whose transform has no inverse.
[[nodiscard]] std::set<const Primitive*> shared_primitives(const Scene& scene,
                                                           std::size_t max_copied_triangles);

/// Triangles that are stored when those are: the others' once an instance.
[[nodiscard]] std::size_t stored_triangles(const Scene& scene, const std::set<const Primitive*>& shared);

}  // namespace candela::scene
