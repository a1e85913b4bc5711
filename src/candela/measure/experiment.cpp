#include "candela/measure/experiment.hpp"

#include <algorithm>

#include "candela/io/json_reader.hpp"
#include "candela/scene/error.hpp"
#include "experiment_list.inc"

namespace candela::measure {
namespace {

Experiment named(const char* id, Experiment experiment) {
    experiment.id = id;
    return experiment;
}

}  // namespace

std::vector<Experiment> all_experiments() {
    return {CANDELA_EXPERIMENTS};
}

std::vector<Experiment> select_experiments(std::vector<Experiment> known,
                                           const std::vector<std::string>& ids) {
    if (ids.empty()) return known;
    std::vector<std::string> names;
    for (const Experiment& e : known) names.push_back(e.id);
    std::vector<Experiment> out;
    for (const std::string& id : ids) {
        const auto found = std::find(names.begin(), names.end(), id);
        if (found == names.end()) {
            const std::string near = io::nearest_name(id, names);
            throw Error(Fault::usage, "there is no experiment '" + id + "'", "--only",
                        near.empty() ? "candela validate --list names them" : "did you mean '" + near + "'?");
        }
        out.push_back(known[static_cast<std::size_t>(found - names.begin())]);
    }
    return out;
}

}  // namespace candela::measure
