#include <array>

#include "candela/bake/environment.hpp"
#include "candela/bake/sky.hpp"
#include "candela/measure/numerics.hpp"
#include "candela/measure/sky_truth.hpp"
#include "shading/environment.glsl"
#include "shading/tone_curves.glsl"
#include "shading/transfer.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

constexpr double kRad = kPi / 180.0;

scene::SkySettings settings_of(double elevation_deg, double turbidity) {
    scene::SkySettings s;
    s.elevation_deg = float(elevation_deg);
    s.turbidity = float(turbidity);
    s.azimuth_deg = 0.0f;
    return s;
}

double sky_lx(const bake::SkyModel& model) {
    return double(bake::upward_illuminance_lx(bake::sky_picture(model, 0.0f, 32)));
}
double sky_lx(double elevation_deg, double turbidity) {
    return sky_lx(bake::SkyModel(settings_of(elevation_deg, turbidity)));
}

/// Errors of the model's illuminance and of its luminance in some directions, against random walks.
void compare(Findings& out, ErrorStatistics& illuminance, ErrorStatistics& directions) {
    struct Direction {
        const char* name;
        double elevation_deg;
        double azimuth_deg;
    };
    constexpr std::array<Direction, 4> looks{{{"zenith", 90.0, 0.0},
                                              {"45 deg, across", 45.0, 90.0},
                                              {"5 deg, sunward", 5.0, 0.0},
                                              {"5 deg, opposite", 5.0, 180.0}}};
    Table table{"Model over random walks, %; in brackets the walks' standard error",
                {"turbidity", "sun, deg", "illuminance"},
                {}};
    for (const Direction& d : looks) table.columns.emplace_back(d.name);
    const auto cell = [](double percent, const SkyEstimate& truth) {
        return fixed(percent, 1) + " (" + fixed(100.0 * truth.standard_error / truth.value, 1) + ")";
    };
    for (const double turbidity : {1.0, 4.0}) {
        for (const double elevation : {60.0, 20.0, 5.0, -2.0}) {
            const bake::SkyModel model(settings_of(elevation, turbidity));
            const SkyEstimate truth = sky_illuminance_truth(model, 24000, 1);
            const double percent = 100.0 * (sky_lx(model) / truth.value - 1.0);
            illuminance.add(percent);
            std::vector<std::string> row{fixed(turbidity, 0), fixed(elevation, 0), cell(percent, truth)};
            for (const Direction& d : looks) {
                const SkyEstimate look =
                    sky_luminance_truth(model, d.elevation_deg * kRad, d.azimuth_deg * kRad, 8000, 2);
                const double nit = double(luminance(
                    model.luminance_nit(float(d.elevation_deg * kRad), float(d.azimuth_deg * kRad))));
                directions.add(100.0 * (nit / look.value - 1.0));
                row.push_back(cell(100.0 * (nit / look.value - 1.0), look));
            }
            table.rows.push_back(row);
        }
    }
    out.tables.push_back(table);
}

Plot illuminance_plot() {
    Plot plot{"The sky's illuminance on level ground",
              "Dashed: IES clear day (0.8 + 15.5 sqrt(sin h) klx). Dots: twilight by the AMS Glossary of "
              "Meteorology (585 to 410 lx at sunset, 3.5 to 2 lx at -6, 0.008 lx at -12 degrees).",
              {"sun's elevation, deg", -12.0, 90.0},
              {"lx", 0.001, 100000.0, Scale::logarithmic},
              {}};
    const std::vector<double> elevations{-12.0, -6.0, -0.83, 5.0, 20.0, 70.0};
    for (const double turbidity : {1.0, 2.5, 6.0})
        plot.series.push_back(curve("turbidity " + number(turbidity), elevations,
                                    [&](double e) { return sky_lx(e, turbidity); }));
    plot.series.push_back(curve(
        "IES", linspace(2.0, 90.0, 45),
        [](double e) { return 800.0 + 15500.0 * std::sqrt(std::sin(e * kRad)); }, Stroke::dashed));
    plot.series.push_back(
        {"twilight", {-0.83, -0.83, -6.0, -6.0, -12.0}, {585.0, 410.0, 3.5, 2.0, 0.008}, Stroke::points});
    return plot;
}

