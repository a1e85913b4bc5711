#include "candela/realtime/probe_capture.hpp"

#include <algorithm>

#include "shading/spherical_harmonics.glsl"

namespace candela::realtime {
namespace {

/// Before the first pass a probe answers for all directions and has seen nothing: no sky shines into rooms.
std::array<glm::vec4, 9> unlit_surroundings() {
    std::array<glm::vec4, 9> sh{};
    sh[0].w = 1.0f / shading::sh_basis(0, glm::vec3(0.0f, 0.0f, 1.0f));
    return sh;
}

bake::ProbeFaces take_faces(Renderer& renderer, const scene::ReflectionProbe& probe, std::uint32_t texels) {
    bake::ProbeFaces out;
    out.size = texels;
    for (std::size_t face = 0; face < out.faces.size(); ++face)
        out.faces[face] = renderer.capture_view(bake::probe_camera(face, probe.capture_position()));
    return out;
}

}  // namespace

std::vector<bake::ProbeFaces> capture_probe_faces(const gpu::Device& device, const scene::Scene& scene,
                                                  const ProbeCaptureOptions& options) {
    RendererOptions o;
    o.width = o.height = options.face_texels;
    o.profile = options.profile;
    o.shadows = options.shadows;
    o.capture = true;
    Renderer renderer(device, scene, o);
    std::vector<scene::ReflectionProbe> probes = scene.reflection_probes;
    for (scene::ReflectionProbe& probe : probes) probe.capture.irradiance_sh = unlit_surroundings();
    std::vector<bake::ProbeFaces> faces(probes.size());
    const std::uint32_t passes = std::max(1u, options.passes);
    for (std::uint32_t pass = 0; pass < passes; ++pass) {
        renderer.set_reflection_probes(probes);
        for (std::size_t i = 0; i < probes.size(); ++i) {
            faces[i] = take_faces(renderer, probes[i], options.face_texels);
            if (options.progress)
                options.progress(double(pass * probes.size() + i + 1) / double(passes * probes.size()));
        }
        for (std::size_t i = 0; i < probes.size(); ++i)
            probes[i].capture.irradiance_sh = bake::probe_irradiance_sh(faces[i]);
    }
    return faces;
}

std::vector<scene::ReflectionProbe> capture_reflection_probes(const gpu::Device& device,
                                                              const scene::Scene& scene,
                                                              const ProbeCaptureOptions& options) {
    std::vector<scene::ReflectionProbe> out = scene.reflection_probes;
    if (out.empty()) return out;
    const std::vector<bake::ProbeFaces> faces = capture_probe_faces(device, scene, options);
    gpu::Commands commands(device);
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i].capture = bake::filter_probe(device, commands, faces[i]);
    return out;
}

}  // namespace candela::realtime
