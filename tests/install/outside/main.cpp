// Uses the library as another engine would: the scene types, the renderer and the shading sources.
#include <candela/bake/environment.hpp>
#include <candela/realtime/renderer.hpp>
#include <candela/version.hpp>
#include <cmath>
#include <cstdio>
#include <shading/exposure.glsl>
#include <shading/microfacet.glsl>

int main() {
    candela::scene::Scene scene;
    scene.environment = candela::bake::constant_environment(500.0f);
    const candela::gpu::Device device{{}};
    candela::realtime::RendererOptions options;
    options.width = options.height = 16;
    candela::realtime::Renderer renderer(device, scene, options);
    const auto still = renderer.render_still(candela::scene::look_at({0, 0, 1}, {0, 0, 0}, 0.7f), {});
    const float luminance_nit = still.planes.light_nit[0].x;
    std::printf("candela %s: %g cd/m2, EV100 %g, D(1, 0.5) = %g\n", candela::version(), luminance_nit,
                still.ev100, candela::shading::D_GGX(1.0f, 0.5f));
    return std::abs(luminance_nit - 500.0f) < 1.0f ? 0 : 1;
}
