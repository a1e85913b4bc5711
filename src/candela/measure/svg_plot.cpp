#include "candela/measure/svg_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "candela/measure/numerics.hpp"

namespace candela::measure {
namespace {

/// Okabe & Ito 2008, without the yellow that is too pale for a line; black first.
constexpr std::array<const char*, 7> kPalette{"#000000", "#0072b2", "#d55e00", "#009e73",
                                              "#cc79a7", "#e69f00", "#56b4e9"};

constexpr double kWidth = 720.0;
constexpr double kLeft = 74.0;
constexpr double kRight = 24.0;
constexpr double kTop = 12.0;
constexpr double kHeight = 300.0;  ///< of the frame that holds the curves
constexpr double kBelow = 52.0;    ///< tick and axis labels
constexpr double kLegendLine = 20.0;
constexpr double kCharacter = 7.0;  ///< mean advance of the 12 px font, on the wide side

double forward(double value, Scale scale) {
    return scale == Scale::logarithmic ? std::log10(value) : value;
}

struct Range {
    double low;
    double high;
};

Range range_of(const Axis& axis, const std::vector<Series>& series, std::vector<double> Series::*data) {
    if (axis.low != axis.high) return {axis.low, axis.high};
    Range out{INFINITY, -INFINITY};
    for (const Series& s : series) {
        for (const double value : s.*data) {
            if (!std::isfinite(forward(value, axis.scale))) continue;
            out.low = std::min(out.low, value);
            out.high = std::max(out.high, value);
        }
    }
    if (!(out.low <= out.high)) return axis.scale == Scale::logarithmic ? Range{1.0, 10.0} : Range{0.0, 1.0};
    if (axis.scale == Scale::logarithmic)
        return out.low < out.high ? out : Range{out.low / 2.0, out.high * 2.0};
    const double margin = out.low < out.high ? 0.04 * (out.high - out.low) : std::max(1.0, std::abs(out.low));
    return {out.low - margin, out.high + margin};
}

/// Maps a value of one axis to 0..1 and knows its ticks.
class Mapping {
  public:
    Mapping(const Axis& axis, Range range)
        : scale_(axis.scale),
          step_(axis.step),
          range_(range),
          low_(forward(range.low, scale_)),
          high_(forward(range.high, scale_)) {}

    [[nodiscard]] double operator()(double value) const {
        return (forward(value, scale_) - low_) / (high_ - low_);
    }

    [[nodiscard]] std::vector<double> ticks(int count) const {
        if (scale_ == Scale::linear) return linear_ticks(range_.low, range_.high, count, step_);
        std::vector<double> out;
        const bool few = high_ - low_ < 2.5;
        for (int decade = int(std::floor(low_)); decade <= int(std::ceil(high_)); ++decade) {
            for (const double step : {1.0, 2.0, 5.0}) {
                if (!few && step != 1.0) continue;
                const double tick = step * std::pow(10.0, decade);
                if (tick >= range_.low * (1.0 - 1e-9) && tick <= range_.high * (1.0 + 1e-9))
                    out.push_back(tick);
            }
        }
        return out;
    }

  private:
    Scale scale_;
    double step_;
    Range range_;
    double low_;
    double high_;
};

std::string px(double value) {
    return fixed(value, 2);
}

std::string line(double x1, double y1, double x2, double y2, const char* color) {
    return "<line x1=\"" + px(x1) + "\" y1=\"" + px(y1) + "\" x2=\"" + px(x2) + "\" y2=\"" + px(y2) +
           "\" stroke=\"" + color + "\"/>";
}

std::string text(double x, double y, const char* anchor, const std::string& content) {
    return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" text-anchor=\"" + anchor + "\">" +
           xml_escaped(content) + "</text>";
}

std::string tick_label(double value) {
    return number(std::abs(value) < 1e-12 ? 0.0 : value, 6);
}

std::string stroke_attributes(const Series& series, const char* color) {
    std::string out = std::string("fill=\"none\" stroke=\"") + color + "\" stroke-width=\"2\"";
    if (series.stroke == Stroke::dashed) out += " stroke-dasharray=\"8 5\"";
    if (series.stroke == Stroke::dotted) out += " stroke-dasharray=\"2 4\"";
    return out;
}

std::string marker(double x, double y, const char* color) {
    return "<circle cx=\"" + px(x) + "\" cy=\"" + px(y) + "\" r=\"4\" fill=\"#fff\" stroke=\"" + color +
           "\" stroke-width=\"2\"/>";
}

std::string curve_of(const Series& series, const char* color, const Mapping& x, const Mapping& y,
                     double width) {
    std::string path;
    bool drawing = false;
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
        const double at_x = x(series.x[i]) * width;
        const double at_y = (1.0 - y(series.y[i])) * kHeight;
        if (!std::isfinite(at_x) || !std::isfinite(at_y)) {
            drawing = false;
            continue;
        }
        // Far outside the frame is enough: huge coordinates are no valid SVG numbers in some viewers.
        const double safe_y = std::clamp(at_y, -10.0 * kHeight, 10.0 * kHeight);
        path += (drawing ? "L" : "M") + px(at_x) + " " + px(safe_y);
        drawing = true;
    }
    return path.empty() ? "" : "<path d=\"" + path + "\" " + stroke_attributes(series, color) + "/>";
}

/// Markers are not cut at the frame; those outside of it are left out.
std::string markers_of(const Series& series, const char* color, const Mapping& x, const Mapping& y,
                       double width) {
    constexpr double slack = 1e-9;
    const auto inside = [](double at) { return at >= -slack && at <= 1.0 + slack; };
    std::string out;
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
        const double at_x = x(series.x[i]);
        const double at_y = y(series.y[i]);
        if (inside(at_x) && inside(at_y))
            out += marker(kLeft + at_x * width, kTop + (1.0 - at_y) * kHeight, color);
    }
    return out;
}

