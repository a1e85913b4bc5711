// From camera settings or a metered luminance to the factor that brings luminance to [0,1] of the sensor.
// Source: Lagarde & de Rousiers 2014 ("Frostbite"), sections 4.3 and 5.1; ISO 2720 (meters), ISO 12232
// (saturation-based speed).
#ifndef CANDELA_EXPOSURE_GLSL
#define CANDELA_EXPOSURE_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Reflected-light meter calibration, cd/m^2 s ISO: what Canon, Nikon and Sekonic use (Frostbite section 4.3).
CONSTANT float kReflectedMeterK = 12.5f;
// Incident-light meter calibration of a flat receptor, lx s ISO: ISO 2720 allows 240 to 400; 250 is in common
// use.
CONSTANT float kIncidentMeterC = 250.0f;
// Lens transmission, vignetting and geometry between scene luminance and sensor illuminance
// (Frostbite 5.1.2).
CONSTANT float kLensAttenuation = 0.65f;
// Luminous exposure in lx s that just saturates a sensor of ISO 1 (ISO 12232; Frostbite equation 72).
CONSTANT float kSaturationExposure = 78.0f;

// Frostbite equation 67. aperture_f: N of f/N, > 0; shutter_s: seconds, > 0; iso: arithmetic speed, > 0.
FN float ev100_from_camera(float aperture_f, float shutter_s, float iso) {
    return log2(aperture_f * aperture_f / shutter_s * (100.0f / iso));
}

// Frostbite equation 69 with S = 100: the exposure value at which a spot meter puts this average luminance.
// luminance_nit > 0; zero gives -infinity.
FN float ev100_from_luminance(float luminance_nit) {
    return log2(luminance_nit * (100.0f / kReflectedMeterK));
}

// Frostbite equation 12 (its Table 7), the inverse of ev100_from_luminance; cd/m^2.
FN float luminance_from_ev100(float ev100) {
    return (kReflectedMeterK / 100.0f) * exp2(ev100);
}

// An incident-light meter held at the subject (ISO 2720): E = C / S * 2^EV. illuminance_lx > 0.
FN float ev100_from_illuminance(float illuminance_lx) {
    return log2(illuminance_lx * (100.0f / kIncidentMeterC));
}

// Inverse of ev100_from_illuminance; lx.
FN float illuminance_from_ev100(float ev100) {
    return (kIncidentMeterC / 100.0f) * exp2(ev100);
}

// Frostbite equation 68: a positive compensation in stops brightens the picture.
FN float ev100_compensated(float ev100, float compensation_ev) {
    return ev100 - compensation_ev;
}

// Luminance in cd/m^2 that just saturates the sensor: Frostbite equation 75 with N^2/t * 100/S = 2^EV100,
// that is 78 / (100 * 0.65) * 2^EV100 = 1.2 * 2^EV100.
FN float max_luminance_from_ev100(float ev100) {
    return kSaturationExposure / (100.0f * kLensAttenuation) * exp2(ev100);
}

// The factor from cd/m^2 to exposed values, 1 = saturation (Frostbite listing 28).
FN float exposure_from_ev100(float ev100) {
    return 1.0f / max_luminance_from_ev100(ev100);
}

// Inverse of exposure_from_ev100. exposure in m^2/cd, > 0.
FN float ev100_from_exposure(float exposure) {
    return log2(100.0f * kLensAttenuation / (kSaturationExposure * exposure));
}

// What a meter's reading is displayed as, linear: an 18 % grey card that is metered alone comes out as 18 % of white, the
// sRGB code value 118 that ISO 12232 defines standard output sensitivity by (461/1000 of full scale).
CONSTANT float kMeteredGrey = 0.18f;

// The factor from cd/m^2 to exposed values by standard output: the luminance that a reflected-light meter reads at this
// exposure value (K = 12.5) gives kMeteredGrey. 0.79 stops more than exposure_from_ev100, which leaves half a stop of
// headroom above the 12.7 % of a saturation-based speed.
FN float standard_output_exposure(float ev100) {
    return kMeteredGrey / luminance_from_ev100(ev100);
}

// Inverse of standard_output_exposure. exposure in m^2/cd, > 0.
FN float ev100_from_standard_output(float exposure) {
    return ev100_from_luminance(kMeteredGrey / exposure);
}

// Illuminance in lx on the sensor behind a lens at f/N that sees luminance_nit (Frostbite equations 70 and
// 71).
FN float sensor_illuminance(float luminance_nit, float aperture_f) {
    return kLensAttenuation * luminance_nit / (aperture_f * aperture_f);
}

// Luminous exposure H in lx s (Frostbite equation 70).
FN float luminous_exposure(float luminance_nit, float aperture_f, float shutter_s) {
    return shutter_s * sensor_illuminance(luminance_nit, aperture_f);
}

CANDELA_SHADING_END

#endif
