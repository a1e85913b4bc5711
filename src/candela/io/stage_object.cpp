#include "candela/io/stage_object.hpp"

#include "candela/io/json_reader.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {

using nlohmann::json;

StageObject::StageObject(const json& object, const std::string& where,
                         const std::map<std::string, Handler>& handlers) {
    if (!object.is_object()) throw input_error("must be an object", where);
    std::vector<std::string> known;
    for (const auto& [key, handler] : handlers) known.push_back(key);
    for (const auto& [key, value] : object.items()) {
        const auto found = handlers.find(key);
        const std::string at = where + "/" + key;
        if (found == handlers.end()) {
            const std::string near = nearest_name(key, known);
            throw input_error("unknown key", at,
                              near.empty() ? "docs/stage.md lists the keys" : "did you mean " + near + "?");
        }
        found->second(value, at);
    }
}

float stage_number(const json& value, const std::string& where, double low, double high,
                   const std::string& range) {
    if (!value.is_number()) throw input_error("must be a number", where);
    const auto x = value.get<double>();
    if (!(x >= low && x <= high)) throw input_error("out of range", where, range);
    return static_cast<float>(x);
}

float stage_positive(const json& value, const std::string& where) {
    return stage_number(value, where, 1e-9, 1e12, "a number greater than 0");
}

bool stage_boolean(const json& value, const std::string& where) {
    if (!value.is_boolean()) throw input_error("must be true or false", where);
    return value.get<bool>();
}

std::string stage_text(const json& value, const std::string& where) {
    if (!value.is_string() || value.get_ref<const std::string&>().empty()) {
        throw input_error("must be a string that is not empty", where);
    }
    return value.get<std::string>();
}

std::size_t stage_choice(const json& value, const std::string& where, const std::vector<std::string>& names) {
    std::string all;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (value.is_string() && value.get_ref<const std::string&>() == names[i]) return i;
        all += (all.empty() ? "" : ", ") + names[i];
    }
    throw input_error("must be one of a few words", where, all);
}

glm::dvec3 stage_point(const json& value, const std::string& where) {
    (void)stage_vector(value, where);
    return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

glm::vec3 stage_vector(const json& value, const std::string& where, double low, double high,
                       const std::string& range) {
    if (!value.is_array() || value.size() != 3) throw input_error("must be three numbers [x, y, z]", where);
    glm::vec3 v;
    for (int i = 0; i < 3; ++i) {
        v[i] = stage_number(value[static_cast<std::size_t>(i)], where + "/" + std::to_string(i), low, high,
                            range);
    }
    return v;
}

}  // namespace candela::io
