#include "candela/io/photometric_web.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "candela/scene/error.hpp"
#include "shading/lights/photometric.glsl"

namespace candela::io::detail {
namespace {

using scene::PhotometricProfile;
using scene::PhotometricSymmetry;

constexpr double kSameAngle_deg = 1e-3;
constexpr double kDegree = std::numbers::pi / 180.0;

bool same(double a, double b) {
    return std::abs(a - b) <= kSameAngle_deg;
}

std::string degrees(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text;
}

/// A half-plane of the whole web: where it is, and which one of the file it repeats.
struct HalfPlane {
    double c_deg;
    std::size_t source;
};

/// How the half-planes of a file become all of them.
struct Reach {
    PhotometricSymmetry symmetry = PhotometricSymmetry::none;
    bool mirror_c0_c180 = false;
    bool mirror_c90_c270 = false;
};

Reach reach_of(const FileWeb& web, Diagnostics& diagnostics) {
    const double first = web.horizontal_deg.front(), last = web.horizontal_deg.back();
    const auto spans = [&](double from, double to) { return same(first, from) && same(last, to); };
    if (web.horizontal_deg.size() == 1) return {PhotometricSymmetry::axial, false, false};
    if (spans(0, 90)) return {PhotometricSymmetry::both_planes, true, true};
    if (spans(0, 180) || spans(180, 360)) return {PhotometricSymmetry::plane_c0_c180, true, false};
    if (spans(90, 270) || spans(-90, 90) || spans(270, 450))
        return {PhotometricSymmetry::plane_c90_c270, false, true};
    if (spans(-180, 180)) return {};
    if (!same(first, 0.0) || last <= 180.0 || last > 360.0 + kSameAngle_deg)
        throw input_error(
            "horizontal angles from " + degrees(first) + " to " + degrees(last) + " are no range of type C",
            web.where, "0 to 0, 90, 180 or 360, or 90 to 270");
    // The standard of 1995 allows any last angle over 180; what is missing is between the last and the first.
    double widest = 0.0;
    for (std::size_t i = 0; i + 1 < web.horizontal_deg.size(); ++i)
        widest = std::max(widest, web.horizontal_deg[i + 1] - web.horizontal_deg[i]);
    if (360.0 - last > 1.5 * widest)
        diagnostics.warn(web.where + ": no half-planes between C = " + degrees(last) +
                         " and 360; they are interpolated");
    return {};
}

double wrapped(double c) {
    const double out = std::fmod(c, 360.0);
    const double positive = out < 0.0 ? out + 360.0 : out;
    return same(positive, 360.0) ? 0.0 : positive;
}

/// Ascending from C = 0, each once, without 360.
std::vector<HalfPlane> half_planes(const FileWeb& web, const Reach& reach) {
    std::vector<HalfPlane> out;
    for (std::size_t i = 0; i < web.horizontal_deg.size(); ++i) {
        const double c = web.horizontal_deg[i];
        out.push_back({wrapped(c), i});
        if (reach.mirror_c0_c180) out.push_back({wrapped(-c), i});
        if (reach.mirror_c90_c270) out.push_back({wrapped(180.0 - c), i});
        if (reach.mirror_c0_c180 && reach.mirror_c90_c270) out.push_back({wrapped(180.0 + c), i});
    }
    // Of two for one place (0 and 360 in the file, or a half-plane on its own mirror) the first in the file.
    std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.c_deg < b.c_deg; });
    const auto twice = [](const HalfPlane& a, const HalfPlane& b) { return same(a.c_deg, b.c_deg); };
    out.erase(std::unique(out.begin(), out.end(), twice), out.end());
    return out;
}

/// The vertical angles from 0 to 180, and for each its row of the file; none: dark.
struct Rows {
    std::vector<double> vertical_deg;
    std::vector<std::optional<std::size_t>> source;
    void add(double angle, std::optional<std::size_t> from) {
        vertical_deg.push_back(angle);
        source.push_back(from);
    }
};

bool is_dark(const FileWeb& web, std::size_t row) {
    for (std::size_t i = row; i < web.candela.size(); i += web.vertical_deg.size()) {
        if (web.candela[i] != 0.0) return false;
    }
    return true;
}

