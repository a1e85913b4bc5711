#include "candela/bake/sky_model.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "shading/environment.glsl"

namespace candela::bake {
namespace {

using namespace shading;

constexpr int kColumnMus = 192;
constexpr int kColumnAltitudes = 64;
constexpr int kAltitudes = 20;  ///< of light scattered more than once
/// Columns of the sun's angle: in twilight light falls by half within a degree.
constexpr int kSunAnglesHigh = 12;
constexpr int kSunAnglesLow = 36;
constexpr float kLowSun_rad = 1.4f;  ///< 10 degrees above the level
/// The longest way along the horizon spans 10 degrees of the earth.
constexpr float kSunSpan_rad = 0.18f;
constexpr int kGatherSteps = 16;
constexpr float kEyeHeight_m = 2.0f;

/// Altitudes of tables lie denser where the air is denser.
float altitude_of(float row, int rows) {
    return kAirTop_m * square(row / float(rows - 1));
}
float row_of(float altitude_m, int rows) {
    return float(rows - 1) * std::sqrt(std::clamp(altitude_m / kAirTop_m, 0.0f, 1.0f));
}

/// Where to look between two entries of a table.
struct Between {
    int low;
    int high;
    float share;  ///< of the high one
};
Between between(float x, int count) {
    const float at = std::clamp(x, 0.0f, float(count - 1));
    const int low = std::min(int(at), std::max(count - 2, 0));
    return {low, std::min(low + 1, count - 1), at - float(low)};
}

template <class T>
void set_zero(T& bands) {
    for (float& x : bands.of) x = 0.0f;
}

/// Columns are a function of the distance to the top of the air, between its least, upwards, and its most,
/// along the horizon (Bruneton & Neyret 2008, section 4.2 by Bruneton's revision of 2017).
float columns_x(float altitude_m, float mu) {
    const float least = kAirTop_m - altitude_m;
    const float most = sky_distance_to_top(altitude_m, sky_horizon_mu(altitude_m));
    return (sky_distance_to_top(altitude_m, mu) - least) / std::max(most - least, 1.0f);
}

SkyTable<glm::vec3> create_log_columns() {
    SkyTable<glm::vec3> table{kColumnMus, kColumnAltitudes, {}};
    table.values.resize(std::size_t{kColumnMus} * kColumnAltitudes);
    tbb::parallel_for(0, kColumnAltitudes, [&](int row) {
        const float h = altitude_of(float(row), kColumnAltitudes);
        const float r = kEarthRadius_m + h;
        const float least = kAirTop_m - h;
        const float lowest_mu = sky_horizon_mu(h);
        const float most = sky_distance_to_top(h, lowest_mu);
        for (int x = 0; x < kColumnMus; ++x) {
            const float d = least + (most - least) * float(x) / float(kColumnMus - 1);
            const float climb = (kAirTop_m - h) * (2.0f * kEarthRadius_m + h + kAirTop_m);
            const float mu = d > 0.0f ? std::clamp((climb - d * d) / (2.0f * r * d), lowest_mu, 1.0f) : 1.0f;
            table.at(x, row) = glm::log(glm::max(sky_columns_m(h, x == 0 ? 1.0f : mu), vec3(1.0e-6f)));
        }
    });
    return table;
}

/// The same for every sky.
const SkyTable<glm::vec3>& log_columns() {
    static const SkyTable<glm::vec3> table = create_log_columns();
    return table;
}

/// Gauss-Legendre on [0, 1].
struct Node {
    float at;
    float weight;
};
constexpr std::array<Node, 8> kNodes{{{0.0198550718f, 0.0506142681f},
                                      {0.1016667613f, 0.1111905172f},
                                      {0.2372337950f, 0.1568533229f},
                                      {0.4082826788f, 0.1813418917f},
                                      {0.5917173212f, 0.1813418917f},
                                      {0.7627662050f, 0.1568533229f},
                                      {0.8983332387f, 0.1111905172f},
                                      {0.9801449282f, 0.0506142681f}}};

/// Steps of a ray lie dense at its lowest point, with the square of their number from there. A share of
/// `before` of the steps is spent on the way down.
struct Steps {
    float lowest_m;  ///< distance of the lowest point
    float end_m;
    int before;
    int count;
    [[nodiscard]] float edge(int i) const {
        if (i <= before)
            return before > 0 ? lowest_m * (1.0f - square(float(before - i) / float(before))) : 0.0f;
        return lowest_m + (end_m - lowest_m) * square(float(i - before) / float(count - before));
    }
};

Steps steps_of(float altitude_m, float mu, bool ground, int count) {
    if (ground) {
        const float d = sky_distance_to_ground(altitude_m, mu);
        return {d, d, count, count};
    }
    const float end = sky_distance_to_top(altitude_m, mu);
    if (mu >= 0.0f) return {0.0f, end, 0, count};
    const float lowest = sky_tangent(altitude_m, mu).y;
    // Just below the level the way down is nothing.
    const int before = lowest > 0.02f * end ? count / 2 : 0;
    return {before > 0 ? lowest : 0.0f, end, before, count};
}

/// Four neighbours in a table of scattered light.
struct Neighbours {
    const SkyModel::Moments* of[4];
    float weight[4];

