#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "candela/measure/color_map.hpp"
#include "candela/measure/report_html.hpp"
#include "candela/measure/report_pixels.hpp"
#include "process.hpp"
#include "shading/tone_curves.glsl"
#include "shading/transfer.glsl"
#include "source_folder.hpp"
#include "test_pictures.hpp"

using namespace candela::measure;
using namespace candela::test;
using nlohmann::json;

namespace {

constexpr float kExposure = 0.004f;

/// Row 4 runs over seven stops and the colours of a wheel; a quarter brighter in the tested picture.
Picture test_picture(float factor) {
    Picture p = draw(64, 48, [&](int x, int y) {
        const float light = 4.0f * std::exp2(0.5f * float(x % 16)) * factor;
        return light * glm::vec3(1.0f, 0.6f + 0.4f * std::sin(float(x)), 0.3f + 0.01f * float(y));
    });
    p.pixels[0].y = std::nanf("");
    return p;
}

Report test_report() {
    Report report;
    report.title = "a report";
    report.options.exposure = kExposure;
    report.version = "test";
    const Picture r = test_picture(1.0f), x = test_picture(1.25f);
    report.pictures.push_back({"tested", x, {{"profile", "mobile"}}, compare(x, r, report.options)});
    report.pictures.push_back({"truth", r, {{"profile", "best"}}, {}});
    report.reference = 1;
    return report;
}

bool has_chromium() {
    return std::system("command -v chromium >/dev/null 2>&1") == 0;
}

/// The report in headless Chromium under report_drive.js: what the page said.
json drive(const Report& report, const std::string& fragment, const std::string& window = "1000,600") {
    const TemporaryFolder folder;
    std::string page = report_html(report);
    const std::string script = slurp(CANDELA_SOURCE_DIR "/tests/measure/report_drive.js");
    page.insert(page.rfind("</body>"), "<script>" + script + "</script>");
    std::ofstream(folder / "report.html") << page;
    const std::string command =
        "timeout 100 chromium --headless --no-sandbox --disable-dev-shm-usage --use-angle=swiftshader "
        "--enable-unsafe-swiftshader --hide-scrollbars --virtual-time-budget=30000 --window-size=" +
        window + " --user-data-dir=" + (folder / "profile") + " --dump-dom 'file://" +
        (folder / "report.html") + fragment + "' >" + (folder / "dom") + " 2>" + (folder / "log");
    const int status = std::system(command.c_str());
    const std::string dom = slurp(folder / "dom");
    const std::size_t begin = dom.rfind("BEGIN{"), end = dom.rfind("}END");
    if (begin == std::string::npos || end == std::string::npos) {
        ADD_FAILURE() << "status " << status << ", " << slurp(folder / "log").substr(0, 2000)
                      << dom.substr(0, 500);
        return {};
    }
    std::string text = dom.substr(begin + 5, end - begin - 4);
    for (std::size_t at; (at = text.find("&lt;")) != std::string::npos;) text.replace(at, 4, "<");
    return json::parse(text);
}

/// What the display must show, by the renderer's own functions.
glm::vec3 shown(const glm::vec3& nit, float exposure) {
    const glm::vec3 toned =
        candela::shading::display_from_exposed(candela::shading::kToneNeutral, nit * exposure);
    return 255.0f * candela::shading::srgb_from_linear(candela::shading::saturate(toned));
}

void expect_color(const json& rgb, const glm::vec3& expected, const std::string& what) {
    // Half floats keep eleven bits and the screen eight.
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(rgb[std::size_t(c)], expected[c], 1.2f) << what << " channel " << c;
}

void check(const json& page, const Report& report) {
    const Picture& x = report.pictures[0].picture;
    const Picture& r = report.pictures[1].picture;
    const auto index = [](std::size_t column, std::size_t row) { return row * 64 + column; };
    EXPECT_GT(page["zoom"], 1.0);
    EXPECT_TRUE(page["fits"]);
    EXPECT_NEAR(page["split"], 0.001, 0.002);
    for (std::size_t i = 0; i < 16; ++i) {
        const std::string column = "column " + std::to_string(i);
        expect_color(page["rowOfA"][i], shown(x.pixels[index(i, 4)], kExposure), "A " + column);
        expect_color(page["rowOfB"][i], shown(r.pixels[index(i, 4)], kExposure), "B " + column);
        expect_color(page["rowOfBTwoStopsDown"][i], shown(r.pixels[index(i, 4)], kExposure / 4.0f),
                     "B two stops down, " + column);
    }
    EXPECT_EQ(page["exposureText"], "-2.0 EV");
    EXPECT_EQ(page["stopsAfterReset"], 0.0);
    EXPECT_EQ(page["position"], "x 3, y 4");
    EXPECT_EQ(page["positionZoomed"], "x 3, y 4");
    ASSERT_EQ(page["readout"].size(), 2u);
    for (std::size_t n = 0; n < 2; ++n) {
        const glm::vec3 nit = report.pictures[n].picture.pixels[index(3, 4)];
        const json& line = page["readout"][n];
        EXPECT_EQ(line[0], report.pictures[n].name);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(std::stof(line[std::size_t(c + 1)].get<std::string>()) / nit[c], 1.0f, 1e-3f);
        EXPECT_NEAR(std::stof(line[4].get<std::string>()) / candela::shading::luminance(nit), 1.0f, 1e-3f);
    }
    const float flip = report.pictures[0].comparison.flip.values[index(3, 4)];
    EXPECT_NEAR(std::stof(page["readout"][0][5].get<std::string>()), flip, 0.003f);
    const glm::vec3 difference = glm::abs(x.pixels[index(3, 4)] - r.pixels[index(3, 4)]) * kExposure;
    expect_color(page["difference"], 255.0f * candela::shading::srgb_from_linear(difference), "difference");
    const Rgb8 heat = magma(std::round(flip * 254.0f) / 254.0f);
    expect_color(page["flip"], {heat[0], heat[1], heat[2]}, "FLIP");
    EXPECT_EQ(page["legend"], "flex");
    EXPECT_EQ(page["panes"], 2);
    expect_color(page["noValue"], {255.0f, 0.0f, 255.0f}, "a pixel without a value");
    EXPECT_NEAR(page["zoomed"], 4.0, 1e-6);
    expect_color(page["stays"], shown(x.pixels[index(3, 4)], kExposure), "under the cursor after zooming");
    EXPECT_EQ(page["metrics"]["nonfinite"], "1");
}

/// As `compare SCENE` makes it: real time is not the first of the tested pictures.
Report scene_report() {
    Report report = test_report();
    report.pictures[0].name = "integrate";
    report.pictures[0].settings = {{"mode", "integrate"}};
    report.pictures[1].name = "path";
    report.pictures[1].settings = {{"mode", "path"}};
    ReportPicture frame = report.pictures[0];
    frame.name = "realtime frostbite";
    frame.settings = {{"mode", "realtime"},
                      {"device", "a device whose name is longer than the column is wide"}};
    frame.verdict = "realtime frostbite is close to path.";
    frame.paths = {{"environment and indirect diffuse", 1234.5, 1300.25, 65.75, 1.0}};
    report.pictures.push_back(frame);
    frame.name = "realtime mobile";
    report.pictures.push_back(frame);
    report.noise = frame.comparison.metrics;
    report.noise->flip = 0.0125;
    report.command = "candela compare scene.glb --stage 'a stage.json' -o report.html";
    return report;
}

}  // namespace

