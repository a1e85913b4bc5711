#pragma once

#include <map>

#include "candela/io/gltf.hpp"
#include "candela/io/gltf_pose.hpp"

namespace candela::io {

/// Reads the lights of nodes: KHR_lights_punctual, EXT_lights_ies and EXT_lights_area.
///
/// A node with a punctual light and a profile has one light: the profile's cd (times `multiplier`) take the
/// place of the punctual intensity, which is there for viewers that do not read profiles, within the punctual
/// light's cones; its colour is the profile's where that states one.
class GltfLights {
  public:
    GltfLights(const GltfDocument& document, const GltfOptions& options, Diagnostics& diagnostics)
        : document_(document), options_(options), diagnostics_(diagnostics) {}

    void add(const JsonView& node, const Node& posed, scene::Scene& scene);

  private:
    void add_punctual(const JsonView& source, const Node& posed, scene::Scene& scene) const;
    void add_area(const JsonView& source, const Node& posed, scene::Scene& scene) const;
    void add_profile(const JsonView& use, const Node& posed, scene::Light* punctual, scene::Scene& scene);
    [[nodiscard]] scene::PhotometricProfile read_profile(const JsonView& source) const;
    /// Of Scene::profiles; nullopt, with a warning, for one that cannot be read.
    std::optional<std::uint32_t> profile(const JsonView& use, scene::Scene& scene);

    const GltfDocument& document_;
    const GltfOptions& options_;
    Diagnostics& diagnostics_;
    std::map<std::uint32_t, std::optional<std::uint32_t>> profiles_;  // of the file to Scene::profiles
};

}  // namespace candela::io
