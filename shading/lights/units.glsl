// Luminous power (lm) to and from luminous intensity (cd) or luminance (cd/m^2), for each shape of light.
// Source: Lagarde & de Rousiers 2014 ("Frostbite"), Tables 8, 9 and 12. Cones are given by their half angle,
// as KHR_lights_punctual does; Frostbite's theta_outer is the whole angle.
#ifndef CANDELA_LIGHTS_UNITS_GLSL
#define CANDELA_LIGHTS_UNITS_GLSL

#include "../language.glsl"
#include "../photometry.glsl"

CANDELA_SHADING_BEGIN

// Table 9, point: the same intensity over the whole sphere (equation 15).
FN float point_cd_from_lm(float power_lm) {
    return power_lm / (4.0f * PI);
}
FN float point_lm_from_cd(float intensity_cd) {
    return 4.0f * PI * intensity_cd;
}

// Table 9, spot, Frostbite's convention (equation 17): the reflector absorbs what leaves the cone, so
// intensity does not depend on the cone.
FN float spot_cd_from_lm(float power_lm) {
    return power_lm * INV_PI;
}
FN float spot_lm_from_cd(float intensity_cd) {
    return PI * intensity_cd;
}

// Solid angle in sr of a cone: 2 pi (1 - cos h) as 4 pi sin^2(h/2), which keeps its digits for narrow beams.
FN float cone_solid_angle(float half_angle_rad) {
    return 4.0f * PI * square(sin(0.5f * half_angle_rad));
}

// Table 9, spot, exact: all power within a cone of sharp edge (equation 16). outer_cone_rad: half angle in
// (0, pi].
FN float spot_cd_from_lm_exact(float power_lm, float outer_cone_rad) {
    return power_lm / cone_solid_angle(outer_cone_rad);
}
FN float spot_lm_from_cd_exact(float intensity_cd, float outer_cone_rad) {
    return intensity_cd * cone_solid_angle(outer_cone_rad);
}

// What a spot with the smooth edge of angle_attenuation() really emits: the squared ramp in cos integrates to
// a third of the solid angle between the cones. Half angles, inner <= outer.
FN float spot_lm_from_cd_smooth(float intensity_cd, float inner_cone_rad, float outer_cone_rad) {
    float inner_sr = cone_solid_angle(inner_cone_rad);
    return intensity_cd * (inner_sr + (cone_solid_angle(outer_cone_rad) - inner_sr) / 3.0f);
}

// A line light, a diffuse cylinder too thin to have a width: intensity falls from what it is perpendicular to the axis,
// intensity_cd, with the sine of the angle to the axis; over the sphere that is pi^2. Own derivation; Frostbite has none.
FN float line_cd_from_lm(float power_lm) {
    return power_lm * INV_PI * INV_PI;
}
FN float line_lm_from_cd(float intensity_cd) {
    return PI * PI * intensity_cd;
}

// The sun as a disc of an angular diameter: luminance from the illuminance at normal incidence. Frostbite section 4.6
// divides by the solid angle; a disc's projected solid angle pi sin^2 of the half angle, which is exact, is 5e-6 less.
FN float sun_solid_angle(float angular_diameter_rad) {
    return cone_solid_angle(0.5f * angular_diameter_rad);
}
FN float sun_projected_solid_angle(float angular_diameter_rad) {
    return PI * square(sin(0.5f * angular_diameter_rad));
}
FN float sun_nit_from_lx(float illuminance_lx, float angular_diameter_rad) {
    return illuminance_lx / sun_projected_solid_angle(angular_diameter_rad);
}
FN float sun_lx_from_nit(float luminance_nit, float angular_diameter_rad) {
    return luminance_nit * sun_projected_solid_angle(angular_diameter_rad);
}

// Solid angle in sr of a rectangular pyramid with full opening angles angle_a_rad and angle_b_rad, each in
// (0, pi].
// The arc sine of Table 9 is taken as an arc tangent, for drivers whose asin is good to 1e-3 only (Mesa's).
FN float frustum_solid_angle(float angle_a_rad, float angle_b_rad) {
    float s = sin(0.5f * angle_a_rad) * sin(0.5f * angle_b_rad);
    return 4.0f * atan(s, sqrt(max(1.0f - s * s, 0.0f)));
}

// Table 9, frustum.
FN float frustum_cd_from_lm(float power_lm, float angle_a_rad, float angle_b_rad) {
    return power_lm / frustum_solid_angle(angle_a_rad, angle_b_rad);
}
FN float frustum_lm_from_cd(float intensity_cd, float angle_a_rad, float angle_b_rad) {
    return intensity_cd * frustum_solid_angle(angle_a_rad, angle_b_rad);
}

// Emitting areas in m^2. A tube is a capsule: a cylinder of width_m between the centres of two half spheres.
// Disks and rectangles emit from one side.
FN float sphere_area(float radius_m) {
    return 4.0f * PI * square(radius_m);
}
FN float disk_area(float radius_m) {
    return PI * square(radius_m);
}
FN float tube_area(float radius_m, float width_m) {
    return 2.0f * PI * radius_m * width_m + 4.0f * PI * square(radius_m);
}
FN float rectangle_area(float width_m, float height_m) {
    return width_m * height_m;
}

// Table 12.
FN float sphere_nit_from_lm(float power_lm, float radius_m) {
    return nit_from_lm_area(power_lm, sphere_area(radius_m));
}
FN float sphere_lm_from_nit(float luminance_nit, float radius_m) {
    return lm_from_nit_area(luminance_nit, sphere_area(radius_m));
}
FN float disk_nit_from_lm(float power_lm, float radius_m) {
    return nit_from_lm_area(power_lm, disk_area(radius_m));
}
FN float disk_lm_from_nit(float luminance_nit, float radius_m) {
    return lm_from_nit_area(luminance_nit, disk_area(radius_m));
}
FN float tube_nit_from_lm(float power_lm, float radius_m, float width_m) {
    return nit_from_lm_area(power_lm, tube_area(radius_m, width_m));
}
FN float tube_lm_from_nit(float luminance_nit, float radius_m, float width_m) {
    return lm_from_nit_area(luminance_nit, tube_area(radius_m, width_m));
}
FN float rectangle_nit_from_lm(float power_lm, float width_m, float height_m) {
    return nit_from_lm_area(power_lm, rectangle_area(width_m, height_m));
}
FN float rectangle_lm_from_nit(float luminance_nit, float width_m, float height_m) {
    return lm_from_nit_area(luminance_nit, rectangle_area(width_m, height_m));
}

// What a shape of uniform luminance shows of itself from afar, in m^2: times the luminance, its intensity in cd.
// Sphere and disk (along its axis): disk_area(); rectangle: rectangle_area(). A tube, across its axis:
FN float tube_projected_area(float radius_m, float width_m) {
    return 2.0f * radius_m * width_m + PI * square(radius_m);
}

// Illuminance in lx on a surface that faces the light, distance_m from its centre (outside of it): the
// luminance times the projected solid angle, which is closed for these two (Frostbite section 4.7.2).
FN float sphere_lx_from_nit(float luminance_nit, float radius_m, float distance_m) {
    return luminance_nit * PI * square(radius_m / distance_m);
}
FN float disk_lx_from_nit(float luminance_nit, float radius_m, float distance_m) {
    return luminance_nit * PI * square(radius_m) / (square(radius_m) + square(distance_m));
}

CANDELA_SHADING_END

#endif
