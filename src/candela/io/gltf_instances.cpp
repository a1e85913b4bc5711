#include "candela/io/gltf_instances.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace candela::io {
namespace {

/// What an instance takes in every later structure.
constexpr std::uint64_t kInstanceBytes = 512;

bool finite(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            if (!std::isfinite(m[c][r])) return false;
        }
    }
    return true;
}

glm::dquat rotation_of(const glm::vec4& xyzw) {
    const glm::dquat q(xyzw.w, xyzw.x, xyzw.y, xyzw.z);
    const double length = glm::length(q);
    return length > 1e-12 ? q / length : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

struct Attributes {
    std::optional<std::vector<glm::vec3>> translation;
    std::optional<std::vector<glm::vec4>> rotation;
    std::optional<std::vector<glm::vec3>> scale;

    [[nodiscard]] glm::dmat4 matrix(std::size_t i) const {
        glm::dmat4 m(1.0);
        if (translation) m = glm::translate(m, glm::dvec3((*translation)[i]));
        if (rotation) m = m * glm::mat4_cast(rotation_of((*rotation)[i]));
        if (scale) m = glm::scale(m, glm::dvec3((*scale)[i]));
        return m;
    }
};

}  // namespace

std::optional<std::vector<glm::dmat4>> read_gpu_instances(const GltfDocument& document, const JsonView& node,
                                                          Diagnostics& diagnostics) {
    const JsonView attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    if (!attributes.exists()) return std::nullopt;
    Attributes read;
    std::optional<std::size_t> count;
    bool differ = false;
    const auto accessor = [&](const char* name) -> std::optional<AccessorData> {
        const auto index = attributes[name].index_below(document.count("accessors"));
        if (!index) return std::nullopt;
        AccessorData data = read_accessor(document, *index);
        differ = differ || (count && *count != data.count);
        count = std::min(count.value_or(data.count), data.count);
        return data;
    };
    const std::string where = attributes.where() + "/";
    if (const auto data = accessor("TRANSLATION")) read.translation = as_vec3(*data, where + "TRANSLATION");
    if (const auto data = accessor("ROTATION")) read.rotation = as_vec4(*data, where + "ROTATION", 1.0f);
    if (const auto data = accessor("SCALE")) read.scale = as_vec3(*data, where + "SCALE");
    if (!count) return std::nullopt;
    if (differ)
        diagnostics.warn(
            "the attributes of EXT_mesh_gpu_instancing differ in length: as many instances as the shortest "
            "has");
    document.charge(*count * kInstanceBytes, attributes);
    std::vector<glm::dmat4> out;
    out.reserve(*count);
    for (std::size_t i = 0; i < *count; ++i) {
        const glm::dmat4 m = read.matrix(i);
        if (finite(m))
            out.push_back(m);
        else
            diagnostics.warn("an instance whose transform is not finite: skipped");
    }
    return out;
}

}  // namespace candela::io
