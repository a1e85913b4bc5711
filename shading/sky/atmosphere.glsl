// The air of a clear sky: what is in it, how it scatters and the geometry of rays through it. Altitudes are above sea
// level, distances along a ray; mu is the cosine to the local vertical. Bands are those of spectrum.glsl.
// The model is that of Hillaire 2020 ("A Scalable and Production Ready Sky and Atmosphere Rendering Technique") and
// Bruneton & Neyret 2008: air, aerosol and ozone over a spherical ground. Changed: the air has the densities of the
// standard atmosphere instead of one exponential (it is twice too dense at 50 km, where twilight comes from), and
// wavelengths are 16 instead of 3.
#ifndef CANDELA_SKY_ATMOSPHERE_GLSL
#define CANDELA_SKY_ATMOSPHERE_GLSL

#include "spectrum.glsl"

CANDELA_SHADING_BEGIN

CONSTANT float kEarthRadius_m = 6.371e6f;
CONSTANT float kAirTop_m = 1.0e5f;
CONSTANT float kSunAngularRadius_rad = 0.00465f;

// ln of the air's density over that at sea level every 5 km: US Standard Atmosphere 1976.
CONSTANT float kAirLogDensityStep_m = 5000.0f;
CONSTANT float kAirLogDensity[21] = {0.0f,      -0.5089f,  -1.0860f,  -1.8389f,  -2.6231f,  -3.4197f,  -4.1978f,
                                     -4.9749f,  -5.7255f,  -6.4345f,  -7.0842f,  -7.6762f,  -8.2829f,  -8.9234f,
                                     -9.6017f,  -10.3315f, -11.1030f, -11.9119f, -12.7900f, -13.6870f, -14.5976f};
// Metres of air of sea level's density that weigh as much: the integral of the above.
CONSTANT float kAirColumn_m = 8404.07f;
// Elterman's aerosol falls to 1/e in 1.2 km (Bruneton & Neyret 2008, section 4).
CONSTANT float kAerosolColumn_m = 1200.0f;
// Ozone: from 0 at 10 km to its most at 25 km and back to 0 at 40 km (Bruneton 2017).
CONSTANT float kOzoneBottom_m = 10000.0f;
CONSTANT float kOzoneColumn_m = 15000.0f;
// Molecules over a square metre in a Dobson unit.
CONSTANT float kDobsonUnit = 2.687e20f;

// Continental average aerosol at 550 nm and 80 % humidity: Hess, Koepke & Schult 1998 (OPAC), Table 4.
CONSTANT float kAerosolAlbedo = 0.925f;
CONSTANT float kAerosolAsymmetry = 0.703f;

// The share of aerosol's scattering that counts as none (scattering.glsl). Delta-Eddington's is the asymmetry squared,
// 0.49; 0.3 is nearer to random walks near a low sun and in twilight (candela validate --only hillaire2020_sky).
CONSTANT float kForwardShare = 0.3f;
CONSTANT float kNarrowedAsymmetry = (kAerosolAsymmetry - kForwardShare) / (1.0f - kForwardShare);

// Density of air, aerosol (over that at sea level) and ozone (over its most).
FN vec3 sky_density(float altitude_m) {
    float level = clamp(altitude_m / kAirLogDensityStep_m, 0.0f, 19.9999f);
    int below = int(level);
    float air = exp(mix(kAirLogDensity[below], kAirLogDensity[below + 1], level - float(below)));
    float ozone = max(1.0f - abs(altitude_m - kOzoneBottom_m - kOzoneColumn_m) / kOzoneColumn_m, 0.0f);
    return vec3(altitude_m < kAirTop_m ? air : 0.0f, exp(-max(altitude_m, 0.0f) / kAerosolColumn_m), ozone);
}

// Altitude at a distance along a ray that starts at altitude_m with this mu. The difference is a product because radii
// of 6.4e6 m leave half a metre of single precision.
FN float sky_altitude_at(float altitude_m, float mu, float distance_m) {
    float r = kEarthRadius_m + altitude_m;
    float growth = distance_m * (2.0f * r * mu + distance_m);
    return altitude_m + growth / (sqrt(max(square(r) + growth, 0.0f)) + r);
}

