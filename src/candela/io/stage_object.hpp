#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "candela/scene/error.hpp"

/// How the parts of a stage file are read: every error names the file and the JSON pointer.
namespace candela::io {

/// One JSON object of a stage file: every key must have a handler.
class StageObject {
  public:
    using Handler = std::function<void(const nlohmann::json&, const std::string& where)>;

    StageObject(const nlohmann::json& object, const std::string& where,
                const std::map<std::string, Handler>& handlers);
};

/// The limits are double, as JSON's numbers are: 0.1f is above 0.1, and would refuse the limit itself.
[[nodiscard]] float stage_number(const nlohmann::json& value, const std::string& where, double low,
                                 double high, const std::string& range);
/// 1e-9 to 1e12.
[[nodiscard]] float stage_positive(const nlohmann::json& value, const std::string& where);
[[nodiscard]] bool stage_boolean(const nlohmann::json& value, const std::string& where);
/// Not empty.
[[nodiscard]] std::string stage_text(const nlohmann::json& value, const std::string& where);
/// One of these.
[[nodiscard]] std::size_t stage_choice(const nlohmann::json& value, const std::string& where,
                                       const std::vector<std::string>& names);
[[nodiscard]] glm::vec3 stage_vector(const nlohmann::json& value, const std::string& where,
                                     double low = -1e12, double high = 1e12,
                                     const std::string& range = "-1e12 to 1e12");

/// A point of the world in double, as JSON's numbers are: -1e12 to 1e12.
[[nodiscard]] glm::dvec3 stage_point(const nlohmann::json& value, const std::string& where);

/// Does what reads a file that the stage names: what goes wrong then names the key as well.
template <class Read>
auto read_stage_file(const std::string& where, const Read& read) {
    try {
        return read();
    } catch (const Error& error) {
        throw Error(error.fault(), error.what(), where + ": " + error.where(), error.hint());
    }
}

}  // namespace candela::io
