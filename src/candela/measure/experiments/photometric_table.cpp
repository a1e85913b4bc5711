#include "candela/measure/numerics.hpp"
#include "candela/scene/photometric.hpp"
#include "shading/lights/photometric.glsl"
#include "shading/sampling.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

constexpr double kDegree = kPi / 180.0;
constexpr int kRows = 73;  ///< 2.5 degrees, the step of the webs below
constexpr int kColumns = 24;

struct Web {
    const char* name;
    double (*intensity)(double c_rad, double gamma_rad);
};

/// Shapes that luminaires have: a spot of 20 degrees, a batwing for corridors, a street light to one side.
constexpr Web kWebs[] = {
    {"spot", [](double, double g) { return 5000.0 * std::exp(-std::log(2.0) * g * g / 0.0305); }},
    {"batwing",
     [](double c, double g) {
         const double lobe = std::exp(-std::pow((g - 0.6) / 0.25, 2.0));
         return std::max(0.0, std::cos(g)) * (200.0 + 900.0 * lobe * std::pow(std::cos(c), 2.0));
     }},
    {"street light", [](double c, double g) {
         const double side = 0.5 + 0.5 * std::sin(c);
         return 300.0 * std::max(0.0, std::cos(g)) +
                4000.0 * side * std::exp(-std::pow((g - 1.1) / 0.2, 2.0)) * std::sin(g);
     }}};

scene::PhotometricProfile profile_of(const Web& web) {
    scene::PhotometricProfile p;
    p.vertical_deg = linspace(0.0, 180.0, kRows);
    p.horizontal_deg = linspace(0.0, 360.0, kColumns + 1);
    for (const double c : p.horizontal_deg) {
        for (const double g : p.vertical_deg)
            p.candela.push_back(float(web.intensity(c * kDegree, g * kDegree)));
    }
    return p;
}

/// A table of this many rows as a light uses it.
using Lookup = std::function<double(const glm::vec3&)>;

Lookup by_angle(const scene::PhotometricProfile& p, int width, int height) {
    return [table = scene::resample(p, width, height), width, height](const glm::vec3& d) {
        const PhotometricTaps taps = photometric_taps(d, width, height);
        double sum = 0.0;
        for (int i = 0; i < 4; ++i) sum += double(taps.weight[i]) * double(table[std::size_t(taps.index[i])]);
        return sum;
    };
}

/// Frostbite listing 5: rows by the cosine, as a texture is sampled (centres of texels, clamped), columns as
/// above.
Lookup by_cosine(const scene::PhotometricProfile& p, int width, int height) {
    std::vector<double> table;
    for (int y = 0; y < height; ++y) {
        const double gamma = std::acos(1.0 - (2.0 * y + 1.0) / height) / kDegree;
        for (int x = 0; x < width; ++x) table.push_back(scene::intensity_cd(p, 360.0 * x / width, gamma));
    }
    return [=](const glm::vec3& d) {
        const double cosine = -double(d.z) / std::sqrt(double(glm::dot(d, d)));
        const double y = std::clamp(0.5 * (1.0 - cosine) * height - 0.5, 0.0, height - 1.0);
        const double x = double(photometric_angles(d).x) / (2.0 * kPi) * width;
        const int row = std::min(int(y), height - 2), column = int(x) % width;
        const auto at = [&](int r, int c) { return table[std::size_t(r * width + c % width)]; };
        const double s = x - std::floor(x), t = y - row;
        return std::lerp(std::lerp(at(row, column), at(row, column + 1), s),
                         std::lerp(at(row + 1, column), at(row + 1, column + 1), s), t);
    };
}

/// What a table does to a web: errors relative to the web's own.
struct Loss {
    double under = 0.0;   ///< illuminance straight below the fixture
    double lumens = 0.0;  ///< of all directions
    double mean = 0.0;    ///< mean over directions, of the mean intensity
};

Loss loss_of(const scene::PhotometricProfile& p, const Lookup& lookup) {
    constexpr std::uint32_t count = 1u << 14;
    double table_sum = 0.0, web_sum = 0.0, difference = 0.0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const vec2 u = hammersley(i, count);
        const double gamma = std::acos(1.0 - 2.0 * (double(i) + 0.5) / count);
        const vec3 d = photometric_direction(TWO_PI * u.y, float(gamma));
        const double table = lookup(d), web = scene::intensity_cd(p, d);
        table_sum += table;
        web_sum += web;
        difference += std::abs(table - web);
    }
    const double below = scene::intensity_cd(p, glm::vec3(0.0f, 0.0f, -1.0f));
    return {lookup({0.0f, 0.0f, -1.0f}) / below - 1.0, table_sum / web_sum - 1.0, difference / web_sum};
}

