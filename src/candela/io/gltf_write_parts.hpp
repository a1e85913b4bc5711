#pragma once

#include <map>

#include "candela/io/gltf_file.hpp"
#include "candela/scene/diagnostics.hpp"
#include "candela/scene/scene.hpp"

/// The parts of write_gltf.
namespace candela::io {

/// Textures and images that something uses, by index of the scene to index of the file.
class GltfTextureWriter {
  public:
    GltfTextureWriter(const scene::Scene& scene, GltfFile& file) : scene_(scene), file_(file) {}

    /// glTF's textureInfo; null where there is no texture or no picture.
    [[nodiscard]] nlohmann::json info(const scene::TextureRef& ref);

  private:
    std::size_t texture(std::uint32_t index);
    std::size_t image(std::uint32_t index);

    const scene::Scene& scene_;
    GltfFile& file_;
    std::map<std::uint32_t, std::size_t> textures_;
    std::map<std::uint32_t, std::size_t> images_;
};

/// The inverse of read_material.
[[nodiscard]] nlohmann::json material_to_gltf(const scene::Material& material, GltfTextureWriter& textures,
                                              GltfFile& file);

/// A node with its matrix, where that is not the identity.
[[nodiscard]] nlohmann::json node_json(const std::string& name, const glm::dmat4& world);

/// Adds all lights, each with its node.
void write_lights(const scene::Scene& scene, GltfFile& file, Diagnostics& diagnostics);

/// The least power of two that is not below x, and at least 1: dividing by it rounds nothing.
[[nodiscard]] float covering_power_of_two(float x);

}  // namespace candela::io
