#include "candela/measure/numerics.hpp"

namespace candela::measure::experiments {
namespace {

constexpr double kPower = 40.0;
constexpr double kHalfAngle_rad = 0.35;  ///< of the sphere

/// Equation 12.
double point(double phi_rad) {
    return (kPower + 2.0) / (2.0 * kPi) * std::pow(std::max(std::cos(phi_rad), 0.0), kPower);
}
/// Equation 13: the same from the sphere's edge on.
double widened(double phi_rad) {
    return point(std::max(phi_rad - kHalfAngle_rad, 0.0));
}

/// Integral over the hemisphere times the cosine to its axis, which equation 12's factor makes 1.
template <class F>
double energy(F f) {
    return 2.0 * kPi *
           integrate([&](double phi) { return f(phi) * std::cos(phi) * std::sin(phi); }, 0.0, 0.5 * kPi, 256);
}

Findings run() {
    const auto angles_deg = linspace(-60.0, 60.0, 241);
    const auto at = [](auto f) { return [f](double deg) { return f(std::abs(deg) * kPi / 180.0); }; };
    Findings out;
    out.plots = {{"Widening by a sphere",
                  "Power 40, a sphere of half angle 20 degrees.",
                  {"angle between mirror direction and the light's centre, degrees", -60.0, 60.0},
                  {"lobe"},
                  {curve("point light (12)", angles_deg, at(point)),
                   curve("sphere light (13)", angles_deg, at(widened), Stroke::dashed)}}};
    out.measured = {within("energy of the point light's lobe", energy(point), 0.999, 1.001),
                    within("energy of the sphere light's lobe", energy(widened), 5.6, 5.8)};
    out.text = "Moving the light to the nearest point of the sphere multiplies the energy of this lobe by " +
               number(energy(widened), 3) + "; equation 14 is there to take it back.";
    return out;
}

}  // namespace

Experiment karis2013_figure11() {
    return {"Karis 2013", "Figure 11", "What the representative point does to the lobe",
            "The normalized Phong lobe of equation 12 and the widened one of equation 13, with their "
            "energies by quadrature.",
            run};
}

}  // namespace candela::measure::experiments
