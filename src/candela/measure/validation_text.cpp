#include <cmath>
#include <nlohmann/json.hpp>

#include "candela/measure/numerics.hpp"
#include "candela/measure/validation.hpp"

namespace candela::measure {
namespace {

using nlohmann::json;

json finite(double value) {
    return std::isfinite(value) ? json(value) : json(nullptr);
}

json numbers(const std::vector<double>& values) {
    json out = json::array();
    for (const double v : values) out.push_back(finite(v));
    return out;
}

json measured_json(const Measured& m) {
    json bound = json::object();
    if (std::isfinite(m.bound.at_least)) bound["at_least"] = m.bound.at_least;
    if (std::isfinite(m.bound.at_most)) bound["at_most"] = m.bound.at_most;
    return {
        {"name", m.name}, {"value", finite(m.value)}, {"unit", m.unit}, {"bound", bound}, {"pass", m.pass()}};
}

json plot_json(const Plot& plot) {
    json series = json::array();
    for (const Series& s : plot.series)
        series.push_back({{"name", s.name}, {"x", numbers(s.x)}, {"y", numbers(s.y)}});
    return {{"title", plot.title}, {"x_label", plot.x.label}, {"y_label", plot.y.label}, {"series", series}};
}

json table_json(const Table& table) {
    return {{"title", table.title}, {"columns", table.columns}, {"rows", table.rows}};
}

json experiment_json(const ExperimentResult& result) {
    json out{{"id", result.experiment.id},
             {"paper", result.experiment.paper},
             {"reproduces", result.experiment.reproduces},
             {"title", result.experiment.title},
             {"computes", result.experiment.computes},
             {"finding", result.findings.text},
             {"pass", result.pass()},
             {"seconds", result.seconds},
             {"measured", json::array()},
             {"plots", json::array()},
             {"tables", json::array()}};
    for (const Measured& m : result.findings.measured) out["measured"].push_back(measured_json(m));
    for (const Plot& p : result.findings.plots) out["plots"].push_back(plot_json(p));
    for (const Table& t : result.findings.tables) out["tables"].push_back(table_json(t));
    return out;
}

std::string with_unit(double value, const std::string& unit) {
    return readable(value) + (unit.empty() ? "" : " " + unit);
}

}  // namespace

json results_json(std::span<const ExperimentResult> results, const std::string& version) {
    json out{{"version", version},
             {"pass", all_pass(results)},
             {"experiments", json::array()},
             {"techniques", json::array()}};
    for (const ExperimentResult& result : results) {
        out["experiments"].push_back(experiment_json(result));
        for (const TechniqueCost& t : result.techniques) {
            out["techniques"].push_back({{"name", t.technique.name},
                                         {"source", t.technique.source},
                                         {"approximates", t.technique.approximates},
                                         {"truth", t.technique.truth},
                                         {"unit", t.technique.unit},
                                         {"mean_error", finite(t.technique.mean_error)},
                                         {"max_error", finite(t.technique.max_error)},
                                         {"cost_ns", finite(t.cost_ns)},
                                         {"experiment", result.experiment.id}});
        }
    }
    return out;
}

std::string bound_text(const Measured& m) {
    const bool low = std::isfinite(m.bound.at_least);
    const bool high = std::isfinite(m.bound.at_most);
    if (low && high && m.bound.at_least == m.bound.at_most) return "exactly " + number(m.bound.at_least, 7);
    if (low && high) return number(m.bound.at_least, 7) + " to " + number(m.bound.at_most, 7);
    if (low) return "at least " + number(m.bound.at_least, 7);
    return "at most " + number(m.bound.at_most, 7);
}

std::string results_text(std::span<const ExperimentResult> results) {
    std::string out;
    std::size_t passed = 0;
    for (const ExperimentResult& r : results) {
        passed += r.pass() ? 1 : 0;
        out += std::string(r.pass() ? "pass  " : "FAIL  ") + r.experiment.id + ": " + r.experiment.paper +
               ", " + r.experiment.reproduces + "\n";
        for (const Measured& m : r.findings.measured) {
            if (m.pass()) continue;
            out += "      " + m.name + ": " + with_unit(m.value, m.unit) + ", bound: " + bound_text(m) + "\n";
        }
        if (r.findings.measured.empty()) out += "      nothing was measured\n";
    }
    return out + std::to_string(passed) + " of " + std::to_string(results.size()) +
           " experiments within their bounds\n";
}

std::string techniques_markdown(std::span<const ExperimentResult> results) {
    std::string out =
        "# Techniques\n\n"
        "Written by `candela validate --techniques docs/techniques.md`; do not edit. Each row is an "
        "approximation, its\n"
        "error against its truth as measured in that run, and its cost: ns per call on one core of the "
        "machine that ran\n"
        "it, as a throughput in a loop. The last column names the experiment (`candela validate --only ID -o "
        "DIR`).\n\n"
        "| technique | source | approximates | truth | mean error | max error | ns per call | experiment |\n"
        "|---|---|---|---|---|---|---|---|\n";
    for (const ExperimentResult& r : results) {
        for (const TechniqueCost& t : r.techniques) {
            out += "| " + t.technique.name + " | " + t.technique.source + " | " + t.technique.approximates +
                   " | " + t.technique.truth + " | " + with_unit(t.technique.mean_error, t.technique.unit) +
                   " | " + with_unit(t.technique.max_error, t.technique.unit) + " | " + cost_text(t.cost_ns) +
                   " | " + r.experiment.id + " |\n";
        }
    }
    return out;
}

}  // namespace candela::measure
