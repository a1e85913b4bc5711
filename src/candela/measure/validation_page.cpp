#include <set>

#include "candela/measure/inline_png.hpp"
#include "candela/measure/numerics.hpp"
#include "candela/measure/svg_plot.hpp"
#include "candela/measure/validation.hpp"

namespace candela::measure {
namespace {

constexpr const char* kStyle = R"(
:root{--ink:#1d2329;--soft:#5b6570;--rule:#dfe3e8;--good:#00694b;--bad:#b3261e;--link:#0b5cad}
*{box-sizing:border-box}
body{margin:0;font:16px/1.55 system-ui,-apple-system,"Segoe UI",sans-serif;color:var(--ink);background:#fff}
a{color:var(--link);text-decoration:none}a:hover{text-decoration:underline}
header,main{max-width:980px;margin:0 auto;padding:0 24px}
header{padding-top:40px}
h1{font-size:30px;line-height:1.2;margin:0 0 8px}
h2{font-size:22px;margin:56px 0 8px;padding-top:12px;border-top:2px solid var(--ink)}
h3{font-size:18px;margin:40px 0 4px}
.soft{color:var(--soft)}
.badge{display:inline-block;min-width:44px;padding:0 8px;border-radius:4px;font-size:13px;line-height:22px;
text-align:center;color:#fff;background:var(--good)}
.badge.fail{background:var(--bad)}
table{border-collapse:collapse;font-size:14px;margin:8px 0 4px;width:100%}
th,td{text-align:left;padding:5px 10px;border-bottom:1px solid var(--rule);vertical-align:top}
th{font-weight:600;color:var(--soft)}
.number{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
th.number{white-space:normal}
#techniques table{font-size:13px}#techniques td{white-space:normal;overflow-wrap:anywhere}
#techniques td:first-child{width:30%}#techniques td:nth-child(3){width:24%}
.wide{overflow-x:auto}
figure{margin:20px 0}figcaption{font-size:14px;margin-bottom:6px}
figcaption b{display:block}
figure svg{width:100%;max-width:760px;height:auto;display:block}
figure img{display:block;max-width:100%;image-rendering:pixelated}
nav ul{list-style:none;margin:4px 0 16px;padding:0}
nav li{display:flex;gap:12px;align-items:baseline;padding:3px 0}
code{font:13px/1.4 ui-monospace,Consolas,monospace}
footer{margin:64px 0 40px;font-size:14px;color:var(--soft)}
@media print{h3{break-after:avoid}figure,tr{break-inside:avoid}}
)";

std::string badge(bool pass) {
    return pass ? "<span class=\"badge\">pass</span>" : "<span class=\"badge fail\">fail</span>";
}

std::string with_unit(const std::string& value, const std::string& unit) {
    return value + (unit.empty() ? "" : " " + unit);
}

/// The papers, each once, in the order of the experiments.
std::vector<std::string> papers_of(std::span<const ExperimentResult> results) {
    std::vector<std::string> out;
    std::set<std::string> seen;
    for (const ExperimentResult& r : results) {
        if (seen.insert(r.experiment.paper).second) out.push_back(r.experiment.paper);
    }
    return out;
}

std::string contents(std::span<const ExperimentResult> results) {
    std::string out = "<nav aria-label=\"Contents\">";
    for (const std::string& paper : papers_of(results)) {
        out += "<b>" + xml_escaped(paper) + "</b><ul>";
        for (const ExperimentResult& r : results) {
            if (r.experiment.paper != paper) continue;
            out += "<li>" + badge(r.pass()) + "<span><a href=\"#" + xml_escaped(r.experiment.id) + "\">" +
                   xml_escaped(r.experiment.reproduces) + "</a> " + xml_escaped(r.experiment.title) +
                   "</span></li>";
        }
        out += "</ul>";
    }
    out += "<ul><li><a href=\"#techniques\">Techniques: measured error and cost</a></li></ul>";
    return out + "</nav>";
}

std::string measured_table(const std::vector<Measured>& measured) {
    std::string out =
        "<div class=\"wide\"><table><tr><th>measured</th><th class=\"number\">value</th>"
        "<th class=\"number\">bound</th><th></th></tr>";
    for (const Measured& m : measured) {
        out += "<tr><td>" + xml_escaped(m.name) + "</td><td class=\"number\">" +
               xml_escaped(with_unit(readable(m.value), m.unit)) + "</td><td class=\"number\">" +
               xml_escaped(bound_text(m)) + "</td><td>" + badge(m.pass()) + "</td></tr>";
    }
    return out + "</table></div>";
}

bool looks_numeric(const std::string& cell) {
    return !cell.empty() && cell.find_first_not_of("0123456789+-.,eE %") == std::string::npos;
}

std::string table_html(const Table& table) {
    std::string out = "<figure><figcaption><b>" + xml_escaped(table.title) +
                      "</b></figcaption><div class=\"wide\"><table><tr>";
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const bool right = !table.rows.empty() && i < table.rows[0].size() && looks_numeric(table.rows[0][i]);
        out += (right ? "<th class=\"number\">" : "<th>") + xml_escaped(table.columns[i]) + "</th>";
    }
    out += "</tr>";
    for (const auto& row : table.rows) {
        out += "<tr>";
        for (const std::string& cell : row)
            out += (looks_numeric(cell) ? "<td class=\"number\">" : "<td>") + xml_escaped(cell) + "</td>";
        out += "</tr>";
    }
    return out + "</table></div></figure>";
}

std::string caption(const std::string& title, const std::string& text) {
    return "<figcaption><b>" + xml_escaped(title) + "</b>" + xml_escaped(text) + "</figcaption>";
}

std::string picture_html(const Panel& picture) {
    return "<figure>" + caption(picture.title, picture.caption) + "<img alt=\"" + xml_escaped(picture.title) +
           "\" width=\"" + std::to_string(picture.width * unsigned(picture.zoom)) + "\" src=\"" +
           png_data_uri(picture) + "\"></figure>";
}

std::string section(const ExperimentResult& r) {
    const Experiment& e = r.experiment;
    std::string out = "<section id=\"" + xml_escaped(e.id) + "\"><h3>" + xml_escaped(e.reproduces) + ": " +
                      xml_escaped(e.title) + " " + badge(r.pass()) + "</h3><p class=\"soft\"><code>" +
                      xml_escaped(e.id) + "</code>, " + fixed(r.seconds, 2) + " s. " +
                      xml_escaped(e.computes) + "</p><p>" + xml_escaped(r.findings.text) + "</p>" +
                      measured_table(r.findings.measured);
    for (const Panel& p : r.findings.pictures) out += picture_html(p);
    for (const Plot& p : r.findings.plots)
        out += "<figure>" + caption(p.title, p.caption) + svg_plot(p) + "</figure>";
    for (const Table& t : r.findings.tables) out += table_html(t);
    return out + "</section>";
}

std::string techniques_html(std::span<const ExperimentResult> results) {
    std::string out =
        "<section id=\"techniques\"><h2>Techniques</h2><p>Each approximation, its error against its truth in "
        "this run, and "
        "its cost on one core of this machine (a throughput in a loop).</p><div "
        "class=\"wide\"><table><tr><th>technique</th>"
        "<th>approximates</th><th>truth</th><th class=\"number\">mean error</th><th class=\"number\">max "
        "error</th>"
        "<th class=\"number\">ns per call</th></tr>";
    for (const ExperimentResult& r : results) {
        for (const TechniqueCost& t : r.techniques) {
            out += "<tr><td><a href=\"#" + xml_escaped(r.experiment.id) + "\"><code>" +
                   xml_escaped(t.technique.name) + "</code></a><br><span class=\"soft\">" +
                   xml_escaped(t.technique.source) + "</span></td><td>" +
                   xml_escaped(t.technique.approximates) + "</td><td>" + xml_escaped(t.technique.truth) +
                   "</td><td class=\"number\">" +
                   xml_escaped(with_unit(number(t.technique.mean_error, 3), t.technique.unit)) +
                   "</td><td class=\"number\">" +
                   xml_escaped(with_unit(number(t.technique.max_error, 3), t.technique.unit)) +
                   "</td><td class=\"number\">" + cost_text(t.cost_ns) + "</td></tr>";
        }
    }
    return out + "</table></div></section>";
}

}  // namespace

std::string results_page(std::span<const ExperimentResult> results, const std::string& version) {
    std::size_t passed = 0;
    std::size_t numbers = 0;
    std::size_t missed = 0;
    for (const ExperimentResult& r : results) {
        passed += r.pass() ? 1 : 0;
        numbers += r.findings.measured.size();
        for (const Measured& m : r.findings.measured) missed += m.pass() ? 0 : 1;
    }
    std::string out =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>Candela: "
        "validation</title><style>";
    out += kStyle;
    out +=
        "</style></head><body><header><h1>Candela: validation</h1><p>The figures and tables of the papers "
        "that Candela is "
        "built on, computed from its own shading functions by <code>candela validate</code>, version " +
        xml_escaped(version) + ".</p><p>" + badge(passed == results.size()) + " <b>" +
        std::to_string(passed) + " of " + std::to_string(results.size()) +
        "</b> experiments within their bounds; " + std::to_string(numbers) + " measured numbers, " +
        std::to_string(missed) + " out of bounds.</p></header><main>" + contents(results);
    for (const std::string& paper : papers_of(results)) {
        out += "<h2>" + xml_escaped(paper) + "</h2>";
        for (const ExperimentResult& r : results) {
            if (r.experiment.paper == paper) out += section(r);
        }
    }
    out += techniques_html(results);
    return out +
           "<footer>The same numbers, and the data of every plot, are in "
           "results.json.</footer></main></body></html>\n";
}

}  // namespace candela::measure
