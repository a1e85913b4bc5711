#pragma once

#include <regex>
#include <set>
#include <string>
#include <vector>

namespace candela::test {

/// What is wrong with the nesting of tags, attributes' quotes or bare ampersands; empty when nothing is.
/// Knows HTML's void elements and leaves the content of <style> alone.
inline std::string markup_fault(const std::string& text) {
    static const std::set<std::string> voids{"meta", "img", "br", "!DOCTYPE"};
    static const std::regex tag(
        R"(<(/?)([A-Za-z!][A-Za-z0-9]*)((?:\s+[A-Za-z_:][-A-Za-z0-9_:.]*(?:="[^"<]*")?)*)\s*(/?)>)");
    std::vector<std::string> open;
    std::size_t at = 0;
    while (at < text.size()) {
        const char c = text[at];
        if (c == '&') {
            static const std::regex entity("&(amp|lt|gt|quot|#39);");
            if (!std::regex_search(text.substr(at, 8), entity, std::regex_constants::match_continuous))
                return "bare ampersand: " + text.substr(at, 30);
        }
        if (c == '>') return "bare '>': " + text.substr(at, 30);
        if (c != '<') {
            ++at;
            continue;
        }
        const std::size_t end = text.find('>', at);
        if (end == std::string::npos) return "a tag is not closed";
        const std::string one = text.substr(at, end - at + 1);
        std::smatch match;
        if (one.size() < 5000 && !std::regex_match(one, match, tag)) return "no tag: " + one.substr(0, 60);
        if (one.size() >= 5000) {  // a picture or a long path: too long for std::regex
            const bool closed = one[one.size() - 2] == '/';
            const std::string name = one.substr(1, one.find_first_of(" >") - 1);
            if (!closed && !voids.contains(name)) open.push_back(name);
            at = end + 1;
            continue;
        }
        const std::string name = match[2];
        at = end + 1;
        if (match[1] == "/") {
            if (open.empty() || open.back() != name)
                return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
            open.pop_back();
        } else if (match[4] != "/" && !voids.contains(name)) {
            open.push_back(name);
            if (name == "style") at = text.find("</style>", at);
        }
    }
    return open.empty() ? "" : "<" + open.back() + "> is never closed";
}

/// The first coordinate that is no number.
inline std::string not_finite(const std::string& svg) {
    for (std::size_t at = svg.find("=\""); at != std::string::npos; at = svg.find("=\"", at + 1)) {
        const std::string value = svg.substr(at + 2, svg.find('"', at + 2) - at - 2);
        for (const char* bad : {"nan", "inf", "e+"}) {
            if (value.find(bad) != std::string::npos && value.find("sans") == std::string::npos)
                return value.substr(0, 60);
        }
    }
    return "";
}

}  // namespace candela::test
