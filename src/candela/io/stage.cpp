#include "candela/io/stage.hpp"

#include <cmath>

#include "candela/io/file_kind.hpp"
#include "candela/io/image_read.hpp"
#include "candela/io/inside_folder.hpp"
#include "candela/io/json_position.hpp"
#include "candela/io/json_reader.hpp"
#include "candela/io/stage_object.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

using nlohmann::json;

scene::SkySettings read_sky(const json& value, const std::string& where) {
    scene::SkySettings sky;
    std::map<std::string, StageObject::Handler> handlers;
    for (const scene::SkySetting& setting : scene::kSkySettings) {
        handlers[setting.key] = [&sky, &setting](const json& v, const std::string& at) {
            sky.*setting.value = stage_number(v, at, setting.low, setting.high, setting.range);
        };
    }
    const StageObject object(value, where, handlers);
    return sky;
}

StageEnvironment read_environment_entry(const json& value, const std::string& where,
                                        const SearchFolders& folders) {
    StageEnvironment e;
    e.where = where + "/file";
    bool studio = false;
    const StageObject object(
        value, where,
        {{"file", [&](const json& v,
                      const std::string& at) { e.file = inside_folders(folders, stage_text(v, at), at); }},
         {"sky", [&](const json& v, const std::string& at) { e.sky = read_sky(v, at); }},
         {"studio", [&](const json& v, const std::string& at) { studio = stage_boolean(v, at); }},
         {"none", [&](const json& v, const std::string& at) { e.none = stage_boolean(v, at); }},
         {"scale", [&](const json& v,
                       const std::string& at) { e.scale = stage_number(v, at, 0.0, 1e12, "0 or more"); }},
         {"rotation_deg",
          [&](const json& v, const std::string& at) {
              e.rotation_rad =
                  stage_number(v, at, -36000.0, 36000.0, "degrees") * static_cast<float>(M_PI / 180.0);
          }},
         {"illuminance_lx",
          [&](const json& v, const std::string& at) { e.illuminance_lx = stage_positive(v, at); }},
         {"layout",
          [&](const json& v, const std::string& at) {
              e.options.layout = static_cast<EnvironmentLayout>(
                  stage_choice(v, at, {"auto", "equirect", "cross", "octahedral", "angular", "mirror-ball"}));
          }},
         {"layer", [&](const json& v, const std::string& at) { e.options.layer = stage_text(v, at); }},
         {"negative",
          [&](const json& v, const std::string& at) {
              e.options.negative = static_cast<NegativeTexels>(stage_choice(v, at, {"clamp", "spread"}));
          }},
         {"cube",
          [&](const json& v, const std::string& at) {
              e.options.cube_space =
                  static_cast<scene::CubeSpace>(stage_choice(v, at, {"direct", "picture"}));
          }},
         {"keep_sun", [&](const json& v, const std::string& at) { e.keep_sun = stage_boolean(v, at); }},
         {"visible", [&](const json& v, const std::string& at) { e.visible = stage_boolean(v, at); }}});
    if ((e.file.empty() ? 0 : 1) + (e.sky ? 1 : 0) + (studio ? 1 : 0) + (e.none ? 1 : 0) != 1) {
        throw input_error("needs one of a file, a sky, \"studio\": true and \"none\": true", where,
                          "{\"file\": \"sky.exr\"}");
    }
    return e;
}

StageCamera read_camera(const json& value, const std::string& where) {
    StageCamera c;
    const StageObject object(
        value, where,
        {{"name", [&](const json& v, const std::string& at) { c.name = stage_text(v, at); }},
         {"look_from", [&](const json& v, const std::string& at) { c.look_from = stage_point(v, at); }},
         {"look_at", [&](const json& v, const std::string& at) { c.look_at = stage_point(v, at); }},
         {"focal_mm", [&](const json& v, const std::string& at) {
              c.focal_mm = stage_number(v, at, 1.0, 5000.0, "1 to 5000 mm");
          }}});
    if (c.name && c.look_from) throw input_error("has both a name and look_from", where, "keep one of them");
    return c;
}

