#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "candela/measure/numerics.hpp"
#include "shading/environment.glsl"
#include "shading/probes/composition.glsl"
#include "shading/probes/parallax.glsl"
#include "shading/transfer.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

constexpr int kWidth = 128;
constexpr int kHeight = 96;
constexpr int kProbeWidth = 128;
constexpr int kBounces = 4;
constexpr vec3 kSunColor(2.6f, 2.4f, 2.1f);  // illuminance over pi
const vec3 kToSun = glm::normalize(vec3(0.7f, 1.0f, 0.5f));

/// The proxy: from the floor up, from the wall to the open side.
const vec3 kHalf(2.0f, 1.2f, 2.0f);
const vec3 kMiddle(0.0f, 1.2f, 0.0f);
const vec3 kCapture(0.0f, 0.9f, 0.2f);

struct Hit {
    float distance_m = 0.0f;
    vec3 normal{0.0f};
    vec3 color{0.0f};  // albedo, or f0 of a metal
    bool metal = false;
};

struct Ball {
    vec3 center_m;
    float radius_m;
    vec3 f0;
};
/// Chrome where the probe's light is used, gold for the probe to see.
constexpr Ball kChrome{{-0.2f, 0.5f, 0.3f}, 0.5f, {0.9f, 0.9f, 0.9f}};
constexpr Ball kGold{{0.9f, 0.4f, -0.9f}, 0.4f, {1.0f, 0.77f, 0.34f}};

void meet_ball(const Ball& ball, const vec3& from, const vec3& d, std::optional<Hit>& best) {
    const vec3 to = ball.center_m - from;
    const float along = glm::dot(to, d);
    const float discriminant = ball.radius_m * ball.radius_m - glm::dot(to - along * d, to - along * d);
    if (discriminant <= 0.0f) return;
    const float distance_m = along - std::sqrt(discriminant);
    if (distance_m < 1e-3f || (best && best->distance_m < distance_m)) return;
    best = Hit{distance_m, glm::normalize(from + distance_m * d - ball.center_m), ball.f0, true};
}

/// A floor of tiles, a red wall on the left; the rest is open.
std::optional<Hit> meet(const vec3& from, const vec3& d, bool with_chrome) {
    std::optional<Hit> best;
    const float floor_m = -from.y / d.y;
    const vec3 at = from + floor_m * d;
    if (floor_m > 1e-3f && std::abs(at.x) < kHalf.x && std::abs(at.z) < kHalf.z) {
        const bool odd =
            (static_cast<int>(std::floor(at.x * 2.0f)) + static_cast<int>(std::floor(at.z * 2.0f))) & 1;
        best = Hit{floor_m, {0, 1, 0}, vec3(odd ? 0.5f : 0.35f), false};
    }
    const float wall_m = (-kHalf.x - from.x) / d.x;
    const vec3 on_wall = from + wall_m * d;
    if (wall_m > 1e-3f && on_wall.y > 0.0f && on_wall.y < 2.0f && std::abs(on_wall.z) < kHalf.z &&
        !(best && best->distance_m < wall_m))
        best = Hit{wall_m, {1, 0, 0}, {0.6f, 0.03f, 0.03f}, false};
    meet_ball(kGold, from, d, best);
    if (with_chrome) meet_ball(kChrome, from, d, best);
    return best;
}

vec3 sky(const vec3& d) {
    return mix(vec3(0.75f, 0.8f, 0.85f), vec3(0.15f, 0.35f, 0.8f), saturate(d.y));
}

/// A matte surface under the sun and half of the sky.
vec3 matte(const Hit& hit, const vec3& p, const vec3& albedo, bool with_chrome) {
    const float cosine = glm::dot(hit.normal, kToSun);
    const bool lit = cosine > 0.0f && !meet(p + 1e-3f * hit.normal, kToSun, with_chrome);
    return albedo * (sky(hit.normal) * 0.5f + (lit ? kSunColor * cosine : vec3(0.0f)));
}

vec3 truth(vec3 from, vec3 d) {
    vec3 weight(1.0f);
    for (int bounce = 0; bounce < kBounces; ++bounce) {
        const auto hit = meet(from, d, true);
        if (!hit) return weight * sky(d);
        const vec3 p = from + hit->distance_m * d;
        if (!hit->metal) return weight * matte(*hit, p, hit->color, true);
        weight *= hit->color;
        from = p + 1e-3f * hit->normal;
        d = glm::reflect(d, hit->normal);
    }
    return vec3(0.0f);
}

struct Seen {
    vec3 luminance{0.0f};
    float visibility = 0.0f;
};

/// One direction of the probe: no specular light, metals matte with f0 for albedo, alpha where there is
/// anything.
Seen captured(const vec3& d) {
    const auto hit = meet(kCapture, d, false);
    if (!hit) return {};
    return {matte(*hit, kCapture + hit->distance_m * d, hit->color, false), 1.0f};
}

