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

std::string readable(double value) {
    return number(value, std::abs(value) >= 1000.0 ? 6 : 4);
}

std::string cost_text(double ns) {
    if (ns < 1000.0 || !std::isfinite(ns)) return number(ns, 3);
    const double unit = std::pow(10.0, std::floor(std::log10(ns)) - 2.0);
    return fixed(unit * std::round(ns / unit), 0);
}

std::string fixed(double value, int decimals) {
    const std::string text = printed("%.*f", decimals, value);
    const bool zero = text.find_first_not_of("-0.") == std::string::npos;
    return zero && text[0] == '-' ? text.substr(1) : text;
}

}  // namespace candela::measure