/// Published fits for turbidity 2.5: Karayel et al. 1984 (San Francisco) and Preetham et al. 1999, appendix
/// A.2.
Plot zenith_plot() {
    constexpr double turbidity = 2.5;
    Plot plot{
        "Luminance at the zenith, turbidity 2.5",
        "The two fits are two- to fourfold apart. Air without aerosol is the least that a zenith can be.",
        {"sun's elevation, deg", 5.0, 60.0},
        {"cd/m^2", 0.0, 10000.0},
        {}};
    const std::vector<double> elevations{5.0, 15.0, 30.0, 45.0, 60.0};
    const auto zenith = [](double e, double t) {
        return double(luminance(bake::SkyModel(settings_of(e, t)).luminance_nit(0.5f * PI, 0.0f)));
    };
    plot.series.push_back(curve("this model", elevations, [&](double e) { return zenith(e, turbidity); }));
    plot.series.push_back(curve(
        "this model, no aerosol", elevations, [&](double e) { return zenith(e, 1.0); }, Stroke::dotted));
    plot.series.push_back(curve(
        "Karayel 1984", elevations,
        [&](double e) { return 1000.0 * ((1.376 * turbidity - 1.81) * std::tan(e * kRad) + 0.38); },
        Stroke::dashed));
    plot.series.push_back(curve(
        "Preetham 1999", elevations,
        [&](double e) {
            const double chi = (4.0 / 9.0 - turbidity / 120.0) * 2.0 * e * kRad;
            return 1000.0 * ((4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192);
        },
        Stroke::dashed));
    return plot;
}

/// The dome seen from below, north on top and east on the left, equidistant; exposed for its own mean.
Panel dome(double elevation_deg) {
    constexpr int size = 180;
    scene::SkySettings settings = settings_of(elevation_deg, 2.5);
    const scene::Environment e = bake::sky_of(settings, 256).environment;
    const float mean_nit = bake::upward_illuminance_lx(e) * INV_PI;
    Panel out{"sun at " + number(elevation_deg) + " degrees", "", size, size, {}, 1};
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const vec2 p = (vec2(float(x), float(y)) + 0.5f) * (2.0f / float(size)) - 1.0f;
            const float r = glm::length(p);
            vec3 shown(1.0f);
            if (r < 1.0f) {
                const float polar = 0.5f * PI * r;
                const vec3 d(-std::sin(polar) * p.x / max(r, 1e-6f), std::cos(polar),
                             std::sin(polar) * p.y / max(r, 1e-6f));
                const vec2 uv = equirect_uv(d);
                const auto column = std::min(std::size_t(uv.x * float(e.width)), std::size_t{e.width} - 1);
                const auto row = std::min(std::size_t(uv.y * float(e.height)), std::size_t{e.height} - 1);
                shown = srgb_from_linear(
                    tone_neutral(e.luminance_nit[row * e.width + column] * (0.3f / mean_nit)));
            }
            for (int c = 0; c < 3; ++c) out.rgb.push_back(std::uint8_t(saturate(shown[c]) * 255.0f + 0.5f));
        }
    }
    return out;
}

Findings run() {
    Findings out;
    ErrorStatistics illuminance, directions;
    compare(out, illuminance, directions);
    out.plots = {illuminance_plot(), zenith_plot()};
    for (const double elevation : {60.0, 20.0, 3.0, -3.0, -6.0}) out.pictures.push_back(dome(elevation));
    // The disc's upper edge is seen on the horizon when its centre is 50 minutes of arc below.
    const double sunset = sky_lx(-0.83, 2.5), civil = sky_lx(-6.0, 2.5), nautical = sky_lx(-12.0, 2.5);
    out.text =
        "Without aerosol the model is within the walks' own error. With aerosol its error comes from "
        "describing "
        "light that is scattered more than once by its mean and first moment alone: too bright a zenith at a "
        "low "
        "sun, and in twilight. Twilight has the published illuminances. With the sun above 10 degrees the "
        "IES "
        "clear day lies between turbidity 1 and 2.5. The published fits of the zenith are two- to fourfold "
        "apart; "
        "Karayel's is no brighter than air without any aerosol while the sun is low, Preetham's is brighter "
        "than "
        "this model at every height.";
    out.measured = {
        at_most("illuminance over random walks, mean error", illuminance.mean(), 2.5, "%"),
        at_most("illuminance over random walks, largest error", illuminance.max(), 5.0, "%"),
        at_most("luminance over random walks, mean error", directions.mean(), 8.0, "%"),
        within("sunset, turbidity 2.5 (AMS: 410 to 585)", sunset, 350.0, 700.0, "lx"),
        within("end of civil twilight, turbidity 2.5 (AMS: 2 to 3.5)", civil, 2.0, 3.6, "lx"),
        within("end of nautical twilight, turbidity 2.5 (AMS: 0.008)", nautical, 0.004, 0.012, "lx")};
    out.techniques.push_back(
        {"multiple_scattering_closure", "Hillaire 2020, section 5.5, equations 7 and 8",
         "all orders of scattering of a clear sky, after two that are integrated",
         "random walks: illuminance of level ground, turbidity 1 to 4, sun -2 to 60 degrees", "%",
         illuminance.mean(), illuminance.max(),
         [] { return cost_ns([](const vec4& u) { return multiple_scattering_closure(u.x); }); }});
    return out;
}

}  // namespace

Experiment hillaire2020_sky() {
    return {"Hillaire 2020", "Section 5", "A clear sky in absolute units",
            "The sky model against random walks through the same air with all orders of scattering, and "
            "against published "
            "illuminances and luminances; the dome for six heights of the sun.",
            run};
}

}  // namespace candela::measure::experiments
