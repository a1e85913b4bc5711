#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// What a photometric file says about a luminaire: its luminous intensity in every direction, and what it is.
///
/// The luminaire's frame (shading/lights/photometric.glsl) is that of its glTF node: gamma = 0, the aim, is
/// -Z; the half-plane C0 holds +X, C90 holds +Y.
namespace candela::scene {

enum class PhotometricFormat : std::uint8_t { ies, eulumdat };

/// How the file's own angles are meant. The web of a profile is type C whatever this says.
enum class PhotometricType : std::uint8_t { c, b, a };

/// What the file left out and the web has again.
enum class PhotometricSymmetry : std::uint8_t {
    none,
    axial,           ///< the same in all half-planes
    plane_c0_c180,   ///< C and 360 - C alike
    plane_c90_c270,  ///< C and 180 - C alike
    both_planes
};

/// Lamps that a luminaire is fitted with; EULUMDAT may list alternatives.
struct PhotometricLamps {
    int count = 1;
    std::string type;
    std::optional<double> flux_lm;  ///< of all of them together; none: absolute photometry in IES files
    std::optional<double> power_w;  ///< with ballast
    std::optional<double> temperature_kelvin;
    std::string color;            ///< as the file has it: "3000", "840", "warm white"
    std::string color_rendering;  ///< as the file has it
};

/// How a lamp that minds its burning position dims when the luminaire is tilted. Empty: not at all.
struct PhotometricTilt {
    int lamp_to_luminaire_geometry = 1;  ///< 1 lamp vertical at tilt 0, 2 and 3 lamp horizontal (LM-63)
    std::vector<double> angles_deg;      ///< ascending
    std::vector<double> factors;
};

struct PhotometricProfile {
    std::string name;

    /// The web, type C, whole: vertical_deg ascends from 0 to 180, horizontal_deg from 0 to 360, whose
    /// half-plane is that of 0 again. Two equal vertical angles are a jump, as at the edge of a web that says
    /// nothing above the horizon. Intensity in cd as emitted: multipliers, ballast factors and lamp flux are
    /// in it.
    std::vector<double> vertical_deg;
    std::vector<double> horizontal_deg;
    std::vector<float> candela;  ///< [horizontal * vertical_deg.size() + vertical]

    PhotometricFormat format = PhotometricFormat::ies;
    std::string standard;  ///< "LM-63-2002", "EULUMDAT"
    PhotometricType type = PhotometricType::c;
    PhotometricSymmetry symmetry = PhotometricSymmetry::none;
    bool absolute = false;  ///< photometry of the luminaire, not relative to its lamps' flux
    std::vector<PhotometricLamps> lamp_sets;     ///< alternatives; never empty
    std::size_t lamp_set = 0;                    ///< the one that the web is for
    double multiplier = 1.0;                     ///< IES candela multiplier, EULUMDAT conversion factor
    double ballast_factor = 1.0;                 ///< IES
    double ballast_lamp_factor = 1.0;            ///< IES before 2002
    std::optional<double> light_output_ratio;    ///< EULUMDAT LORL, 0 to 1
    std::optional<double> downward_fraction;     ///< EULUMDAT DFF, 0 to 1
    std::optional<double> measurement_tilt_deg;  ///< EULUMDAT
    PhotometricTilt tilt;                        ///< IES
    /// Luminous opening along C0 (x), along C90 (y) and upwards (z); a round one has x = y and `round`.
    glm::dvec3 opening_m{0.0};
    bool round = false;
    std::optional<glm::dvec3> housing_m;  ///< EULUMDAT, same axes
    /// Keywords of the file in its order: [MANUFAC] of IES as "MANUFAC", the named lines of EULUMDAT.
    std::vector<std::pair<std::string, std::string>> keywords;
};

/// Luminous intensity towards `direction` (luminaire's frame, any length but zero): bilinear in the angles.
[[nodiscard]] double intensity_cd(const PhotometricProfile& profile, const glm::vec3& direction);
/// The same from type C angles in degrees: C of any turn, gamma in [0, 180].
[[nodiscard]] double intensity_cd(const PhotometricProfile& profile, double c_deg, double gamma_deg);

/// The integral of intensity_cd over all directions, in closed form, so no more of an approximation than the
/// interpolation is.
[[nodiscard]] double integrated_lm(const PhotometricProfile& profile);
/// Its part below the horizon (gamma < 90).
[[nodiscard]] double downward_lm(const PhotometricProfile& profile);

/// What the file itself says the luminaire gives: the lamps' flux times ballast factor and light output
/// ratio, as far as they are stated. None for absolute IES photometry.
[[nodiscard]] std::optional<double> stated_lm(const PhotometricProfile& profile);

struct PhotometricPeak {
    double candela = 0.0;
    double c_deg = 0.0;
    double gamma_deg = 0.0;
};
/// The largest intensity; of equal ones the lowest gamma, then the lowest C.
[[nodiscard]] PhotometricPeak peak(const PhotometricProfile& profile);

/// The smallest full angle in degrees, in the plane of C and C + 180, that holds every direction of at least
/// a fraction of that plane's largest intensity. None where the plane is dark or never falls so low.
struct PhotometricSpread {
    std::optional<double> c0_c180_deg;
    std::optional<double> c90_c270_deg;
};
[[nodiscard]] PhotometricSpread spread(const PhotometricProfile& profile, double fraction);
[[nodiscard]] inline PhotometricSpread beam_angle(const PhotometricProfile& profile) {
    return spread(profile, 0.5);
}
[[nodiscard]] inline PhotometricSpread field_angle(const PhotometricProfile& profile) {
    return spread(profile, 0.1);
}

/// What a luminaire whose lamp dims with its position gives when the aim is `tilt_deg` off straight down; 1
/// without TILT data. The web is for a factor of 1.
[[nodiscard]] double tilt_factor(const PhotometricProfile& profile, double tilt_deg);

/// Size of a table for shading/lights/photometric.glsl.
struct PhotometricGrid {
    int width = 1;  ///< 1: the same in all half-planes
    int height = 2;
};
/// The smallest table whose nodes meet every angle of all the profiles, so that interpolating it is
/// interpolating the files; the largest that is allowed where there is none.
[[nodiscard]] PhotometricGrid fitting_grid(std::span<const PhotometricProfile> profiles, int max_width = 720,
                                           int max_height = 721);
[[nodiscard]] inline PhotometricGrid fitting_grid(const PhotometricProfile& profile) {
    return fitting_grid(std::span(&profile, 1));
}

/// The web in cd as a regular table (layout: shading/lights/photometric.glsl), row after row from gamma = 0.
/// Along an axis where every angle of the profile is a node of the table, its nodes are the web's values and
/// the interpolated table is the interpolated web. Along another the web is projected: each node is the mean
/// of the web under its hat function (weighted by solid angle), which keeps the lumens to rounding and blurs
/// by one cell.
[[nodiscard]] std::vector<float> resample(const PhotometricProfile& profile, int width, int height);

}  // namespace candela::scene