std::string percent(double value) {
    return number(100.0 * value, 3);
}

Findings run() {
    Findings out;
    Table table{"Loss in percent", {"web", "table", "under the fixture", "lumens", "mean error"}, {}};
    ErrorStatistics under, lumens, mean, cosine_mean, projected_lumens;
    for (const Web& web : kWebs) {
        const scene::PhotometricProfile p = profile_of(web);
        const auto grid = scene::fitting_grid(p);
        const Loss fitting = loss_of(p, by_angle(p, grid.width, grid.height));
        const Loss projected = loss_of(p, by_angle(p, kColumns, 64));
        const Loss cosine = loss_of(p, by_cosine(p, kColumns, kRows));
        under.add(fitting.under);
        lumens.add(fitting.lumens);
        mean.add(fitting.mean);
        projected_lumens.add(projected.lumens);
        cosine_mean.add(cosine.mean);
        const auto add = [&](const std::string& name, const Loss& loss) {
            table.rows.push_back(
                {web.name, name, percent(loss.under), percent(loss.lumens), percent(loss.mean)});
        };
        add("angle, fitting: " + std::to_string(grid.width) + " x " + std::to_string(grid.height), fitting);
        add("angle, projected: 24 x 64", projected);
        add("cosine, Frostbite: 24 x 73", cosine);
    }
    out.text =
        "A table whose nodes meet the file's angles is the file: the three losses are rounding. At the same "
        "size rows "
        "by the cosine of the angle have their first texel at 9.5 degrees, and a spot's centre is lost in "
        "it. A table "
        "that meets no angle keeps the lumens, being a projection, and blurs.";
    out.measured = {
        at_most("illuminance under the fixture, fitting table, largest error", under.max(), 0.005),
        at_most("lumens, fitting table, largest error", lumens.max(), 0.001),
        at_most("lumens, table that does not fit, largest error", projected_lumens.max(), 0.001)};
    out.tables = {table};
    const scene::PhotometricProfile spot = profile_of(kWebs[0]);
    const auto gammas = linspace(0.0, 30.0, 121);
    const auto along = [&](const Lookup& lookup) {
        return [&spot, lookup](double g) { return lookup(photometric_direction(0.0f, float(g * kDegree))); };
    };
    out.plots = {
        {"A spot of 20 degrees in tables of 73 rows",
         "",
         {"gamma in degrees", 0.0, 30.0},
         {"intensity in cd", 0.0, 5500.0},
         {curve("file", gammas, [&](double g) { return scene::intensity_cd(spot, 0.0, g); }),
          curve("rows by angle", gammas, along(by_angle(spot, kColumns, kRows)), Stroke::dashed),
          curve("rows by cosine", gammas, along(by_cosine(spot, kColumns, kRows)), Stroke::dotted)}}};
    out.techniques = {
        {"photometric_taps", "CIE 121; own layout", "a photometric web",
         "the file's web, bilinear in its angles; spot, batwing, street light", "of the mean intensity",
         mean.mean(), mean.max(),
         [] {
             return cost_ns([](const vec4& u) {
                 return photometric_taps(vec3(u.x - 0.5f, u.y - 0.5f, u.z - 0.5f), 24, 73).weight.x;
             });
         }},
        {"cosine rows, 73 of them", "Frostbite section 4.5, listing 5", "a photometric web", "the same",
         "of the mean intensity", cosine_mean.mean(), cosine_mean.max(), [] {
             return cost_ns([](const vec4& u) {
                 const vec3 d = normalize(vec3(u.x - 0.5f, u.y - 0.5f, u.z - 0.5f));
                 return 0.5f * d.z + 0.5f + atan(d.y, d.x) / TWO_PI;
             });
         }}};
    return out;
}

}  // namespace

Experiment photometric_table() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "section 4.5, listing 5", "Photometric webs as tables",
            "What a table does to three webs given every 2.5 degrees: illuminance under the fixture, lumens, "
            "and error "
            "over all directions, for rows by angle and for Frostbite's rows by cosine.",
            run};
}

}  // namespace candela::measure::experiments