// mu of the horizon.
FN float sky_horizon_mu(float altitude_m) {
    float r = kEarthRadius_m + altitude_m;
    return -sqrt(max(altitude_m * (2.0f * kEarthRadius_m + altitude_m), 0.0f)) / r;
}

// Distance to where a ray leaves the air.
FN float sky_distance_to_top(float altitude_m, float mu) {
    float b = (kEarthRadius_m + altitude_m) * mu;
    float c = (altitude_m - kAirTop_m) * (2.0f * kEarthRadius_m + altitude_m + kAirTop_m);
    float root = sqrt(max(square(b) - c, 0.0f));
    return b > 0.0f ? -c / (b + root) : root - b;
}

// Distance to the ground of a ray with mu at or below the horizon's.
FN float sky_distance_to_ground(float altitude_m, float mu) {
    float b = -(kEarthRadius_m + altitude_m) * mu;
    float c = altitude_m * (2.0f * kEarthRadius_m + altitude_m);
    return b > 0.0f ? c / (b + sqrt(max(square(b) - c, 0.0f))) : 0.0f;
}

// Lowest altitude on a ray that falls (mu < 0) and misses the ground, and the distance to it.
FN vec2 sky_tangent(float altitude_m, float mu) {
    float r = kEarthRadius_m + altitude_m;
    float lowest = altitude_m - r * square(mu) / (1.0f + sqrt(max(1.0f - square(mu), 0.0f)));
    return vec2(max(lowest, 0.0f), -r * mu);
}

// Metres of air, aerosol and ozone of density 1 along a ray that does not fall, to the top. Steps grow with the square
// of their number, as the densities fall.
FN vec3 sky_rising_columns_m(float altitude_m, float mu) {
    const int steps = 64;
    float length_m = sky_distance_to_top(altitude_m, mu);
    vec3 sum = vec3(0.0f);
    for (int i = 0; i < steps; ++i) {
        float u = (float(i) + 0.5f) / float(steps);
        sum += u * sky_density(sky_altitude_at(altitude_m, mu, length_m * square(u)));
    }
    return sum * (2.0f * length_m / float(steps));
}

// The same for every ray that misses the ground: a falling one is the ray through its lowest point, both ways, less the
// part behind the start.
FN vec3 sky_columns_m(float altitude_m, float mu) {
    if (mu >= 0.0f) return sky_rising_columns_m(altitude_m, mu);
    vec2 tangent = sky_tangent(altitude_m, mu);
    return max(2.0f * sky_rising_columns_m(tangent.x, 0.0f) - sky_rising_columns_m(altitude_m, -mu), vec3(0.0f));
}

// Share of the sun's disc above the horizon where the sun's centre has this mu: the segment of a circle.
FN float sun_visible_share(float altitude_m, float sun_mu) {
    float x = (sun_mu - sky_horizon_mu(altitude_m)) / kSunAngularRadius_rad;
    if (abs(x) >= 1.0f) return x > 0.0f ? 1.0f : 0.0f;
    float chord = sqrt(1.0f - square(x));
    return 0.5f + (x * chord + atan(x, chord)) * INV_PI;
}

// Rayleigh's phase function for air, 1/sr, with its anisotropy gamma = 0.0144: Bucholtz 1995, equation 12 and Table 2.
FN float rayleigh_phase(float cosine) {
    const float gamma = 0.01442f;
    return 3.0f / (16.0f * PI * (1.0f + 2.0f * gamma)) * ((1.0f + 3.0f * gamma) + (1.0f - gamma) * square(cosine));
}

// Henyey & Greenstein 1941, 1/sr.
FN float henyey_greenstein_phase(float cosine, float g) {
    float d = max(1.0f + square(g) - 2.0f * g * cosine, 1.0e-6f);
    return (1.0f - square(g)) / (4.0f * PI * d * sqrt(d));
}

FN float aerosol_phase(float cosine) {
    return henyey_greenstein_phase(cosine, kAerosolAsymmetry);
}