TEST(Report, Base64IsThatOfTheStandard) {
    const auto encode = [](const std::string& text) { return detail::base64({text.begin(), text.end()}); };
    EXPECT_EQ(encode(""), "");
    EXPECT_EQ(encode("f"), "Zg==");
    EXPECT_EQ(encode("fo"), "Zm8=");
    EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
}

TEST(Report, HalfScaleKeepsTheBrightestPixel) {
    Picture p = uniform(2, 2, glm::vec3(100.0f));
    EXPECT_EQ(detail::half_scale({&p}, 0.01f), 1.0f / 128.0f);
    p.pixels[1] = glm::vec3(1e9f);
    p.pixels[2] = glm::vec3(std::numeric_limits<float>::infinity());
    const float scale = detail::half_scale({&p}, 0.01f);
    EXPECT_LE(1e9f * scale, 65504.0f);
    EXPECT_GT(1e9f * scale, 65504.0f / 2.1f);
}

TEST(Report, IsWholeAndTheSameEachTime) {
    const Report report = test_report();
    const std::string page = report_html(report);
    EXPECT_EQ(page, report_html(report));
    for (const char* mark :
         {"/*STYLE*/", "/*SCRIPT*/", "<!--SHADER-->", "<!--PIXELS-->", "<!--REPORT-->", "#include"})
        EXPECT_EQ(page.find(mark), std::string::npos) << mark;
}

TEST(Report, ShowsInChromiumWhatTheRendererWould) {
    if (!has_chromium()) GTEST_SKIP() << "no chromium";
    const Report report = test_report();
    const json page = drive(report, "");
    ASSERT_FALSE(page.is_null());
    EXPECT_EQ(page["ready"], "WebGL2");
    check(page, report);
}

TEST(Report, ShowsTheSameWithoutWebGl) {
    if (!has_chromium()) GTEST_SKIP() << "no chromium";
    const Report report = test_report();
    const json page = drive(report, "#2d");
    ASSERT_FALSE(page.is_null());
    EXPECT_EQ(page["ready"], "2D canvas");
    check(page, report);
}

TEST(Report, OpensOnRealTimeWithEverythingInViewAt1280Pixels) {
    if (!has_chromium()) GTEST_SKIP() << "no chromium";
    const json page = drive(scene_report(), "#2d", "1280,720");
    EXPECT_EQ(page["opened"], "realtime frostbite");
    EXPECT_EQ(page["clipped"], json::array());
    EXPECT_NE(page["verdicts"].get<std::string>().find("is close to path"), std::string::npos);
    ASSERT_EQ(page["noise"].size(), 4u);
    EXPECT_EQ(page["noise"][3], "0.01250");
    ASSERT_EQ(page["paths"].size(), 2u);
    EXPECT_NE(page["paths"][0].get<std::string>().find("100 %"), std::string::npos);
    EXPECT_EQ(page["command"], scene_report().command);
}
