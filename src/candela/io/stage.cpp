#include "candela/io/stage.hpp"

#include <cmath>
#include <functional>
#include <map>

#include "candela/io/image_read.hpp"
#include "candela/io/inside_folder.hpp"
#include "candela/io/json_reader.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

using nlohmann::json;

/// One JSON object of a stage file: every key must have a handler, and errors name the JSON pointer.
class Object {
  public:
    using Handler = std::function<void(const json&, const std::string& where)>;

    Object(const json& object, std::string where, std::map<std::string, Handler> handlers) {
        if (!object.is_object()) throw input_error("must be an object", where);
        std::vector<std::string> known;
        for (const auto& [key, handler] : handlers) known.push_back(key);
        for (const auto& [key, value] : object.items()) {
            const auto found = handlers.find(key);
            const std::string at = where + "/" + key;
            if (found == handlers.end()) {
                const std::string near = nearest_name(key, known);
                throw input_error(
                    "unknown key", at,
                    near.empty() ? "docs/stage.md lists the keys" : "did you mean " + near + "?");
            }
            found->second(value, at);
        }
    }
};

/// The limits are double, as JSON's numbers are: 0.1f is above 0.1, and would refuse the limit itself.
float number(const json& value, const std::string& where, double low, double high, const std::string& range) {
    if (!value.is_number()) throw input_error("must be a number", where);
    const auto x = value.get<double>();
    if (!(x >= low && x <= high)) throw input_error("out of range", where, range);
    return static_cast<float>(x);
}

float positive(const json& value, const std::string& where) {
    return number(value, where, 1e-9, 1e12, "a number greater than 0");
}

bool boolean(const json& value, const std::string& where) {
    if (!value.is_boolean()) throw input_error("must be true or false", where);
    return value.get<bool>();
}

std::string text(const json& value, const std::string& where) {
    if (!value.is_string() || value.get_ref<const std::string&>().empty()) {
        throw input_error("must be a string that is not empty", where);
    }
    return value.get<std::string>();
}

glm::vec3 point(const json& value, const std::string& where) {
    if (!value.is_array() || value.size() != 3) throw input_error("must be three numbers [x, y, z]", where);
    glm::vec3 p;
    for (int i = 0; i < 3; ++i) {
        p[i] = number(value[static_cast<std::size_t>(i)], where + "/" + std::to_string(i), -1e9, 1e9,
                      "-1e9 to 1e9");
    }
    return p;
}

StageEnvironment read_environment_entry(const json& value, const std::string& where,
                                        const std::filesystem::path& folder) {
    StageEnvironment e;
    bool studio = false;
    const Object object(
        value, where,
        {{"file",
          [&](const json& v, const std::string& at) { e.file = inside_folder(folder, text(v, at), at); }},
         {"studio", [&](const json& v, const std::string& at) { studio = boolean(v, at); }},
         {"none", [&](const json& v, const std::string& at) { e.none = boolean(v, at); }},
         {"scale",
          [&](const json& v, const std::string& at) { e.scale = number(v, at, 0.0, 1e12, "0 or more"); }},
         {"rotation_deg",
          [&](const json& v, const std::string& at) {
              e.rotation_rad = number(v, at, -36000.0, 36000.0, "degrees") * static_cast<float>(M_PI / 180.0);
          }},
         {"illuminance_lx",
          [&](const json& v, const std::string& at) { e.illuminance_lx = positive(v, at); }},
         {"visible", [&](const json& v, const std::string& at) { e.visible = boolean(v, at); }}});
    if ((e.file.empty() ? 0 : 1) + (studio ? 1 : 0) + (e.none ? 1 : 0) != 1) {
        throw input_error("needs one of a file, \"studio\": true and \"none\": true", where,
                          "{\"file\": \"sky.exr\"}");
    }
    return e;
}

StageCamera read_camera(const json& value, const std::string& where) {
    StageCamera c;
    const Object object(
        value, where,
        {{"name", [&](const json& v, const std::string& at) { c.name = text(v, at); }},
         {"look_from", [&](const json& v, const std::string& at) { c.look_from = point(v, at); }},
         {"look_at", [&](const json& v, const std::string& at) { c.look_at = point(v, at); }},
         {"focal_mm", [&](const json& v, const std::string& at) {
              c.focal_mm = number(v, at, 1.0, 5000.0, "1 to 5000 mm");
          }}});
    if (c.name && c.look_from) throw input_error("has both a name and look_from", where, "keep one of them");
    return c;
}

scene::Exposure read_exposure(const json& value, const std::string& where) {
    scene::Exposure e;
    bool automatic = false;
    const Object object(
        value, where,
        {{"ev100",
          [&](const json& v, const std::string& at) { e.ev100 = number(v, at, -30.0, 40.0, "-30 to 40"); }},
         {"aperture_f",
          [&](const json& v, const std::string& at) {
              e.aperture_f = number(v, at, 0.1, 1000.0, "0.1 to 1000");
          }},
         {"shutter_s", [&](const json& v, const std::string& at) { e.shutter_s = positive(v, at); }},
         {"iso",
          [&](const json& v, const std::string& at) { e.iso = number(v, at, 1.0, 1e7, "1 to 10,000,000"); }},
         {"automatic", [&](const json& v, const std::string& at) { automatic = boolean(v, at); }},
         {"compensation_ev", [&](const json& v, const std::string& at) {
              e.compensation_ev = number(v, at, -30.0, 30.0, "-30 to 30");
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

Stage load_stage(const std::filesystem::path& file) {
    const std::string name = file.string();
    const json root = parse_json(read_file(file, std::size_t{16} << 20), name, true);
    const std::filesystem::path folder = file.parent_path().empty() ? "." : file.parent_path();
    Stage stage;
    const Object object(
        root, name + ": ",
        {{"environment",
          [&](const json& v, const std::string& at) {
              stage.environment = read_environment_entry(v, at, folder);
          }},
         {"camera", [&](const json& v, const std::string& at) { stage.camera = read_camera(v, at); }},
         {"exposure", [&](const json& v, const std::string& at) { stage.exposure = read_exposure(v, at); }},
         {"$schema", [&](const json& v, const std::string& at) { (void)text(v, at); }}});
    return stage;
}

}  // namespace candela::io
