#include "candela/measure/drawing.hpp"

#include <algorithm>
#include <cmath>

#include "candela/measure/numerics.hpp"
#include "candela/measure/stroke_font.hpp"
#include "candela/measure/svg_plot.hpp"

namespace candela::measure {
namespace {

std::string px(double value) {
    return fixed(value, 2);
}

std::string hex(std::uint32_t color) {
    constexpr const char* digits = "0123456789abcdef";
    std::string out = "#";
    for (int shift = 20; shift >= 0; shift -= 4) out += digits[(color >> shift) & 0xf];
    return out;
}

std::string svg_line(const DrawnLine& line) {
    std::string path;
    for (std::size_t i = 0; i < line.points.size(); ++i)
        path += (i == 0 ? "M" : "L") + px(line.points[i].x) + " " + px(line.points[i].y);
    std::string out = "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + hex(line.color) +
                      "\" stroke-width=\"" + px(line.width) + "\" stroke-linejoin=\"round\"";
    if (line.dash > 0.0) out += " stroke-dasharray=\"" + px(line.dash) + "\"";
    return out + "/>";
}

std::string svg_text(const DrawnText& text) {
    constexpr const char* anchors[] = {"start", "middle", "end"};
    std::string out = "<text x=\"" + px(text.at.x) + "\" y=\"" + px(text.at.y) + "\" text-anchor=\"" +
                      anchors[std::size_t(text.anchor)] + "\" font-size=\"" + px(text.size) + "\" fill=\"" +
                      hex(text.color) + '"';
    if (text.halo)
        out += " stroke=\"#ffffff\" stroke-width=\"4\" stroke-linejoin=\"round\" paint-order=\"stroke\"";
    return out + ">" + xml_escaped(text.text) + "</text>";
}

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double length2 = along.x * along.x + along.y * along.y;
    const glm::dvec2 from = p - a;
    const double t =
        length2 > 0.0 ? std::clamp((from.x * along.x + from.y * along.y) / length2, 0.0, 1.0) : 0.0;
    return std::hypot(from.x - t * along.x, from.y - t * along.y);
}

/// Pixels that a pen covers, and how much: one layer of one colour, so that strokes that cross add nothing.
class Layer {
  public:
    Layer(std::uint32_t width, std::uint32_t height)
        : width_(width), height_(height), cover_(std::size_t{width} * height) {}

    /// Points in pixels; one alone is a dot.
    void stroke(const std::vector<glm::dvec2>& points, double width) {
        if (points.size() == 1) segment(points[0], points[0], 1.5 * width);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) segment(points[i], points[i + 1], width);
    }
    void put(std::uint32_t color, std::vector<std::uint8_t>& rgb) {
        for (std::size_t i = 0; i < cover_.size(); ++i) {
            if (cover_[i] <= 0.0f) continue;
            for (std::size_t c = 0; c < 3; ++c) {
                const float ink = float((color >> (16 - 8 * c)) & 0xff);
                std::uint8_t& value = rgb[3 * i + c];
                value = std::uint8_t(std::lround(std::lerp(float(value), ink, cover_[i])));
            }
            cover_[i] = 0.0f;
        }
    }

  private:
    /// Coverage by the distance of the pixel's centre, which is right for lines wider than a pixel and close
    /// for thin ones.
    void segment(const glm::dvec2& a, const glm::dvec2& b, double width) {
        const double radius = 0.5 * width, reach = radius + 1.0;
        const auto clamped = [](double value, std::uint32_t size) {
            return std::uint32_t(std::clamp(value, 0.0, double(size)));
        };
        const std::uint32_t left = clamped(std::floor(std::min(a.x, b.x) - reach), width_);
        const std::uint32_t right = clamped(std::ceil(std::max(a.x, b.x) + reach), width_);
        const std::uint32_t top = clamped(std::floor(std::min(a.y, b.y) - reach), height_);
        const std::uint32_t bottom = clamped(std::ceil(std::max(a.y, b.y) + reach), height_);
        for (std::uint32_t y = top; y < bottom; ++y) {
            for (std::uint32_t x = left; x < right; ++x) {
                const double d = distance_to_segment({x + 0.5, y + 0.5}, a, b);
                const double inside = std::clamp(radius + 0.5 - d, 0.0, std::min(1.0, width));
                float& cover = cover_[std::size_t{y} * width_ + x];
                cover = std::max(cover, float(inside));
            }
        }
    }

