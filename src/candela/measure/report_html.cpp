#include "candela/measure/report_html.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "candela/measure/color_map.hpp"
#include "candela/measure/report_pixels.hpp"
#include "candela_report/files.hpp"

namespace candela::measure {
namespace {

using nlohmann::json;

/// JSON has no infinity: the PSNR of equal pictures is null.
json number(double value) {
    return std::isfinite(value) ? json(value) : json(nullptr);
}

json metrics_json(const Metrics& m) {
    json out = json::object();
    for (const std::string& name : metric_names())
        if (const auto value = metric_value(m, name)) out[name] = number(*value);
    return out;
}

json paths_json(const std::vector<PathError>& paths) {
    json out = json::array();
    for (const PathError& row : paths)
        out.push_back({{"path", row.path},
                       {"reference", number(row.reference_mean_nit)},
                       {"picture", number(row.picture_mean_nit)},
                       {"error", number(row.mean_absolute_nit)},
                       {"share", number(row.share)}});
    return out;
}

/// Text inside a script element must not close it, whatever a file is called.
std::string script_text(const json& value) {
    const std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    std::string out;
    for (const char c : text) {
        if (c == '<')
            out += "\\u003c";
        else
            out += c;
    }
    return out;
}

void replace(std::string& page, const std::string& mark, const std::string& text) {
    const std::size_t at = page.find(mark);
    if (at == std::string::npos) throw std::logic_error("report template lacks " + mark);
    page.replace(at, mark.size(), text);
}

std::string html_text(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '<' || c == '&')
            out += c == '<' ? "&lt;" : "&amp;";
        else
            out += c;
    }
    return out;
}

/// WebGL has no #include; the order of the files is that of their dependencies.
std::string without_includes(std::string_view source) {
    std::string out;
    std::size_t at = 0;
    while (at < source.size()) {
        const std::size_t end = std::min(source.find('\n', at), source.size());
        const std::string_view line = source.substr(at, end - at);
        if (line.find("#include") == std::string_view::npos) out += std::string(line) + '\n';
        at = end + 1;
    }
    return out;
}

std::string fragment_shader() {
    return "#version 300 es\nprecision highp float;\nprecision highp int;\n" +
           without_includes(report_files::language_glsl) + without_includes(report_files::transfer_glsl) +
           without_includes(report_files::tone_curves_glsl) + std::string(report_files::view_frag_glsl);
}

std::vector<std::uint8_t> color_map() {
    std::vector<std::uint8_t> out;
    for (int i = 0; i < 255; ++i)
        for (const std::uint8_t c : magma(float(i) / 254.0f)) out.push_back(c);
    for (const std::uint8_t c : magma(std::nanf(""))) out.push_back(c);
    return out;
}

json pixels_json(const Report& report, float scale) {
    json out = json::array();
    for (std::size_t i = 0; i < report.pictures.size(); ++i) {
        const ReportPicture& p = report.pictures[i];
        json entry{{"pixels", detail::pack_halves(p.picture, scale)}};
        if (i != report.reference) {
            entry["flip"] = detail::pack_errors(p.comparison.flip);
            if (!p.comparison.hdr_flip.values.empty())
                entry["hdrFlip"] = detail::pack_errors(p.comparison.hdr_flip);
        }
        out.push_back(std::move(entry));
    }
    return out;
}

json report_json(const Report& report, float scale) {
    const Picture& reference = report.pictures[report.reference].picture;
    const bool luminance = report.options.meaning == PixelMeaning::luminance;
    json out{{"title", report.title},
             {"version", report.version},
             {"command", report.command},
             {"width", reference.width},
             {"height", reference.height},
             {"reference", report.reference},
             {"luminance", luminance},
             {"exposure", luminance ? report.options.exposure : 1.0f},
             {"ev100", report.ev100},
             {"toneCurve", report.options.tone_curve},
             {"pixelsPerDegree", report.options.pixels_per_degree},
             {"scale", scale},
             {"colorMap", detail::base64(color_map())},
             {"pictures", json::array()}};
    if (report.noise) out["noise"] = metrics_json(*report.noise);
    for (std::size_t i = 0; i < report.pictures.size(); ++i) {
        const ReportPicture& p = report.pictures[i];
        json settings = json::array();
        for (const auto& [key, value] : p.settings) settings.push_back({key, value});
        out["pictures"].push_back({{"name", p.name}, {"settings", settings}});
        if (i == report.reference) continue;
        out["pictures"].back()["metrics"] = metrics_json(p.comparison.metrics);
        out["pictures"].back()["verdict"] = p.verdict;
        out["pictures"].back()["paths"] = paths_json(p.paths);
    }
    return out;
}

}  // namespace

std::string report_html(const Report& report) {
    if (report.pictures.size() < 2 || report.reference >= report.pictures.size())
        throw std::invalid_argument("report: two pictures at least, and a reference among them");
    std::vector<const Picture*> pictures;
    for (const ReportPicture& p : report.pictures) {
        pictures.push_back(&p.picture);
        if (p.picture.width != pictures[0]->width || p.picture.height != pictures[0]->height)
            throw std::invalid_argument("report: the pictures are not of one size");
    }
    const bool luminance = report.options.meaning == PixelMeaning::luminance;
    const float scale = detail::half_scale(pictures, luminance ? report.options.exposure : 1.0f);
    std::string page(report_files::report_html);
    replace(page, "/*STYLE*/", std::string(report_files::report_css));
    replace(page, "/*SCRIPT*/",
            std::string(report_files::decode_js) + std::string(report_files::draw_gl_js) +
                std::string(report_files::draw_2d_js) + std::string(report_files::tables_js) +
                std::string(report_files::viewer_js));
    replace(page, "<!--SHADER-->", fragment_shader());
    replace(page, "<!--TITLE-->", html_text(report.title));
    // Last, and apart from what the page is searched for, because names in it are not ours.
    replace(page, "<!--PIXELS-->", script_text(pixels_json(report, scale)));
    replace(page, "<!--REPORT-->", script_text(report_json(report, scale)));
    return page;
}

}  // namespace candela::measure
