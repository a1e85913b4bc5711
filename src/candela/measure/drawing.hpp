#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "candela/measure/experiment.hpp"

/// One description of a line drawing for two backends, SVG and pixels. Coordinates are px at scale 1, y down.
namespace candela::measure {

struct DrawnLine {
    std::vector<glm::dvec2> points;
    std::uint32_t color = 0x000000;  ///< 0xrrggbb
    double width = 1.0;
    double dash = 0.0;  ///< length of the dashes and of the gaps between; 0: solid
};

enum class Anchor : std::uint8_t { start, middle, end };

struct DrawnText {
    glm::dvec2 at{0.0};  ///< on the baseline
    std::string text;    ///< UTF-8
    Anchor anchor = Anchor::start;
    double size = 12.0;  ///< of the font; capitals are 0.7 of it high
    std::uint32_t color = 0x222222;
    bool halo = false;  ///< white around the letters, over lines
};

struct Drawing {
    std::string title;  ///< for who cannot see it
    double width = 0.0;
    double height = 0.0;
    std::vector<DrawnLine> lines;  ///< drawn in this order, texts on top
    std::vector<DrawnText> texts;
};

/// An <svg> element, a document of its own.
[[nodiscard]] std::string svg_of(const Drawing& drawing);

/// Anti-aliased on white, `scale` pixels a px. Letters are strokes (stroke_font.hpp).
[[nodiscard]] Panel picture_of(const Drawing& drawing, double scale);

}  // namespace candela::measure
