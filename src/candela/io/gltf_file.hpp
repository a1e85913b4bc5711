#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace candela::io {

/// A glTF file in the making: its JSON, free to be filled by hand, and the one buffer.
class GltfFile {
  public:
    explicit GltfFile(const std::string& generator);

    nlohmann::json document;

    /// Adds to a list of the document ("nodes"); returns the index.
    std::size_t push(const char* list, nlohmann::json element);
    /// Names an extension in extensionsUsed, once.
    void declare(const std::string& extension);
    /// Adds a node to the scene's roots; returns its index.
    std::size_t add_root(nlohmann::json node);

    /// Bytes of the buffer, aligned for every component type. `target`: of the specification, 0 for none.
    std::size_t add_view(std::span<const std::byte> bytes, int target = 0);
    std::size_t add_vertices(std::span<const float> numbers, std::size_t columns);
    /// POSITION: with the bounds that the specification asks for.
    std::size_t add_positions(std::span<const glm::vec3> positions);
    std::size_t add_indices(std::span<const std::uint32_t> indices);

    /// Writes .glb, or for any other name .gltf with its buffer in a .bin beside it; under temporary names
    /// that are renamed, the .bin first. Throws Error when the folder is missing or the disk is full.
    void save(const std::filesystem::path& file) const;

  private:
    std::vector<std::byte> binary_;
};

[[nodiscard]] nlohmann::json to_json(const glm::vec3& v);
[[nodiscard]] nlohmann::json to_json(const glm::mat4& m);
/// The shortest numbers that are exact in single precision where the double is.
[[nodiscard]] nlohmann::json to_json(const glm::dmat4& m);

}  // namespace candela::io