    void sum(SkyBands SkyModel::Moments::*moment, float factor, SkyBands& out) const {
        const float w[4] = {factor * weight[0], factor * weight[1], factor * weight[2], factor * weight[3]};
        for (int b = 0; b < kSkyBands; ++b)
            out.of[b] += w[0] * (of[0]->*moment).of[b] + w[1] * (of[1]->*moment).of[b] +
                         w[2] * (of[2]->*moment).of[b] + w[3] * (of[3]->*moment).of[b];
    }
};
Between sun_between(const SkyModel::Scattered& s, float sun_mu) {
    if (s.moments.width == 1) return {0, 0, 0.0f};
    const float angle = atan2_fast(std::sqrt(std::max(1.0f - sun_mu * sun_mu, 0.0f)), sun_mu);
    return between((angle - s.first_angle_rad) / s.angle_step_rad, s.moments.width);
}
Neighbours neighbours(const SkyModel::Scattered& s, float altitude_m, float sun_mu) {
    const Between x = sun_between(s, sun_mu);
    const Between y = between(row_of(altitude_m, s.moments.height), s.moments.height);
    return {{&s.moments.at(x.low, y.low), &s.moments.at(x.high, y.low), &s.moments.at(x.low, y.high),
             &s.moments.at(x.high, y.high)},
            {(1.0f - x.share) * (1.0f - y.share), x.share * (1.0f - y.share), (1.0f - x.share) * y.share,
             x.share * y.share}};
}

}  // namespace

SkyModel::SkyModel(const scene::SkySettings& settings)
    : eye_m_(std::max(settings.altitude_m, kEyeHeight_m)),
      sun_angle_rad_((90.0f - settings.elevation_deg) * PI / 180.0f),
      sun_mu_(std::cos(sun_angle_rad_)) {
    sky_atmosphere(settings.turbidity, settings.ozone_du, settings.ground_albedo, air_);
    scattered_ = scatter();
}

glm::vec3 SkyModel::columns_m(float altitude_m, float mu) const {
    const SkyTable<glm::vec3>& table = log_columns();
    const Between y = between(row_of(altitude_m, kColumnAltitudes), kColumnAltitudes);
    const Between x = between(columns_x(altitude_m, mu) * float(kColumnMus - 1), kColumnMus);
    const vec3 low = glm::mix(table.at(x.low, y.low), table.at(x.high, y.low), x.share);
    const vec3 high = glm::mix(table.at(x.low, y.high), table.at(x.high, y.high), x.share);
    return glm::exp(glm::mix(low, high, y.share));
}

void SkyModel::add_ground(const March& m, float distance_m, const SkyBands& transmittance,
                          SkyRay<SkyBands>& out) const {
    const float r = kEarthRadius_m + m.altitude_m;
    const float sun_mu = std::clamp((r * m.sun_mu + distance_m * m.cosine) / kEarthRadius_m, -1.0f, 1.0f);
    const float reflected = air_.ground_albedo * INV_PI;
    if (m.sunlit && sun_mu > -kSunAngularRadius_rad) {
        const vec3 columns = columns_m(0.0f, std::max(sun_mu, 0.0f));
        const float cosine = std::max(sun_mu, 0.0f) * sun_visible_share(0.0f, sun_mu);
        for (int b = 0; b < kSkyBands; ++b)
            out.rest.of[b] +=
                transmittance.of[b] * reflected * cosine * exp_of_negative(-narrowed_depth(b, columns));
    }
    if (!m.source) return;
    const Scattered& s = *m.source;
    const Between x = sun_between(s, sun_mu);
    const auto& low = s.ground[std::size_t(x.low)];
    const auto& high = s.ground[std::size_t(x.high)];
    for (int b = 0; b < kSkyBands; ++b)
        out.rest.of[b] += transmittance.of[b] * reflected * (low.of[b] + x.share * (high.of[b] - low.of[b]));
}

void SkyModel::add_forward(const SkyBands& scattered, float aerosol_m, SkyRay<SkyBands>& out) const {
    for (int b = 0; b < kSkyBands; ++b) {
        const vec4 shares = forward_shares(kForwardShare * air_.aerosol_scattering.of[b] * aerosol_m);
        for (int n = 0; n < kForwardOrders; ++n)
            out.aerosol[std::size_t(n)].of[b] += scattered.of[b] * shares[n];
    }
}

SkyModel::Source SkyModel::source_at(const March& m, float distance_m, float altitude_m, float sun_mu) const {
    Source out;
    set_zero(out.even);
    set_zero(out.directed);
    if (!m.source) return out;
    const Neighbours n = neighbours(*m.source, altitude_m, sun_mu);
    const float mu = ((kEarthRadius_m + m.altitude_m) * m.mu + distance_m) / (kEarthRadius_m + altitude_m);
    const float sunward = (m.cosine - mu * sun_mu) / std::sqrt(std::max(1.0f - sun_mu * sun_mu, 1.0e-6f));
    n.sum(&Moments::mean, 1.0f, out.even);
    n.sum(&Moments::up, 3.0f * kNarrowedAsymmetry * mu, out.directed);
    n.sum(&Moments::sunward, 3.0f * kNarrowedAsymmetry * sunward, out.directed);
    return out;
}

SkyRay<SkyBands> SkyModel::march(const March& m) const {
    SkyRay<SkyBands> out;
    set_zero(out.air);
    for (SkyBands& bands : out.aerosol) set_zero(bands);
    set_zero(out.rest);
    SkyBands passed;
    for (float& x : passed.of) x = 1.0f;
    const float r = kEarthRadius_m + m.altitude_m;
    const Steps steps = steps_of(m.altitude_m, m.mu, m.ground, m.steps);
    const SkyBands& aerosol_scattering = m.eye ? air_.aerosol_scattering : air_.narrowed_scattering;
    float passed_aerosol_m = 0.0f;
    float from = 0.0f;
    for (int i = 0; i < m.steps; ++i) {
        const float to = steps.edge(i + 1);
        const float length = to - from;
        const float at = 0.5f * (from + to);
        from = to;
        const float h = std::max(sky_altitude_at(m.altitude_m, m.mu, at), 0.0f);
        const float sun_mu = (r * m.sun_mu + at * m.cosine) / (kEarthRadius_m + h);
        const vec3 density = sky_density(h);
        const float share = m.sunlit ? sun_visible_share(h, sun_mu) : 0.0f;
        const vec3 columns = share > 0.0f ? columns_m(h, sun_mu) : vec3(0.0f);
        passed_aerosol_m += 0.5f * length * density.y;
        const Source source = source_at(m, at, h, sun_mu);
        SkyBands scattered;
        for (int b = 0; b < kSkyBands; ++b) {
            const float air = air_.air_scattering.of[b] * density.x;
            const float aerosol = aerosol_scattering.of[b] * density.y;
            const float x = length * narrowed_depth(b, density);
            const float pass = exp_of_negative(-x);
            const float arrives = passed.of[b] * length * mean_transmittance(x, pass);
            const float sun = share * exp_of_negative(-narrowed_depth(b, columns));
            out.air.of[b] += arrives * air * sun;
            scattered.of[b] = arrives * aerosol * sun;
            out.rest.of[b] +=
                arrives * (air * source.even.of[b] + air_.narrowed_scattering.of[b] * density.y *
                                                         (source.even.of[b] + source.directed.of[b]));
            passed.of[b] *= pass;
        }
        if (m.eye)
            add_forward(scattered, columns.y + passed_aerosol_m, out);
        else
            for (int b = 0; b < kSkyBands; ++b) out.aerosol[0].of[b] += scattered.of[b];
        passed_aerosol_m += 0.5f * length * density.y;
    }
    if (m.ground) add_ground(m, steps.end_m, passed, out);
    return out;
}

void SkyModel::gather_at(const Scattered* source, int column, int row, Scattered& out) const {
    // Scattered light has no direction of its own: fewer azimuths do.
    const int azimuths = source ? 2 : 4;
    const float h = altitude_of(float(row), kAltitudes);
    const float horizon = sky_horizon_mu(h);
    const float angle = out.first_angle_rad + out.angle_step_rad * float(column);
    Moments moments;
    SkyBands ground;
    set_zero(moments.mean);
    set_zero(moments.up);
    set_zero(moments.sunward);
    set_zero(ground);
    for (const bool below : {false, true}) {
        for (const Node& node : kNodes) {
            // Towards the horizon by the square, where the sky changes fastest.
            const float reach = below ? -1.0f - horizon : 1.0f - horizon;
            const float mu = horizon + reach * square(node.at);
            const float share = std::abs(reach) * 2.0f * node.at * node.weight / float(azimuths);
            for (int a = 0; a < azimuths; ++a) {
                const float azimuth = PI * (float(a) + 0.5f) / float(azimuths);
                const float level = std::sqrt(std::max(1.0f - mu * mu, 0.0f)) * std::cos(azimuth);
                const float cosine = mu * std::cos(angle) + level * std::sin(angle);
                const SkyRay<SkyBands> light = march(
                    {h, mu, std::cos(angle), cosine, below, source == nullptr, source, kGatherSteps, false});
                const float air = rayleigh_phase(cosine);
                const float aerosol = henyey_greenstein_phase(cosine, kNarrowedAsymmetry);
                for (int b = 0; b < kSkyBands; ++b) {
                    const float all =
                        share * (air * light.air.of[b] + aerosol * light.aerosol[0].of[b] + light.rest.of[b]);
                    moments.mean.of[b] += 0.5f * all;
                    moments.up.of[b] += 0.5f * mu * all;
                    moments.sunward.of[b] += 0.5f * level * all;
                    ground.of[b] += below ? 0.0f : TWO_PI * mu * all;
                }
            }
        }
    }
    out.moments.at(column, row) = moments;
    if (row == 0) out.ground[std::size_t(column)] = ground;
}

SkyModel::Scattered SkyModel::gather(const Scattered* source, int columns) const {
    Scattered out;
    out.moments = {columns, kAltitudes, {}};
    out.moments.values.resize(std::size_t(columns) * kAltitudes);
    out.ground.resize(std::size_t(columns));
    out.first_angle_rad = columns > 1 ? sun_angle_rad_ - kSunSpan_rad : sun_angle_rad_;
    out.angle_step_rad = columns > 1 ? 2.0f * kSunSpan_rad / float(columns - 1) : 0.0f;
    tbb::parallel_for(0, columns * kAltitudes,
                      [&](int i) { gather_at(source, i % columns, i / columns, out); });
    return out;
}

/// Hillaire 2020, section 5.5: beyond some order all light is even, and each order is the same share of the
/// one before, which is the mean of what comes where all sources are 1. Changed: the closure begins after two
/// orders that are integrated, its sources include the ground, and the first order is scattered by its phase
/// functions.
SkyModel::Scattered SkyModel::scatter() const {
    const int columns = sun_angle_rad_ < kLowSun_rad ? kSunAnglesHigh : kSunAnglesLow;
    Scattered all = gather(nullptr, columns);
    const Scattered second = gather(&all, columns);
    Scattered one;
    one.moments = {1, kAltitudes, std::vector<Moments>(kAltitudes)};
    one.ground.resize(1);
    for (Moments& moments : one.moments.values)
        for (float& x : moments.mean.of) x = 1.0f;
    for (float& x : one.ground[0].of) x = PI;
    const Scattered share = gather(&one, 1);
    for (int row = 0; row < kAltitudes; ++row) {
        for (int column = 0; column < columns; ++column) {
            for (int b = 0; b < kSkyBands; ++b) {
                const float rest = multiple_scattering_closure(share.moments.at(0, row).mean.of[b]);
                Moments& m = all.moments.at(column, row);
                const Moments& m2 = second.moments.at(column, row);
                m.mean.of[b] += m2.mean.of[b] * rest;
                m.up.of[b] += m2.up.of[b];
                m.sunward.of[b] += m2.sunward.of[b];
                if (row == 0)
                    all.ground[std::size_t(column)].of[b] += second.ground[std::size_t(column)].of[b] * rest;
            }
        }
    }
    return all;
}

glm::vec3 SkyModel::sun_rec709_lx() const {
    // Strips across the disc, each of the brightness of its middle.
    constexpr int strips = 32;
    const float horizon = sky_horizon_mu(eye_m_);
    vec3 sum(0.0f);
    float area = 0.0f;
    for (int i = 0; i < strips; ++i) {
        const float y = (float(i) + 0.5f) * 2.0f / float(strips) - 1.0f;
        const float chord = std::sqrt(1.0f - y * y);
        area += chord;
        const float mu = std::cos(sun_angle_rad_ - y * kSunAngularRadius_rad);
        const float visible =
            std::clamp((mu - horizon) * float(strips) / (2.0f * kSunAngularRadius_rad) + 0.5f, 0.0f, 1.0f);
        if (visible > 0.0f)
            sum += chord * visible *
                   sky_rec709(air_, sky_transmittance(air_, columns_m(eye_m_, std::max(mu, horizon))));
    }
    return sum / area;
}

SkyRay<glm::vec3> SkyModel::ray(float mu, float cosine, bool ground, int steps) const {
    const SkyRay<SkyBands> light =
        march({eye_m_, mu, sun_mu_, cosine, ground, true, &scattered_, steps, true});
    SkyRay<glm::vec3> out{sky_rec709(air_, light.air), {}, sky_rec709(air_, light.rest)};
    for (std::size_t n = 0; n < out.aerosol.size(); ++n) out.aerosol[n] = sky_rec709(air_, light.aerosol[n]);
    return out;
}

glm::vec3 radiance_of(const SkyRay<glm::vec3>& light, float cosine) {
    glm::vec3 sum = rayleigh_phase(cosine) * light.air + light.rest;
    for (int n = 0; n < kForwardOrders; ++n) sum += forward_phase(cosine, n) * light.aerosol[std::size_t(n)];
    return sum;
}

glm::vec3 SkyModel::luminance_nit(float elevation_rad, float azimuth_rad) const {
    const float mu = std::sin(elevation_rad);
    const float cosine =
        mu * sun_mu_ + std::cos(elevation_rad) * std::sin(sun_angle_rad_) * std::cos(azimuth_rad);
    return radiance_of(ray(mu, cosine, mu < sky_horizon_mu(eye_m_)), cosine);
}

}  // namespace candela::bake