Rows rows_of(const FileWeb& web) {
    Rows out;
    const double first = web.vertical_deg.front(), last = web.vertical_deg.back();
    const std::size_t count = web.vertical_deg.size();
    if (!same(first, 0.0)) {
        out.add(0.0, std::nullopt);
        if (!is_dark(web, 0)) out.add(first, std::nullopt);
    }
    for (std::size_t i = 0; i < count; ++i) out.add(web.vertical_deg[i], i);
    if (same(first, 0.0)) out.vertical_deg.front() = 0.0;
    if (same(last, 180.0)) {
        out.vertical_deg.back() = 180.0;
    } else {
        if (!is_dark(web, count - 1)) out.add(last, std::nullopt);
        out.add(180.0, std::nullopt);
    }
    return out;
}

void check_vertical(const FileWeb& web, Diagnostics& diagnostics) {
    const double first = web.vertical_deg.front(), last = web.vertical_deg.back();
    if (first < -kSameAngle_deg || last > 180.0 + kSameAngle_deg)
        throw input_error(
            "vertical angles from " + degrees(first) + " to " + degrees(last) + " leave type C's 0 to 180",
            web.where);
    const bool standard = (same(first, 0.0) || same(first, 90.0)) && (same(last, 90.0) || same(last, 180.0));
    if (!standard)
        diagnostics.warn(web.where + ": vertical angles only from " + degrees(first) + " to " +
                         degrees(last) + "; dark elsewhere");
}

/// At a pole all half-planes meet: files that disagree there say more than one thing of one direction.
void check_poles(const FileWeb& web, Diagnostics& diagnostics) {
    constexpr double tolerance = 0.01;
    const std::size_t stride = web.vertical_deg.size();
    for (const auto& [pole, row] : {std::pair{0.0, std::size_t{0}}, {180.0, stride - 1}}) {
        if (!same(web.vertical_deg[row], pole)) continue;
        double least = web.candela[row], most = least;
        for (std::size_t i = row; i < web.candela.size(); i += stride) {
            least = std::min(least, web.candela[i]);
            most = std::max(most, web.candela[i]);
        }
        if (most - least > tolerance * most)
            diagnostics.warn(web.where + ": half-planes disagree at gamma " + degrees(pole) + ", " +
                             degrees(least) + " to " + degrees(most) + " cd; right there C0 counts");
    }
}

/// The web's value at angles of types A and B; dark beyond them, mirrored where they start at 0.
class ViewedWeb {
  public:
    explicit ViewedWeb(const FileWeb& web)
        : web_(web),
          mirror_horizontal_(same(web.horizontal_deg.front(), 0.0)),
          mirror_vertical_(same(web.vertical_deg.front(), 0.0)) {}

    [[nodiscard]] double operator()(double horizontal_deg, double vertical_deg) const {
        const auto h =
            place(web_.horizontal_deg, mirror_horizontal_ ? std::abs(horizontal_deg) : horizontal_deg);
        const auto v = place(web_.vertical_deg, mirror_vertical_ ? std::abs(vertical_deg) : vertical_deg);
        if (!h || !v) return 0.0;
        const auto at = [&](std::size_t i, std::size_t j) {
            return web_.candela[i * web_.vertical_deg.size() + j];
        };
        return std::lerp(std::lerp(at(h->first, v->first), at(h->first, v->first + 1), v->second),
                         std::lerp(at(h->first + 1, v->first), at(h->first + 1, v->first + 1), v->second),
                         h->second);
    }
    [[nodiscard]] PhotometricSymmetry symmetry() const {
        if (mirror_horizontal_ && mirror_vertical_) return PhotometricSymmetry::both_planes;
        if (mirror_horizontal_) return PhotometricSymmetry::plane_c0_c180;
        return mirror_vertical_ ? PhotometricSymmetry::plane_c90_c270 : PhotometricSymmetry::none;
    }

  private:
    static std::optional<std::pair<std::size_t, double>> place(const std::vector<double>& angles,
                                                               double angle) {
        if (angle < angles.front() - kSameAngle_deg || angle > angles.back() + kSameAngle_deg)
            return std::nullopt;
        const auto above = std::lower_bound(angles.begin(), angles.end(), angle);
        const auto first = std::size_t(
            std::clamp<std::ptrdiff_t>(above - angles.begin() - 1, 0, std::ptrdiff_t(angles.size()) - 2));
        const double along = (angle - angles[first]) / (angles[first + 1] - angles[first]);
        return std::pair{first, std::clamp(along, 0.0, 1.0)};
    }

    const FileWeb& web_;
    bool mirror_horizontal_;
    bool mirror_vertical_;
};

double finest_step(const std::vector<double>& angles) {
    double out = 360.0;
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) out = std::min(out, angles[i + 1] - angles[i]);
    return out;
}