/// The chrome ball as the frame has it; what is seen directly is as it is.
vec3 by_probe(const vec3& from, const vec3& d) {
    const auto hit = meet(from, d, true);
    if (!hit || !hit->metal) return truth(from, d);
    const vec3 mirror = glm::reflect(d, hit->normal);
    ProbeSum sum = empty_probe_sum();
    const ProbeLookup at = probe_lookup(kProxyBox, kHalf, kCapture - kMiddle,
                                        from + hit->distance_m * d - kMiddle, mirror, 0.0f);
    const Seen seen = captured(glm::normalize(at.direction));
    add_probe(sum, seen.luminance, seen.visibility);
    return hit->color * add_distant(sum, sky(mirror));
}

vec3 by_sky_alone(const vec3& from, const vec3& d) {
    const auto hit = meet(from, d, true);
    if (!hit || !hit->metal) return truth(from, d);
    return hit->color * sky(glm::reflect(d, hit->normal));
}

vec3 through_pixel(int x, int y) {
    static const vec3 forward = glm::normalize(vec3(-0.1f, -0.42f, -1.0f));
    static const vec3 right = glm::normalize(glm::cross(forward, vec3(0, 1, 0)));
    const float u = (float(x) + 0.5f) / kWidth - 0.5f;
    const float v = (0.5f - (float(y) + 0.5f) / kHeight) * kHeight / kWidth;
    return glm::normalize(forward + 0.95f * (u * right + v * glm::cross(right, forward)));
}
const vec3 kEye(0.3f, 1.9f, 4.1f);

Panel blank(std::string title, std::string caption, int width, int height) {
    Panel panel{std::move(title), std::move(caption), std::uint32_t(width), std::uint32_t(height), {}, 2};
    panel.rgb.assign(std::size_t(3 * width * height), 255);
    return panel;
}

void put(Panel& panel, int x, int y, const vec3& value) {
    const vec3 code = srgb_from_linear(glm::clamp(0.6f * value, 0.0f, 1.0f));
    for (int c = 0; c < 3; ++c)
        panel.rgb[3 * (std::size_t(y) * panel.width + std::size_t(x)) + std::size_t(c)] =
            std::uint8_t(std::lround(255.0f * code[c]));
}

struct Result {
    Panel panel =
        blank("A probe beside a red wall",
              "Left: the truth. Middle: metals with the distant light alone. Right: with the probe.",
              3 * kWidth + 8, kHeight);
    ErrorStatistics alone;
    ErrorStatistics probe;
};

Result draw() {
    Result out;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const vec3 d = through_pixel(x, y);
            const std::array pictures{truth(kEye, d), by_sky_alone(kEye, d), by_probe(kEye, d)};
            for (int i = 0; i < 3; ++i) put(out.panel, x + i * (kWidth + 4), y, pictures[std::size_t(i)]);
            const auto hit = meet(kEye, d, true);
            if (!hit || !hit->metal) continue;
            const auto error = [&](const vec3& v) { return double(glm::length(v - pictures[0])); };
            out.alone.add(error(pictures[1]));
            out.probe.add(error(pictures[2]));
        }
    }
    return out;
}

Findings run() {
    Findings out;
    const Result result = draw();
    Panel color = blank("Color of the probe",
                        "All directions: the tiles, the wall on the left, gold as if it were yellow paint.",
                        kProbeWidth, kProbeWidth / 2);
    Panel alpha = blank("Alpha of the probe",
                        "White where it sees something, black where the distant light is to answer.",
                        kProbeWidth, kProbeWidth / 2);
    double seen_sr = 0.0;
    for (int y = 0; y < kProbeWidth / 2; ++y) {
        for (int x = 0; x < kProbeWidth; ++x) {
            const vec2 uv((float(x) + 0.5f) / kProbeWidth, (float(y) + 0.5f) / (0.5f * kProbeWidth));
            const Seen seen = captured(equirect_direction(uv));
            put(color, x, y, seen.luminance);
            put(alpha, x, y, vec3(seen.visibility / 0.6f));
            seen_sr += double(seen.visibility * std::sin(PI * uv.y)) *
                       double(2.0f * PI * PI / (0.5f * kProbeWidth * kProbeWidth));
        }
    }
    out.pictures = {result.panel, color, alpha};
    out.measured = {
        at_most("mean error of the metals with the probe, over that with the distant light alone",
                result.probe.mean() / result.alone.mean(), 0.4),
        // Solid angles of the two rectangles from kCapture, and with the gold ball's whole cap beside them.
        within("part of the sphere that the probe answers for", seen_sr / (4.0 * M_PI), 0.4130, 0.4320)};
    out.tables = {{"Mean error of the metals' luminance, white under the sun about 1.5",
                   {"distant light alone", "with the probe"},
                   {{readable(result.alone.mean()), readable(result.probe.mean())}}}};
    out.text =
        "The probe is captured without specular light, with gold as yellow paint, and knows what it does not "
        "see. With "
        "it the ball shows the wall and the tiles where they are, and the sky where the probe is empty. What "
        "is left is "
        "what the box is not: the gold ball within it, the ball's own image, and the wall's upper edge, "
        "which is lower "
        "than the box.";
    return out;
}

}  // namespace

Experiment frostbite_figure53() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 53", "A local probe beside a red wall",
            "Mirror balls between a red wall and the sky: traced, lit by the sky alone, and by a probe of "
            "color and alpha "
            "under the rules of section 4.9.1.2, corrected for its place and composed with the sky.",
            run};
}

}  // namespace candela::measure::experiments
