#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

/// What an experiment of `candela validate` is and what it finds. An experiment is one file NAME.cpp in
/// experiments/ that defines `Experiment candela::measure::experiments::NAME()`; the build finds it, and NAME
/// becomes its id.
namespace candela::measure {

enum class Scale : std::uint8_t { linear, logarithmic };

/// Drawn from low to high; both 0: as wide as the data.
struct Axis {
    std::string label;  ///< with its unit
    double low = 0.0;
    double high = 0.0;
    Scale scale = Scale::linear;
    double step = 0.0;  ///< between ticks; 0: a round number that gives a handful
};

enum class Stroke : std::uint8_t { solid, dashed, dotted, points };

struct Series {
    std::string name;  ///< for the legend; empty: not in it
    std::vector<double> x;
    std::vector<double> y;
    Stroke stroke = Stroke::solid;
    int color = -1;  ///< index into the palette, for series that belong together; -1: the next one
};

struct Plot {
    std::string title;
    std::string caption;
    Axis x;
    Axis y;
    std::vector<Series> series;
};

struct Table {
    std::string title;
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
};

/// Display-referred sRGB, 3 bytes a pixel, row 0 on top; shown `zoom` times as large.
struct Panel {
    std::string title;
    std::string caption;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgb;
    int zoom = 1;
};

/// The interval that a measured number must lie in, its ends included.
struct Bound {
    double at_least = -std::numeric_limits<double>::infinity();
    double at_most = std::numeric_limits<double>::infinity();
};

struct Measured {
    std::string name;
    double value = 0.0;
    std::string unit;  ///< empty: a pure number
    Bound bound;

    /// False also for a value that is not a number.
    [[nodiscard]] bool pass() const noexcept { return value >= bound.at_least && value <= bound.at_most; }
};

[[nodiscard]] inline Measured at_most(std::string name, double value, double bound, std::string unit = {}) {
    return {std::move(name), value, std::move(unit), {-std::numeric_limits<double>::infinity(), bound}};
}
[[nodiscard]] inline Measured at_least(std::string name, double value, double bound, std::string unit = {}) {
    return {std::move(name), value, std::move(unit), {bound, std::numeric_limits<double>::infinity()}};
}
[[nodiscard]] inline Measured within(std::string name, double value, double low, double high,
                                     std::string unit = {}) {
    return {std::move(name), value, std::move(unit), {low, high}};
}

/// One row of docs/techniques.md.
struct Technique {
    std::string name;          ///< the function in shading/
    std::string source;        ///< paper and section or equation
    std::string approximates;  ///< in a few words
    std::string truth;         ///< what the error is against, and over which inputs
    std::string unit;          ///< of the errors; empty: a pure number
    double mean_error = 0.0;
    double max_error = 0.0;
    std::function<double()> cost_ns;  ///< measures ns per call; runs alone, after all experiments
};

struct Findings {
    std::string text;  ///< what was found, also where a printed value does not reproduce
    std::vector<Measured> measured;
    std::vector<Plot> plots;
    std::vector<Panel> pictures;
    std::vector<Table> tables;
    std::vector<Technique> techniques;
};

struct Experiment {
    std::string paper;       ///< "Karis 2013"
    std::string reproduces;  ///< "Figure 2"
    std::string title;
    std::string computes;  ///< one or two sentences
    std::function<Findings()> run;
    std::string id = {};  ///< given by the registry
};

/// Every experiment, in the order of their ids.
[[nodiscard]] std::vector<Experiment> all_experiments();

/// The experiments with these ids, in this order; all when there are none. Throws Error (Fault::usage) for an
/// unknown id, with the nearest one as hint.
[[nodiscard]] std::vector<Experiment> select_experiments(std::vector<Experiment> known,
                                                         const std::vector<std::string>& ids);

}  // namespace candela::measure
