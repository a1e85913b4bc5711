#include <gtest/gtest.h>

#include <cmath>

#include "candela/measure/svg_plot.hpp"
#include "tests/validate/markup.hpp"

namespace candela::measure {
namespace {

Plot awkward() {
    Plot plot{"a < b & \"c\"", "", {"x, m"}, {"y, cd", 1e-3, 1e3, Scale::logarithmic}, {}};
    plot.series.push_back(
        {"line & dots", {0.0, 1.0, 2.0, 3.0, 4.0}, {1.0, std::nan(""), INFINITY, -5.0, 1e300}});
    plot.series.push_back({"<points>", {1.0, 2.0}, {10.0, 100.0}, Stroke::points});
    plot.series.push_back({"", {}, {}, Stroke::dotted});
    return plot;
}

TEST(SvgPlot, IsWellFormedAndFiniteWhateverTheData) {
    for (const Plot& plot :
         {awkward(), Plot{"empty", "", {"x"}, {"y"}, {}},
          Plot{"constant", "", {"x"}, {"y"}, {{"c", {1.0, 2.0}, {0.0, 0.0}}}},
          Plot{"one point", "", {"x"}, {"y", 0, 0, Scale::logarithmic}, {{"p", {1.0}, {5.0}}}}}) {
        const std::string svg = svg_plot(plot);
        EXPECT_EQ(test::markup_fault(svg), "") << plot.title;
        EXPECT_EQ(test::not_finite(svg), "") << plot.title;
    }
}

TEST(SvgPlot, NamesAxesAndSeriesAndEscapesThem) {
    const std::string svg = svg_plot(awkward());
    for (const char* expected :
         {"x, m", "y, cd", "line &amp; dots", "&lt;points&gt;", "a &lt; b &amp; &quot;c&quot;"})
        EXPECT_NE(svg.find(expected), std::string::npos) << expected;
}

TEST(SvgPlot, DrawsWhatItIsGiven) {
    Plot plot{"", "", {"x", 0.0, 1.0}, {"y", 0.0, 1.0}, {{"s", {0.0, 1.0}, {0.0, 1.0}}}};
    // From the lower left corner of the frame to its upper right one, in the frame's own coordinates.
    EXPECT_NE(svg_plot(plot).find("M0.00 300.00L622.00 0.00"), std::string::npos) << svg_plot(plot);
    plot.series[0].stroke = Stroke::points;
    const auto circles = [](const std::string& svg) {
        std::size_t count = 0;
        for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1))
            ++count;
        return count;
    };
    EXPECT_EQ(circles(svg_plot(plot)), 3u) << "two points and the legend";
    plot.series[0].x[1] = 7.0;  // outside of the frame
    EXPECT_EQ(circles(svg_plot(plot)), 2u);
}

TEST(SvgPlot, TicksAreRoundAndInside) {
    EXPECT_EQ(linear_ticks(0.0, 1.0, 5), (std::vector<double>{0.0, 0.2, 2 * 0.2, 3 * 0.2, 0.8, 1.0}));
    EXPECT_EQ(linear_ticks(-90.0, 90.0, 5, 45.0), (std::vector<double>{-90.0, -45.0, 0.0, 45.0, 90.0}));
    EXPECT_TRUE(linear_ticks(1.0, 1.0, 5).empty());
    EXPECT_TRUE(linear_ticks(0.0, INFINITY, 5).empty());
    for (const double tick : linear_ticks(-0.137, 0.0042, 6)) {
        EXPECT_GE(tick, -0.137);
        EXPECT_LE(tick, 0.0042);
    }
}

}  // namespace
}  // namespace candela::measure