struct Legend {
    std::string svg;
    double height = 0.0;
};

Legend legend_of(const std::vector<Series>& series, const std::vector<const char*>& colors, double top) {
    Legend out;
    double x = kLeft;
    double y = top + 6.0;
    bool any = false;
    for (std::size_t i = 0; i < series.size(); ++i) {
        if (series[i].name.empty()) continue;
        const double width = 40.0 + kCharacter * double(series[i].name.size()) + 14.0;
        if (any && x + width > kWidth) {
            x = kLeft;
            y += kLegendLine;
        }
        any = true;
        if (series[i].stroke == Stroke::points) {
            out.svg += marker(x + 14.0, y - 4.0, colors[i]);
        } else {
            out.svg += "<path d=\"M" + px(x) + " " + px(y - 4.0) + "L" + px(x + 30.0) + " " + px(y - 4.0) +
                       "\" " + stroke_attributes(series[i], colors[i]) + "/>";
        }
        out.svg += text(x + 36.0, y, "start", series[i].name);
        x += width;
    }
    out.height = any ? y - top + 8.0 : 0.0;
    return out;
}

/// The least of 1, 2, 5 times a power of ten that is not below `rough`.
double round_step(double rough) {
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= rough) return factor * power;
    }
    return 10.0 * power;
}

}  // namespace

std::vector<double> linear_ticks(double low, double high, int count, double step) {
    if (!(high > low) || !std::isfinite(low) || !std::isfinite(high)) return {};
    if (!(step > 0.0)) step = round_step((high - low) / std::max(count, 1));

    std::vector<double> out;
    const double first = std::ceil(low / step - 1e-9);
    for (double i = first; i * step <= high + 1e-9 * step; ++i) out.push_back(i * step);
    return out;
}

std::string xml_escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

std::string svg_plot(const Plot& plot) {
    const Mapping x(plot.x, range_of(plot.x, plot.series, &Series::x));
    const Mapping y(plot.y, range_of(plot.y, plot.series, &Series::y));
    const double width = kWidth - kLeft - kRight;
    const double bottom = kTop + kHeight;

    std::vector<const char*> colors;
    int next = 0;
    for (const Series& s : plot.series) {
        const int index = s.color >= 0 ? s.color : next++;
        colors.push_back(kPalette[static_cast<std::size_t>(index) % kPalette.size()]);
    }
    const Legend legend = legend_of(plot.series, colors, bottom + kBelow);

    std::string body;
    for (const double tick : x.ticks(8)) {
        const double at = kLeft + x(tick) * width;
        body += line(at, kTop, at, bottom, "#e3e3e3") + text(at, bottom + 18.0, "middle", tick_label(tick));
    }
    for (const double tick : y.ticks(6)) {
        const double at = kTop + (1.0 - y(tick)) * kHeight;
        body += line(kLeft, at, kLeft + width, at, "#e3e3e3") +
                text(kLeft - 8.0, at + 4.0, "end", tick_label(tick));
    }
    // A nested <svg> cuts the curves at the frame without an id that a second plot on the page could share.
    body += "<svg x=\"" + px(kLeft) + "\" y=\"" + px(kTop) + "\" width=\"" + px(width) + "\" height=\"" +
            px(kHeight) + "\" overflow=\"hidden\">";
    std::string markers;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        if (plot.series[i].stroke == Stroke::points) {
            markers += markers_of(plot.series[i], colors[i], x, y, width);
        } else {
            body += curve_of(plot.series[i], colors[i], x, y, width);
        }
    }
    body += "</svg><rect x=\"" + px(kLeft) + "\" y=\"" + px(kTop) + "\" width=\"" + px(width) +
            "\" height=\"" + px(kHeight) + "\" fill=\"none\" stroke=\"#555\"/>" + markers;
    body += text(kLeft + 0.5 * width, bottom + 38.0, "middle", plot.x.label);
    const double middle = kTop + 0.5 * kHeight;
    body += "<text transform=\"translate(16 " + px(middle) + ") rotate(-90)\" text-anchor=\"middle\">" +
            xml_escaped(plot.y.label) + "</text>";
    const double height = bottom + kBelow + legend.height;
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + px(kWidth) + " " + px(height) +
           "\" role=\"img\" font-family=\"system-ui, sans-serif\" font-size=\"12\" fill=\"#222\"><title>" +
           xml_escaped(plot.title) + "</title>" + body + legend.svg + "</svg>";
}

}  // namespace candela::measure