// exp(x) for x <= 0 within 3e-7 of 1, of +, * and a shift alone, so that compilers do many bands at once. The
// polynomial is the series of 2^f on [-1/2, 1/2].
FN float exp_of_negative(float x) {
    float y = max(x * 1.44269504f, -125.0f);
    int whole = int(y - 0.5f);
    float f = (y - float(whole)) * 0.69314718f;
    float p = 1.0f + f * (1.0f + f * (0.5f + f * (0.16666667f + f * (0.041666667f + f * (0.0083333333f + f * 0.0013888889f)))));
    return p * uintBitsToFloat(uint(whole + 127) << 23);
}

// What the air does to light of each band, per metre at density 1.
struct SkyAtmosphere {
    SkyBands air_scattering;
    SkyBands aerosol_scattering;
    SkyBands aerosol_extinction;
    SkyBands ozone_absorption;
    SkyBands narrowed_scattering;  // aerosol's without the forward share
    SkyBands narrowed_extinction;
    vec3 rec709_lx[16];  // of unattenuated sunlight at normal incidence, at 1 astronomical unit
    float ground_albedo;
};

// Each band's coefficients are means over its bins, weighted by what the observer sees of sunlight in them.
FN void sky_atmosphere(float turbidity, float ozone_du, float ground_albedo, OUT(SkyAtmosphere) air) {
    SkyBands weight;
    for (int b = 0; b < kSkyBands; ++b) {
        weight.of[b] = 0.0f;
        air.air_scattering.of[b] = 0.0f;
        air.aerosol_extinction.of[b] = 0.0f;
        air.ozone_absorption.of[b] = 0.0f;
        air.rec709_lx[b] = vec3(0.0f);
    }
    for (int bin = 0; bin < kSkyBins; ++bin) {
        int b = sky_band_of_bin(bin);
        float um = sky_bin_center_um(bin);
        vec3 xyz_lx = sky_bin_xyz_lx(bin);
        float w = xyz_lx.x + xyz_lx.y + xyz_lx.z;
        weight.of[b] += w;
        air.air_scattering.of[b] += w * rayleigh_optical_depth(um) / kAirColumn_m;
        air.aerosol_extinction.of[b] += w * aerosol_optical_depth(um, turbidity) / kAerosolColumn_m;
        air.ozone_absorption.of[b] += w * kOzoneCrossSection[bin] * (1.0e-26f * kDobsonUnit) * ozone_du / kOzoneColumn_m;
        air.rec709_lx[b] += rec709_from_xyz(xyz_lx);
    }
    for (int b = 0; b < kSkyBands; ++b) {
        air.air_scattering.of[b] /= weight.of[b];
        air.aerosol_extinction.of[b] /= weight.of[b];
        air.ozone_absorption.of[b] /= weight.of[b];
        air.aerosol_scattering.of[b] = kAerosolAlbedo * air.aerosol_extinction.of[b];
        air.narrowed_scattering.of[b] = (1.0f - kForwardShare) * air.aerosol_scattering.of[b];
        air.narrowed_extinction.of[b] = air.aerosol_extinction.of[b] - kForwardShare * air.aerosol_scattering.of[b];
    }
    air.ground_albedo = ground_albedo;
}

// Optical depth of columns (or, of densities, the extinction per metre) by coefficients per metre at density 1.
FN float sky_optical_depth(float air, float aerosol, float ozone, vec3 columns_m) {
    return air * columns_m.x + aerosol * columns_m.y + ozone * columns_m.z;
}

// Share of each band that passes these columns.
FN SkyBands sky_transmittance(SkyAtmosphere air, vec3 columns_m) {
    SkyBands t;
    for (int b = 0; b < kSkyBands; ++b)
        t.of[b] = exp_of_negative(-sky_optical_depth(air.air_scattering.of[b], air.aerosol_extinction.of[b],
                                                     air.ozone_absorption.of[b], columns_m));
    return t;
}

// Linear Rec.709 of shares of sunlight: lx, or cd/m^2 where the shares are per sr. Channels can be negative: the light
// of a low sun lies outside the gamut.
FN vec3 sky_rec709(SkyAtmosphere air, SkyBands shares) {
    vec3 sum = vec3(0.0f);
    for (int b = 0; b < kSkyBands; ++b) sum += shares.of[b] * air.rec709_lx[b];
    return sum;
}

CANDELA_SHADING_END

#endif
