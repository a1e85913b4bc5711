#pragma once

#include <deque>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>

#include "candela/io/gltf_document.hpp"

namespace candela::io {

/// An accessor's numbers as floats (normalized integers decoded), `components` a row.
struct AccessorData {
    std::size_t count = 0;
    std::size_t components = 0;
    bool integers = false;  ///< stored as integers that are not normalized
    std::vector<float> values;

    [[nodiscard]] const float* row(std::size_t i) const { return values.data() + i * components; }
};

/// Reads any accessor: all component types, strided, sparse, without a buffer view. Throws Error when it
/// leaves its buffer or claims more than glTF data of this size can hold.
[[nodiscard]] AccessorData read_accessor(const GltfDocument& document, std::uint32_t index);

/// The same as whole numbers (indices, joints). Throws Error when the accessor holds floats.
[[nodiscard]] std::vector<std::uint32_t> read_indices(const GltfDocument& document, std::uint32_t index);

/// Decoded accessors, so that what many primitives share is decoded (and charged) once. Holds the latest ones
/// up to a bound; of what was dropped a later read decodes again.
class AccessorCache {
  public:
    explicit AccessorCache(const GltfDocument& document) : document_(&document) {}
    /// As read_accessor.
    [[nodiscard]] std::shared_ptr<const AccessorData> read(std::uint32_t index);

  private:
    struct Entry {
        std::uint32_t index = 0;
        std::shared_ptr<const AccessorData> data;
    };
    const GltfDocument* document_;
    std::deque<Entry> entries_;  ///< the latest in front
    std::size_t bytes_ = 0;
};

/// Which rows of an accessor are wanted; empty: all.
using AccessorRows = std::span<const std::uint32_t>;

[[nodiscard]] std::vector<glm::vec2> as_vec2(const AccessorData& data, const std::string& where,
                                             AccessorRows rows = {});
[[nodiscard]] std::vector<glm::vec3> as_vec3(const AccessorData& data, const std::string& where,
                                             AccessorRows rows = {});
/// Vectors of three get `w`.
[[nodiscard]] std::vector<glm::vec4> as_vec4(const AccessorData& data, const std::string& where, float w,
                                             AccessorRows rows = {});
[[nodiscard]] std::vector<glm::mat4> as_mat4(const AccessorData& data, const std::string& where);

}  // namespace candela::io
