#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "candela/gpu/frame_graph/frame_graph.hpp"

namespace candela::gpu {
namespace {

std::string bytes_text(std::uint64_t bytes) {
    char text[32];
    if (bytes >= (1u << 20u)) {
        std::snprintf(text, sizeof(text), "%.1f MiB", static_cast<double>(bytes) / (1 << 20));
    } else {
        std::snprintf(text, sizeof(text), "%.1f KiB", static_cast<double>(bytes) / (1 << 10));
    }
    return text;
}

std::string ms_text(double ms) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.2f ms", ms);
    return text;
}

std::optional<double> time_of(const std::string& pass, std::span<const PassTime> times) {
    const auto at =
        std::find_if(times.begin(), times.end(), [&](const PassTime& t) { return t.name == pass; });
    if (at == times.end()) return std::nullopt;
    return at->milliseconds;
}

/// For XML and for quoted strings of Graphviz.
std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '<') {
            out += "&lt;";
        } else if (c == '&') {
            out += "&amp;";
        } else if (c == '"') {
            out += "&quot;";
        } else {
            out += c;
        }
    }
    return out;
}

/// A resource's row: what each pass does with it, by the pass's place.
struct Row {
    std::uint32_t resource = 0;
    std::map<std::size_t, std::pair<bool, bool>> touches;  ///< reads, writes
};

std::vector<Row> rows_of(const std::vector<PassNode>& passes, std::size_t resources) {
    std::vector<Row> rows(resources);
    for (std::size_t place = 0; place < passes.size(); ++place) {
        for (const Access& a : passes[place].accesses) {
            auto& touch = rows[a.contents.resource].touches[place];
            touch.first = touch.first || a.reads;
            touch.second = touch.second || a.writes;
        }
    }
    for (std::uint32_t i = 0; i < rows.size(); ++i) rows[i].resource = i;
    std::erase_if(rows, [](const Row& r) { return r.touches.empty(); });
    std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
        return a.touches.begin()->first < b.touches.begin()->first;
    });
    return rows;
}

}  // namespace

std::string graph_svg(const FrameGraph& graph, std::span<const PassTime> times) {
    const std::vector<PassNode> passes = graph.passes();
    const std::vector<ResourceNode> resources = graph.resources();
    const std::vector<Row> rows = rows_of(passes, resources.size());
    constexpr int column = 34;
    constexpr int row_height = 20;
    constexpr int left = 260;
    constexpr int top = 190;
    constexpr int legend_width = 860;
    const int width = std::max(left + column * static_cast<int>(passes.size()) + 130, legend_width);
    const int height = top + row_height * static_cast<int>(rows.size()) + 60;
    std::ostringstream svg;
    svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\"" << height
        << "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
           "fill=\"white\"/>\n";
    for (std::size_t i = 0; i < passes.size(); ++i) {
        const int x = left + column * static_cast<int>(i) + column / 2;
        const auto ms = time_of(passes[i].name, times);
        svg << "<text transform=\"translate(" << x + 4 << ' ' << top - 10 << ") rotate(-60)\">"
            << escaped(passes[i].name) << (ms ? "  " + ms_text(*ms) : "") << "</text>\n"
            << "<line x1=\"" << x << "\" x2=\"" << x << "\" y1=\"" << top << "\" y2=\"" << height - 50
            << "\" stroke=\"#ddd\"/>\n";
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row& row = rows[i];
        const ResourceNode& r = resources[row.resource];
        const int y = top + row_height * static_cast<int>(i) + row_height / 2;
        const auto x_of = [&](std::size_t place) {
            return left + column * static_cast<int>(place) + column / 2;
        };
        svg << "<text x=\"" << left - 8 << "\" y=\"" << y + 4 << "\" text-anchor=\"end\""
            << (r.imported ? " fill=\"#777\"" : "") << '>' << escaped(r.name)
            << (r.bytes > 0 ? "  " + bytes_text(r.bytes) : "") << "</text>\n";
        svg << "<line x1=\"" << x_of(row.touches.begin()->first) << "\" x2=\""
            << x_of(row.touches.rbegin()->first) << "\" y1=\"" << y << "\" y2=\"" << y << "\" stroke=\""
            << (r.imported ? "#bbb" : "#48a") << "\" stroke-width=\"4\"/>\n";
        for (const auto& [place, touch] : row.touches) {
            svg << "<circle cx=\"" << x_of(place) << "\" cy=\"" << y << "\" r=\"6\" stroke=\"#333\" fill=\""
                << (touch.second ? touch.first ? "#e90" : "#d33" : "#fff") << "\"/>\n";
        }
    }
    svg << "<text x=\"12\" y=\"" << height - 18
        << "\">written: red; read and written: orange; read: white. Grey lines: made "
        << "outside of the frame. " << bytes_text(graph.memory_bytes()) << " of memory, "
        << bytes_text(graph.unshared_bytes()) << " without sharing.</text>\n</svg>\n";
    return svg.str();
}

std::string graph_dot(const FrameGraph& graph, std::span<const PassTime> times) {
    const std::vector<PassNode> passes = graph.passes();
    const std::vector<ResourceNode> resources = graph.resources();
    std::ostringstream dot;
    dot << "digraph frame {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n";
    std::set<std::pair<std::uint32_t, std::uint32_t>> contents;
    const auto node = [](std::uint32_t resource, std::uint32_t version) {
        return "r" + std::to_string(resource) + "_" + std::to_string(version);
    };
    for (std::size_t i = 0; i < passes.size(); ++i) {
        const auto ms = time_of(passes[i].name, times);
        dot << "  p" << i << " [shape=box, style=filled, fillcolor=\"#fd9\", label=\""
            << escaped(passes[i].name) << (ms ? "\\n" + ms_text(*ms) : "") << "\"];\n";
        for (const Access& a : passes[i].accesses) {
            if (a.reads) {
                contents.emplace(a.contents.resource, a.contents.version);
                dot << "  " << node(a.contents.resource, a.contents.version) << " -> p" << i << ";\n";
            }
            if (a.writes) {
                contents.emplace(a.contents.resource, a.contents.version + 1);
                dot << "  p" << i << " -> " << node(a.contents.resource, a.contents.version + 1) << ";\n";
            }
        }
    }
    for (const auto& [resource, version] : contents) {
        const ResourceNode& r = resources[resource];
        dot << "  " << node(resource, version) << " [label=\"" << escaped(r.name)
            << (r.bytes > 0 ? "\\n" + bytes_text(r.bytes) : "") << '"' << (r.imported ? ", style=dashed" : "")
            << "];\n";
    }
    dot << "}\n";
    return dot.str();
}

}  // namespace candela::gpu
