#pragma once

#include <string>
#include <vector>

namespace candela::app {

/// Metrics down, pictures across, as people read it.
struct MetricTable {
    struct Row {
        std::string metric;
        std::vector<double> values;  ///< one a picture
    };
    std::vector<std::string> pictures;
    std::vector<Row> rows;
};

/// On standard output; a column is as wide as its picture's name.
void print(const MetricTable& table);

}  // namespace candela::app
