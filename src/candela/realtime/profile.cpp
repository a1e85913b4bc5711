#include "candela/realtime/profile.hpp"

#include <array>
#include <cstdio>
#include <functional>

#include "candela/scene/error.hpp"

namespace candela::realtime {
namespace {

constexpr std::string_view kFalloffOffset = "falloff-offset-m2";

/// One slot of a profile: its name, the names of its techniques in the order of the enumeration, and access
/// to it.
struct Slot {
    std::string_view name;
    std::vector<std::string_view> techniques;
    std::function<std::uint8_t(const Profile&)> get;
    std::function<void(Profile&, std::uint8_t)> set;
};

template <class Technique>
Slot slot(std::string_view name, Technique Profile::*member, std::vector<std::string_view> techniques) {
    return {name, std::move(techniques),
            [member](const Profile& p) { return static_cast<std::uint8_t>(p.*member); },
            [member](Profile& p, std::uint8_t value) { p.*member = static_cast<Technique>(value); }};
}

std::vector<Slot> slots() {
    return {slot("diffuse", &Profile::diffuse, {"lambert", "disney", "disney-renormalized"}),
            slot("visibility", &Profile::visibility,
                 {"smith-correlated", "schlick-smith", "schlick-smith-half-alpha", "teaching-page"}),
            slot("fresnel", &Profile::fresnel, {"schlick", "spherical-gaussian", "schlick-micro-occlusion"}),
            slot("energy", &Profile::energy, {"none", "compensated"}),
            slot("dfg", &Profile::dfg, {"table", "env-brdf-approx", "env-brdf-nonmetal"}),
            slot("fully-rough", &Profile::fully_rough, {"none", "per-material", "roughness-1", "all"}),
            slot("sun-specular", &Profile::sun_specular, {"full", "d-approx", "d-approx-printed"}),
            slot("reflection", &Profile::reflection,
                 {"mirror-direction", "dominant-direction", "dominant-direction-fit", "fitted-direction",
                  "stretched-2", "stretched-3"}),
            slot("irradiance", &Profile::irradiance, {"normal", "dominant-direction"}),
            slot("specular-aa", &Profile::specular_aa, {"none", "footprint"}),
            slot("normal-map-filter", &Profile::normal_map_filter, {"convolved", "average-length"}),
            slot("area-diffuse", &Profile::area_diffuse,
                 {"exact", "structured-sampling", "form-factor", "most-representative-point",
                  "most-representative-point-drobot", "light-position", "five-times"}),
            slot("area-direction", &Profile::area_direction, {"representative-point", "light-position"}),
            slot("area-specular", &Profile::area_specular,
                 {"ltc", "representative-point", "dominant-direction", "specular-d-widening",
                  "dominant-direction-normalized", "teaching-page"}),
            slot("falloff", &Profile::falloff,
                 {"inverse-square", "inverse-square-offset", "exponent-2", "exponent-8"}),
            slot("shadow-filter", &Profile::shadow_filter, {"pcss", "pcf"}),
            slot("contact-shadows", &Profile::contact_shadows, {"none", "screen-march"}),
            slot("exposure", &Profile::exposure, {"standard-output", "saturation"})};
}

template <class Names>
std::string list(const Names& names) {
    std::string text;
    for (const auto& name : names) text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

Profile best() {
    return {.name = "best"};
}

Profile frostbite() {
    return {.name = "frostbite",
            .diffuse = DiffuseTechnique::disney_renormalized,
            .visibility = VisibilityTechnique::smith_correlated,
            .fresnel = FresnelTechnique::schlick_micro_occlusion,
            .energy = EnergyTechnique::none,
            .dfg = DfgTechnique::table,
            .reflection = ReflectionTechnique::dominant_direction,
            .specular_aa = SpecularAaTechnique::none,
            .normal_map_filter = NormalMapFilterTechnique::average_length,
            .area_diffuse = AreaDiffuseTechnique::structured_sampling,
            .area_direction = AreaDirectionTechnique::light_position,
            .area_specular = AreaSpecularTechnique::dominant_direction,
            .exposure = ExposureTechnique::saturation};
}

Profile ue4() {
    return {.name = "ue4",
            .diffuse = DiffuseTechnique::lambert,
            .visibility = VisibilityTechnique::schlick_smith,
            .fresnel = FresnelTechnique::spherical_gaussian,
            .energy = EnergyTechnique::none,
            .dfg = DfgTechnique::table,
            .reflection = ReflectionTechnique::mirror_direction,
            .specular_aa = SpecularAaTechnique::none,
            .normal_map_filter = NormalMapFilterTechnique::average_length,
            .area_diffuse = AreaDiffuseTechnique::light_position,
            .area_direction = AreaDirectionTechnique::light_position,
            .area_specular = AreaSpecularTechnique::representative_point,
            .falloff = FalloffTechnique::offset,
            .shadow_filter = ShadowFilterTechnique::pcf};
}

Profile mobile() {
    Profile profile = ue4();
    profile.name = "mobile";
    // Karis 2014 has no k for analytic lights of their own.
    profile.visibility = VisibilityTechnique::schlick_smith_half_alpha;
    profile.dfg = DfgTechnique::env_brdf_approx_nonmetal;
    profile.fully_rough = scene::FullyRoughRule::flagged;
    profile.sun_specular = SunSpecularTechnique::d_approx;
    return profile;
}

/// The teaching page on the Unreal Engine 4 subset with its errors corrected: what it quotes from Karis 2013.
Profile lesson() {
    Profile profile = ue4();
    profile.name = "lesson";
    return profile;
}

/// The page word by word: shading/teaching_page.glsl.
Profile lesson_literal() {
    Profile profile = lesson();
    profile.name = "lesson-literal";
    profile.visibility = VisibilityTechnique::teaching_page;
    profile.area_specular = AreaSpecularTechnique::teaching_page;
    return profile;
}

}  // namespace

Profile profile_by_name(const std::string& name, const std::string& where) {
    for (const Profile& profile : {best(), frostbite(), ue4(), mobile(), lesson(), lesson_literal()}) {
        if (profile.name == name) return profile;
    }
    throw Error(Fault::usage, "no such profile: " + name, where,
                "one of " + list(profile_names()) + ", or a .json file");
}

std::vector<std::string> profile_names() {
    return {"best", "frostbite", "ue4", "mobile", "lesson", "lesson-literal"};
}

void set_technique(Profile& profile, std::string_view slot_name, std::string_view technique,
                   const std::string& where) {
    std::vector<std::string_view> names;
    for (const Slot& s : slots()) {
        names.push_back(s.name);
        if (s.name != slot_name) continue;
        for (std::uint8_t i = 0; i < s.techniques.size(); ++i) {
            if (s.techniques[i] == technique) return s.set(profile, i);
        }
        throw input_error("no such technique: " + std::string(technique), where,
                          "one of " + list(s.techniques));
    }
    if (slot_name == kFalloffOffset) throw input_error("is not a number of m^2", where);
    names.push_back(kFalloffOffset);
    throw input_error("no such slot of a profile: " + std::string(slot_name), where, "one of " + list(names));
}

void set_parameter(Profile& profile, std::string_view name, double value, const std::string& where) {
    if (name != kFalloffOffset)
        throw input_error("a technique's name is a string", where,
                          "the only number of a profile is " + std::string(kFalloffOffset));
    if (!(value >= 0.0 && value <= 1.0e6)) throw input_error("is not from 0 to 1e6 m^2", where);
    profile.falloff_offset_m2 = static_cast<float>(value);
}

std::string describe(const Profile& profile) {
    std::string text;
    for (const Slot& s : slots()) {
        text +=
            (text.empty() ? "" : " ") + std::string(s.name) + "=" + std::string(s.techniques[s.get(profile)]);
    }
    if (profile.falloff == FalloffTechnique::offset) {
        std::array<char, 32> number{};
        std::snprintf(number.data(), number.size(), "%g", double(profile.falloff_offset_m2));
        text += " " + std::string(kFalloffOffset) + "=" + number.data();
    }
    return text;
}

}  // namespace candela::realtime
