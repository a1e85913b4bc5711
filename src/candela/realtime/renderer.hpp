#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "candela/gpu/commands.hpp"
#include "candela/realtime/integrate_pass.hpp"
#include "candela/realtime/profile.hpp"
#include "candela/realtime/still.hpp"
#include "candela/scene/progress.hpp"
#include "candela/scene/scene.hpp"

namespace candela::realtime {

struct ShadowOptions {
    bool maps = true;                   ///< lights that cast shadows have shadow maps; not when integrating
    std::uint32_t atlas_texels = 4096;  ///< most that the atlas may have a side, 4 bytes each
};

struct RendererOptions {
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::uint32_t samples = 4;  ///< a pixel, in stills
    std::uint32_t seed = 0;
    Profile profile;
    std::uint32_t tone_curve = 3;  ///< of shading/tone_curves.glsl; interactive frames only
    bool aovs = false;
    /// The light buffer is of half floats, as render_frame() is for (Frostbite 5.2). What is far above the
    /// picture's white is clamped then. Not when integrating or capturing.
    bool half_light = false;
    bool cull_lights = true;  ///< false: every point asks every light; for tests
    ShadowOptions shadows;
    bool capture = false;  ///< pictures are those that reflection probes take: capture_view()
    /// Finds the integrals that the profile's techniques approximate, one sample of them in each of
    /// `samples`: the mode `integrate`.
    std::optional<IntegrateOptions> integrate;
    ProgressFunction progress;  ///< of render_still(): after each sample
};

/// Draws one scene with one set of options. The device must outlive it; one thread at a time.
class Renderer {
  public:
    /// Uploads the scene, bakes the environment's maps and compiles the pipelines.
    Renderer(const gpu::Device& device, const scene::Scene& scene, const RendererOptions& options);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// A supersampled still. Meters first when the exposure is automatic.
    [[nodiscard]] Still render_still(const scene::Camera& camera, const scene::Exposure& exposure);

    /// One interactive frame at one sample a pixel, as a viewer would show it: lit, metered, tone mapped.
    /// Returns the times of its passes. The exposure follows the frame before.
    std::vector<gpu::PassTime> render_frame(const scene::Camera& camera, const scene::Exposure& exposure);

    /// The graph of the frames that render_frame() draws, as a picture with these times of its passes: SVG,
    /// or the language of Graphviz. After the first frame.
    enum class GraphPicture : std::uint8_t { svg, dot };
    [[nodiscard]] std::string frame_graph(GraphPicture picture, std::span<const gpu::PassTime> times) const;

    /// What a probe sees through a camera, with options.capture: diffuse light of surfaces in cd/m^2, without
    /// lights and sky. a: 1 where there is something. Row 0 on top.
    [[nodiscard]] std::vector<glm::vec4> capture_view(const scene::Camera& camera);

    /// Shows these instead of the scene's reflection probes, of which there must have been some.
    void set_reflection_probes(std::span<const scene::ReflectionProbe> probes);

    /// Lights that cast shadows but found no room in the atlas of the last picture.
    [[nodiscard]] std::uint32_t unshadowed_lights() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace candela::realtime
