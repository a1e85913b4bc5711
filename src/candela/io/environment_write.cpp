#include "candela/io/environment_write.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "candela/io/environment_presets.hpp"
#include "candela/scene/environment_resample.hpp"
#include "candela/scene/error.hpp"
#include "candela/scene/half_range.hpp"

namespace candela::io {
namespace {

using nlohmann::json;

/// The level of roughness 1 still tells directions apart; Filament and the glTF extension end at 16 texels.
constexpr std::uint32_t kSmallestLevel = 4;
constexpr const char* kFormatNames[] = {"ktx2", "ktx2-rgb9e5", "dds", "exr", "exr-faces"};
constexpr const char* kPresetNames[] = {"candela", "filament", "threejs", "gltf"};

template <class Value, std::size_t count>
std::optional<Value> by_name(const char* const (&names)[count], const std::string& name) {
    const auto found = std::find(std::begin(names), std::end(names), name);
    if (found == std::end(names)) return std::nullopt;
    return static_cast<Value>(found - std::begin(names));
}

/// A programming error, not the user's, but for what demand_of asks.
void check(const scene::FilteredEnvironment& e, EnvironmentPreset preset, const std::string& where) {
    const auto whole = [](const scene::CubeMap& cube) {
        return cube.size > 0 && cube.texels.size() == std::size_t{6} * cube.size * cube.size;
    };
    if (e.specular.empty() || !whole(e.irradiance) ||
        !std::all_of(e.specular.begin(), e.specular.end(), whole))
        throw std::invalid_argument("write_filtered_environment: a cube without its texels");
    for (std::size_t i = 1; i < e.specular.size(); ++i) {
        if (e.specular[i].size != std::max(e.specular[i - 1].size / 2, 1u))
            throw std::invalid_argument("write_filtered_environment: a level is not half the one before");
    }
    const FilterDemand demand = demand_of(preset);
    const std::string name = name_of(preset);
    const std::uint32_t size = e.specular.front().size;
    if (demand.mapping && *demand.mapping != e.mapping)
        throw input_error("the levels do not stand for the roughness that " + name + " expects", where,
                          std::string("filter with the mapping ") + detail::name_of(*demand.mapping));
    if (demand.power_of_two && (size & (size - 1)) != 0)
        throw input_error("the faces of " + name + " are a power of two in size", where);
    if (e.specular.back().size < demand.smallest_level)
        throw input_error("the coarsest level of " + name + " has at least " +
                              std::to_string(demand.smallest_level) + " texels a side",
                          where, "fewer levels or larger faces");
}

}  // namespace

namespace detail {

const char* name_of(scene::RoughnessMapping mapping) {
    switch (mapping) {
        case scene::RoughnessMapping::frostbite:
            return "frostbite";
        case scene::RoughnessMapping::filament:
            return "filament";
        default:
            return "linear";
    }
}

json common_metadata(const scene::FilteredEnvironment& e, EnvironmentPreset preset) {
    json levels = json::array();
    const auto count = static_cast<std::uint32_t>(e.specular.size());
    for (std::uint32_t i = 0; i < count; ++i)
        levels.push_back(
            {{"level", i},
             {"size", e.specular[i].size},
             {"perceptual_roughness", scene::perceptual_roughness_of_level(e.mapping, i, count)}});
    const char* formula = e.mapping == scene::RoughnessMapping::frostbite ? "level / (levels - 1) = sqrt(r)"
                          : e.mapping == scene::RoughnessMapping::filament
                              ? "level / (levels - 1) = r (2 - r)"
                              : "level / (levels - 1) = r";
    return {
        {"written_by", "candela"},
        {"preset", io::name_of(preset)},
        {"world", {{"handedness", "right"}, {"up", "+Y"}, {"ahead", "-Z"}}},
        {"color", "linear Rec.709, D65"},
        {"units", {{"stored_times_nit_per_unit", "cd/m^2"}, {"nit_per_unit", e.nit_per_unit}}},
        {"specular",
         {{"lobe", "GGX, n = v = r, weighted by n.l and normalized: a white environment of 1 stays 1"},
          {"roughness_mapping", name_of(e.mapping)},
          {"roughness_mapping_formula", formula},
          {"r", "perceptual roughness; alpha = r^2"},
          {"levels", levels}}},
        {"irradiance",
         {{"quantity", "irradiance over pi"}, {"one_over_pi", "included: multiply by the albedo alone"}}}};
}

}  // namespace detail

namespace {

/// The harmonics and the unit, where the source's peak asks for another one than the filtered levels.
scene::FilteredEnvironment in_unit_of(const scene::Environment& source,
                                      const scene::FilteredEnvironment& environment) {
    scene::FilteredEnvironment out;
    out.mapping = environment.mapping;
    out.radiance_sh = environment.radiance_sh;
    float peak = 0.0f;
    for (const glm::vec3& t : source.luminance_nit) peak = std::max({peak, t.x, t.y, t.z});
    out.nit_per_unit = scene::unit_for_half(peak * source.scale);
    for (glm::vec3& c : out.radiance_sh) c *= environment.nit_per_unit / out.nit_per_unit;
    return out;
}

std::vector<std::filesystem::path> write_with_source(detail::StagingFolder& files,
                                                     const scene::FilteredEnvironment& environment,
                                                     const scene::Environment& source) {
    json metadata = detail::common_metadata(environment, EnvironmentPreset::threejs);
    detail::write_threejs(files, environment, &source, metadata);
    detail::write_text(files.file("environment.json"), metadata.dump(2) + "\n");
    return files.commit();
}

}  // namespace

const char* name_of(CubeFormat format) {
    return kFormatNames[static_cast<std::size_t>(format)];
}
const char* name_of(EnvironmentPreset preset) {
    return kPresetNames[static_cast<std::size_t>(preset)];
}
std::optional<CubeFormat> cube_format_by_name(const std::string& name) {
    return by_name<CubeFormat>(kFormatNames, name);
}
std::optional<EnvironmentPreset> preset_by_name(const std::string& name) {
    return by_name<EnvironmentPreset>(kPresetNames, name);
}

FilterDemand demand_of(EnvironmentPreset preset) {
    switch (preset) {
        case EnvironmentPreset::filament:
            return {scene::RoughnessMapping::filament, kSmallestLevel, true};
        case EnvironmentPreset::gltf:
            return {scene::RoughnessMapping::linear, kSmallestLevel, true};
        default:
            return {};
    }
}

std::vector<std::filesystem::path> write_filtered_environment(const std::filesystem::path& folder,
                                                              const scene::FilteredEnvironment& environment,
                                                              CubeFormat format, EnvironmentPreset preset,
                                                              const scene::Environment* source) {
    check(environment, preset, folder.string());
    if (source != nullptr && preset != EnvironmentPreset::threejs)
        throw std::invalid_argument("write_filtered_environment: only threejs has a picture of its source");
    detail::StagingFolder files(folder);
    if (source != nullptr) return write_with_source(files, in_unit_of(*source, environment), *source);
    json metadata = detail::common_metadata(environment, preset);
    switch (preset) {
        case EnvironmentPreset::filament:
            detail::write_filament(files, environment, metadata);
            break;
        case EnvironmentPreset::threejs:
            detail::write_threejs(files, environment, nullptr, metadata);
            break;
        case EnvironmentPreset::gltf:
            detail::write_gltf_light(files, environment, metadata);
            break;
        default:
            detail::write_candela(files, environment, format, metadata);
    }
    detail::write_text(files.file("environment.json"), metadata.dump(2) + "\n");
    return files.commit();
}

}  // namespace candela::io