scene::Exposure read_exposure(const json& value, const std::string& where) {
    scene::Exposure e;
    bool automatic = false;
    const StageObject object(
        value, where,
        {{"ev100", [&](const json& v,
                       const std::string& at) { e.ev100 = stage_number(v, at, -30.0, 40.0, "-30 to 40"); }},
         {"aperture_f",
          [&](const json& v, const std::string& at) {
              e.aperture_f = stage_number(v, at, 0.1, 1000.0, "0.1 to 1000");
          }},
         {"shutter_s", [&](const json& v, const std::string& at) { e.shutter_s = stage_positive(v, at); }},
         {"iso", [&](const json& v,
                     const std::string& at) { e.iso = stage_number(v, at, 1.0, 1e7, "1 to 10,000,000"); }},
         {"automatic", [&](const json& v, const std::string& at) { automatic = stage_boolean(v, at); }},
         {"compensation_ev", [&](const json& v, const std::string& at) {
              e.compensation_ev = stage_number(v, at, -30.0, 30.0, "-30 to 30");
          }}});
    const int camera = (e.aperture_f ? 1 : 0) + (e.shutter_s ? 1 : 0) + (e.iso ? 1 : 0);
    if (camera == 1 || camera == 2) throw input_error("needs aperture_f, shutter_s and iso together", where);
    if ((e.ev100 ? 1 : 0) + (camera == 3 ? 1 : 0) + (automatic ? 1 : 0) > 1) {
        throw input_error("is given in more than one way", where,
                          "one of ev100, the camera's three, automatic");
    }
    return e;
}

}  // namespace

namespace {

/// What is no stage at all is said as what it is, and not as JSON with a mistake.
void check_is_stage(std::span<const std::byte> bytes, const std::filesystem::path& file) {
    const FileKind kind = kind_of_file(bytes, file);
    if (bytes.empty() || kind.name == "a stage" || kind.name == "a JSON file") return;
    const bool scene = kind.name.find("glTF") != std::string::npos;
    if (!is_binary(bytes) && kind.name.empty()) return;
    throw input_error(not_a("a stage", kind), file.string(),
                      scene ? "candela render SCENE --stage STAGE.json" : "a JSON file; docs/stage.md");
}

Stage read_stage(const json& root, const std::string& name, const SearchFolders& folders) {
    Stage stage;
    const StageObject object(
        root, name + ": ",
        {{"environment",
          [&](const json& v, const std::string& at) {
              stage.environment = read_environment_entry(v, at, folders);
          }},
         {"lights",
          [&](const json& v, const std::string& at) { stage.lights = read_stage_lights(v, at, folders); }},
         {"reflection_probes",
          [&](const json& v, const std::string& at) { read_reflection_probes(v, at, stage.probes); }},
         {"irradiance_volumes",
          [&](const json& v, const std::string& at) { read_irradiance_volumes(v, at, stage.probes); }},
         {"camera", [&](const json& v, const std::string& at) { stage.camera = read_camera(v, at); }},
         {"exposure", [&](const json& v, const std::string& at) { stage.exposure = read_exposure(v, at); }},
         {"units",
          [&](const json& v, const std::string& at) {
              stage.units = static_cast<StageUnits>(stage_choice(v, at, {"auto", "absolute", "relative"}));
          }},
         {"emissive_scale",
          [&](const json& v, const std::string& at) {
              stage.emissive_scale = stage_number(v, at, 0.0, 1e12, "0 or more");
          }},
         {"$schema", [&](const json& v, const std::string& at) { (void)stage_text(v, at); }}});
    return stage;
}

}  // namespace

Stage load_stage(const std::filesystem::path& file, const std::vector<std::filesystem::path>& search) {
    const std::string name = file.string();
    const std::vector<std::byte> bytes = read_file(file, std::size_t{16} << 20);
    check_is_stage(bytes, file);
    const json root = parse_json(bytes, name, true);
    if (!root.is_object())
        throw input_error("a stage is a JSON object", name,
                          "{\"environment\": {\"sky\": {}}}; docs/stage.md");
    const SearchFolders folders{file.parent_path().empty() ? "." : file.parent_path(), search};
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    try {
        Stage stage = read_stage(root, name, folders);
        if (stage.environment)
            stage.environment->where =
                with_position(input_error("", stage.environment->where), name, text).where();
        return stage;
    } catch (const Error& error) {
        throw with_position(error, name, text);
    }
}

ReadEnvironment read_stage_environment(const StageEnvironment& e, Diagnostics& diagnostics) {
    return read_stage_file(e.where, [&] { return read_environment(e.file, diagnostics, e.options); });
}

}  // namespace candela::io
