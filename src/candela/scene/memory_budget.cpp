#include "candela/scene/memory_budget.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include "candela/scene/error.hpp"

namespace candela::scene {
namespace {

constexpr std::uint64_t kGiB = std::uint64_t{1} << 30;
constexpr std::uint64_t kUnknown = 8 * kGiB;

/// The number after `key` in a file of "key: number kB" lines, in bytes.
std::optional<std::uint64_t> kilobytes_of(const char* file, const std::string& key) {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        if (!line.starts_with(key)) continue;
        std::istringstream rest(line.substr(key.size()));
        if (std::uint64_t value = 0; rest >> value) return value * 1024;
    }
    return std::nullopt;
}

/// A file of one number; "max" is none.
std::optional<std::uint64_t> number_in(const std::string& file) {
    std::ifstream stream(file);
    std::uint64_t value = 0;
    if (stream >> value) return value;
    return std::nullopt;
}

void lower(std::uint64_t& left, const std::optional<std::uint64_t>& limit,
           const std::optional<std::uint64_t>& used) {
    if (limit) left = std::min(left, *limit > used.value_or(0) ? *limit - used.value_or(0) : 0);
}

/// The group of this process and all above it.
void lower_by_control_groups(std::uint64_t& left) {
    std::ifstream stream("/proc/self/cgroup");
    for (std::string line; std::getline(stream, line);) {
        const std::size_t colon = line.rfind(':');
        if (colon == std::string::npos) continue;
        const bool version_2 = line.starts_with("0::");
        if (!version_2 && line.find(":memory:") == std::string::npos) continue;
        const std::string root = version_2 ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
        std::string path = line.substr(colon + 1);
        while (true) {
            const std::string folder = root + path + (path.ends_with('/') ? "" : "/");
            if (version_2)
                lower(left, number_in(folder + "memory.max"), number_in(folder + "memory.current"));
            else
                lower(left, number_in(folder + "memory.limit_in_bytes"),
                      number_in(folder + "memory.usage_in_bytes"));
            if (path.empty() || path == "/") break;
            path.erase(path.rfind('/'));
        }
    }
}

}  // namespace

void MemoryBudget::require(std::uint64_t needed_bytes, const std::string& what,
                           const std::string& where) const {
    if (needed_bytes <= bytes) return;
    throw machine_error(what + " " + memory_text(needed_bytes) + " of memory, " +
                            (stated ? "--memory allows " : "there are ") + memory_text(bytes),
                        where, stated ? "a larger --memory" : "close other programs, or try --memory SIZE");
}

MemoryBudget available_memory() {
    std::uint64_t left = kilobytes_of("/proc/meminfo", "MemAvailable:").value_or(kUnknown);
    lower_by_control_groups(left);
    rlimit space{};
    if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
        lower(left, static_cast<std::uint64_t>(space.rlim_cur), kilobytes_of("/proc/self/status", "VmSize:"));
    return {left / 8 * 7, false};
}

std::string memory_text(std::uint64_t bytes) {
    static constexpr std::array units{"bytes", "KiB", "MiB", "GiB", "TiB"};
    auto value = static_cast<double>(bytes);
    std::size_t unit = 0;
    while (value >= 1024.0 && unit + 1 < units.size()) value /= 1024.0, ++unit;
    char text[32];
    std::snprintf(text, sizeof(text), value < 10.0 && unit > 0 ? "%.1f %s" : "%.0f %s", value, units[unit]);
    return text;
}

MemoryBudget memory_from_text(const std::string& text, const std::string& where) {
    double number = 0.0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    std::string unit(stop, end);
    unit.erase(0,
               unit.find_first_not_of(' ') == std::string::npos ? unit.size() : unit.find_first_not_of(' '));
    static constexpr const char* letters = "KMGT";
    double factor = 1.0;
    bool good = error == std::errc{} && number > 0.0;
    if (good && !unit.empty() && unit != "B") {
        const auto letter = std::find(letters, letters + 4, static_cast<char>(std::toupper(unit[0])));
        const std::string rest = unit.substr(1);
        good = letter != letters + 4 && (rest.empty() || rest == "B" || rest == "iB" || rest == "b");
        for (const char* l = letters; good && l <= letter; ++l) factor *= 1024.0;
    }
    const double bytes = number * factor;
    if (!good || !(bytes >= 1.0) || bytes > 1e18)
        throw Error(Fault::usage, "not an amount of memory: " + text, where, "such as 6G or 800M");
    return {static_cast<std::uint64_t>(bytes), true};
}

}  // namespace candela::scene
