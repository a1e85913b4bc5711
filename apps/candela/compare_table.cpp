#include "compare_table.hpp"

#include <algorithm>
#include <cstdio>

namespace candela::app {
namespace {

constexpr int kLeastWidth = 14;

/// Characters of UTF-8: bytes that do not continue one.
int characters(const std::string& text) {
    return static_cast<int>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

}  // namespace

void print(const MetricTable& table) {
    std::printf("%*s", kLeastWidth, "");
    for (const std::string& name : table.pictures)
        std::printf("  %*s%s", std::max(kLeastWidth - characters(name), 0), "", name.c_str());
    std::printf("\n");
    for (const MetricTable::Row& row : table.rows) {
        std::printf("%-*s", kLeastWidth, row.metric.c_str());
        for (std::size_t i = 0; i < row.values.size(); ++i)
            std::printf("  %*.6g", std::max(kLeastWidth, characters(table.pictures[i])), row.values[i]);
        std::printf("\n");
    }
}

}  // namespace candela::app