/// Half the file's finest step, as far as a table of reasonable size has it.
double conversion_step_deg(const FileWeb& web) {
    const double finest = std::min(finest_step(web.horizontal_deg), finest_step(web.vertical_deg));
    return finest >= 2.0 ? 1.0 : finest >= 1.0 ? 0.5 : 0.25;
}

}  // namespace

void expand_type_c(const FileWeb& web, Diagnostics& diagnostics, PhotometricProfile& profile) {
    check_vertical(web, diagnostics);
    check_poles(web, diagnostics);
    const Reach reach = reach_of(web, diagnostics);
    const std::vector<HalfPlane> planes = half_planes(web, reach);
    const Rows rows = rows_of(web);
    const std::size_t stride = web.vertical_deg.size();
    profile.symmetry = reach.symmetry;
    profile.vertical_deg = rows.vertical_deg;
    profile.horizontal_deg.clear();
    profile.candela.clear();
    profile.candela.reserve((planes.size() + 2) * rows.source.size());
    const auto value = [&](std::size_t plane, std::size_t row) {
        return rows.source[row] ? web.candela[plane * stride + *rows.source[row]] : 0.0;
    };
    // Half-planes a and b, b taken `share`.
    const auto add = [&](double c_deg, std::size_t a, std::size_t b, double share) {
        profile.horizontal_deg.push_back(c_deg);
        for (std::size_t row = 0; row < rows.source.size(); ++row)
            profile.candela.push_back(float(std::lerp(value(a, row), value(b, row), share)));
    };
    const HalfPlane first = planes.front(), last = planes.back();
    const bool starts_at_0 = planes.size() == 1 || same(first.c_deg, 0.0);
    // A web of 90 to 270 degrees need not have 180, whose mirror is 0.
    const double share = starts_at_0 ? 1.0 : (360.0 - last.c_deg) / (first.c_deg + 360.0 - last.c_deg);
    add(0.0, last.source, first.source, share);
    for (std::size_t i = starts_at_0 ? 1 : 0; i < planes.size(); ++i)
        add(planes[i].c_deg, planes[i].source, planes[i].source, 0.0);
    add(360.0, last.source, first.source, share);
}

void convert_type_a_or_b(const FileWeb& web, Diagnostics& diagnostics, PhotometricProfile& profile) {
    if (web.horizontal_deg.size() < 2 || web.vertical_deg.size() < 2)
        throw input_error("types A and B need at least two angles of each kind", web.where);
    for (const auto* angles : {&web.horizontal_deg, &web.vertical_deg}) {
        if (angles->front() < -180.0 - kSameAngle_deg || angles->back() > 180.0 + kSameAngle_deg)
            throw input_error("angles of types A and B are between -180 and 180", web.where);
        if (!same(angles->front(), 0.0) && !same(angles->front(), -angles->back()))
            diagnostics.warn(web.where + ": angles only from " + degrees(angles->front()) + " to " +
                             degrees(angles->back()) + "; dark elsewhere");
    }
    const ViewedWeb viewed(web);
    const double step = conversion_step_deg(web);
    // Most of these webs end at 90 degrees: then the whole of one is in front, and the edge is no cell wide.
    const bool type_a = profile.type == scene::PhotometricType::a;
    const std::vector<double>& around = type_a ? web.horizontal_deg : web.vertical_deg;
    const bool in_front = around.back() <= 90.0 + kSameAngle_deg && around.front() >= -90.0 - kSameAngle_deg;
    FileWeb c;
    c.where = web.where;
    for (int i = 0; i * step <= (in_front ? 90.0 : 180.0); ++i) c.vertical_deg.push_back(i * step);
    for (int i = 0; i * 2.0 * step <= 360.0; ++i) c.horizontal_deg.push_back(i * 2.0 * step);
    for (const double c_deg : c.horizontal_deg) {
        for (const double gamma_deg : c.vertical_deg) {
            const glm::vec3 direction =
                shading::photometric_direction(float(c_deg * kDegree), float(gamma_deg * kDegree));
            const glm::vec2 angles = type_a ? shading::photometric_angles_type_a(direction)
                                            : shading::photometric_angles_type_b(direction);
            c.candela.push_back(viewed(double{angles.x} / kDegree, double{angles.y} / kDegree));
        }
    }
    expand_type_c(c, diagnostics, profile);
    profile.symmetry = viewed.symmetry();
}

}  // namespace candela::io::detail