    std::uint32_t width_;
    std::uint32_t height_;
    std::vector<float> cover_;
};

/// The pieces of a line that a pen draws when it is lifted for every other `length`.
std::vector<std::vector<glm::dvec2>> dashes(const std::vector<glm::dvec2>& points, double length) {
    std::vector<std::vector<glm::dvec2>> out;
    if (points.empty()) return out;
    bool down = true;
    double left = length;
    out.push_back({points.front()});
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        glm::dvec2 at = points[i];
        double rest = std::hypot(points[i + 1].x - at.x, points[i + 1].y - at.y);
        while (rest > left) {
            at += (points[i + 1] - at) * (left / rest);
            rest -= left;
            if (down) out.back().push_back(at);
            down = !down;
            if (down) out.push_back({at});
            left = length;
        }
        left -= rest;
        if (down) out.back().push_back(points[i + 1]);
    }
    return out;
}

void draw_line(const DrawnLine& line, double scale, Layer& layer, std::vector<std::uint8_t>& rgb) {
    std::vector<glm::dvec2> points = line.points;
    for (glm::dvec2& p : points) p *= scale;
    if (line.dash > 0.0) {
        for (const auto& piece : dashes(points, line.dash * scale)) layer.stroke(piece, line.width * scale);
    } else {
        layer.stroke(points, line.width * scale);
    }
    layer.put(line.color, rgb);
}

void draw_text(const DrawnText& text, double scale, Layer& layer, std::vector<std::uint8_t>& rgb) {
    constexpr double cap_height = 0.7, pen = 0.095;
    const StrokedText letters = stroked(text.text);
    const double unit = cap_height * text.size / kStrokeCapHeight;
    const double shift = letters.width * unit * 0.5 * double(std::size_t(text.anchor));
    const auto draw = [&](double width, std::uint32_t color) {
        for (std::vector<glm::dvec2> line : letters.lines) {
            for (glm::dvec2& p : line) p = (text.at + glm::dvec2(p.x * unit - shift, p.y * unit)) * scale;
            layer.stroke(line, width * scale);
        }
        layer.put(color, rgb);
    };
    if (text.halo) draw(4.0, 0xffffff);
    draw(pen * text.size, text.color);
}

}  // namespace

std::string svg_of(const Drawing& drawing) {
    std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + px(drawing.width) +
                      "\" height=\"" + px(drawing.height) + "\" viewBox=\"0 0 " + px(drawing.width) + " " +
                      px(drawing.height) + "\" role=\"img\" font-family=\"system-ui, sans-serif\"><title>" +
                      xml_escaped(drawing.title) +
                      "</title><rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    for (const DrawnLine& line : drawing.lines) out += svg_line(line) + "\n";
    for (const DrawnText& text : drawing.texts) out += svg_text(text) + "\n";
    return out + "</svg>\n";
}

Panel picture_of(const Drawing& drawing, double scale) {
    Panel out;
    out.title = drawing.title;
    out.width = std::uint32_t(std::ceil(drawing.width * scale));
    out.height = std::uint32_t(std::ceil(drawing.height * scale));
    out.rgb.assign(std::size_t{3} * out.width * out.height, 0xff);
    Layer layer(out.width, out.height);
    for (const DrawnLine& line : drawing.lines) draw_line(line, scale, layer, out.rgb);
    for (const DrawnText& text : drawing.texts) draw_text(text, scale, layer, out.rgb);
    return out;
}

}  // namespace candela::measure
