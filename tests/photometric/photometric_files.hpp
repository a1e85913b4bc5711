#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

/// Photometric files written byte by byte, from a distribution or from numbers.
namespace candela::test {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Intensity over the file's own angles in degrees: (horizontal or C, vertical or gamma).
using Distribution = std::function<double(double, double)>;

inline std::vector<double> steps(double from, double to, double step) {
    std::vector<double> out;
    for (int i = 0; from + i * step <= to + 1e-9; ++i) out.push_back(from + i * step);
    return out;
}

inline std::string listed(const std::vector<double>& values, const char* separator = " ") {
    std::ostringstream out;
    out.precision(9);
    for (std::size_t i = 0; i < values.size(); ++i) out << (i > 0 ? separator : "") << values[i];
    return out.str();
}

struct IesFile {
    std::string first_line = "IESNA:LM-63-2002";
    std::vector<std::string> labels{"[TEST] T1", "[MANUFAC] Maker", "[LUMINAIRE] Lamp of tests"};
    std::string tilt = "TILT=NONE";
    int lamps = 1;
    double lumens = -1.0;
    double multiplier = 1.0;
    int type = 1;   ///< 1 C, 2 B, 3 A
    int units = 2;  ///< 1 feet, 2 metres
    std::vector<double> size{0.0, 0.0, 0.0};
    double ballast = 1.0;
    double factor = 1.0;
    double watts = 10.0;
    std::vector<double> vertical{0.0, 90.0, 180.0};
    std::vector<double> horizontal{0.0};
    Distribution intensity = [](double, double) { return 100.0; };

    [[nodiscard]] std::string bytes(const char* line_end = "\r\n") const {
        std::ostringstream out;
        out.precision(9);
        out << first_line << line_end;
        for (const std::string& label : labels) out << label << line_end;
        out << tilt << line_end;
        out << lamps << ' ' << lumens << ' ' << multiplier << ' ' << vertical.size() << ' '
            << horizontal.size() << ' ' << type << ' ' << units << ' ' << listed(size) << line_end;
        out << ballast << ' ' << factor << ' ' << watts << line_end;
        out << listed(vertical) << line_end << listed(horizontal) << line_end;
        for (const double h : horizontal) {
            std::vector<double> row;
            for (const double v : vertical) row.push_back(intensity(h, v));
            out << listed(row) << line_end;
        }
        return out.str();
    }
};

struct LampSet {
    int count = 1;
    double lumens = 1000.0;
    std::string color = "3000";
    double watts = 20.0;
};

struct LdtFile {
    int symmetry = 1;
    std::vector<double> planes{0.0};
    std::vector<double> gammas{0.0, 90.0, 180.0};
    double conversion = 1.0;
    double downward_percent = 50.0;
    double output_percent = 100.0;
    std::vector<LampSet> sets{LampSet{}};
    std::vector<double> size_mm = std::vector<double>(9, 0.0);
    /// Half-planes in the file, as degrees, in its order; empty: as the symmetry has it.
    Distribution per_klm = [](double, double) { return 100.0; };

    [[nodiscard]] std::vector<double> stored_planes() const {
        const std::size_t n = planes.size();
        std::size_t first = 0, count = n;
        if (symmetry == 1) count = 1;
        if (symmetry == 2) count = n / 2 + 1;
        if (symmetry == 3) first = 3 * n / 4, count = n / 2 + 1;
        if (symmetry == 4) count = n / 4 + 1;
        std::vector<double> out;
        for (std::size_t i = 0; i < count; ++i) out.push_back(planes[(first + i) % n]);
        return out;
    }
    [[nodiscard]] std::vector<std::string> lines() const {
        std::vector<std::string> out{"Maker",
                                     "3",
                                     std::to_string(symmetry),
                                     std::to_string(planes.size()),
                                     "0",
                                     std::to_string(gammas.size()),
                                     "0",
                                     "R1",
                                     "Lamp of tests",
                                     "N1",
                                     "f.ldt",
                                     "today"};
        const auto add = [&](const std::vector<double>& values) {
            for (const double v : values) out.push_back(listed({v}));
        };
        add(size_mm);
        add({downward_percent, output_percent, conversion, 0.0, double(sets.size())});
        for (const LampSet& set : sets) {
            add({double(set.count)});
            out.push_back("LED");
            add({set.lumens});
            out.push_back(set.color);
            out.push_back("80");
            add({set.watts});
        }
        add(std::vector<double>(10, 0.5));
        add(planes);
        add(gammas);
        for (const double c : stored_planes()) {
            for (const double gamma : gammas) add({per_klm(c, gamma)});
        }
        return out;
    }
    [[nodiscard]] std::string bytes(const char* line_end = "\r\n") const {
        std::string out;
        for (const std::string& line : lines()) out += line + line_end;
        return out;
    }
};

}  // namespace candela::test
