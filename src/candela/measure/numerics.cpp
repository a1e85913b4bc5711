#include "candela/measure/numerics.hpp"

#include <cstdio>

namespace candela::measure {
namespace {

std::string printed(const char* format, int digits, double value) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, digits, value);
    return text.data();
}

}  // namespace

std::vector<double> linspace(double low, double high, int count) {
    std::vector<double> out;
    for (int i = 0; i < count; ++i) out.push_back(low + (high - low) * i / (count - 1));
    return out;
}

std::vector<double> logspace(double low, double high, int count) {
    std::vector<double> out = linspace(std::log(low), std::log(high), count);
    for (double& x : out) x = std::exp(x);
    return out;
}

std::string number(double value, int digits) {
    return printed("%.*g", digits, value);
}

std::string fixed(double value, int decimals) {
    return printed("%.*f", decimals, value);
}

}  // namespace candela::measure
