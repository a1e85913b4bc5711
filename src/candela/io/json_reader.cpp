#include "candela/io/json_reader.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

/// Depth is counted on the text, before anything is built: a parser that recurses must not meet a megabyte of
/// '['.
void check_depth(std::string_view text, const std::string& where, int max_depth) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '[' || c == '{') {
            if (++depth > max_depth) throw input_error("JSON nested too deeply", where);
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
}

std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

}  // namespace

bool is_binary(std::span<const std::byte> bytes) {
    // Zeros at the end are padding, which some writers of .glb put there.
    const auto last =
        std::find_if(bytes.rbegin(), bytes.rend(), [](std::byte b) { return b != std::byte{0}; });
    return std::any_of(last, bytes.rend(), [](std::byte b) { return b < std::byte{9}; });
}

nlohmann::json parse_json(std::span<const std::byte> bytes, const std::string& where, bool comments,
                          int max_depth, PlacedWarnings* duplicate_keys) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.empty()) throw input_error("the file is empty", where, "JSON is expected");
    if (is_binary(bytes)) throw input_error("is not text, but JSON is expected", where);
    check_depth(text, where, max_depth);
    // A later key would silently win over an earlier one (glTF forbids them).
    std::vector<std::set<std::string>> keys;
    const auto unique_keys = [&](int, nlohmann::json::parse_event_t event, nlohmann::json& value) {
        using Event = nlohmann::json::parse_event_t;
        if (event == Event::object_start) keys.emplace_back();
        if (event == Event::object_end) keys.pop_back();
        if (event == Event::key && !keys.back().insert(value.get<std::string>()).second) {
            const std::string what =
                "the key \"" + value.get<std::string>() + "\" appears twice in one object";
            if (!duplicate_keys) throw input_error(what, where);
            duplicate_keys->warn_at(where, what + ": the later one counts");
        }
        return true;
    };
    try {
        return nlohmann::json::parse(text.begin(), text.end(), unique_keys, true, comments);
    } catch (const nlohmann::json::parse_error& error) {
        const std::size_t byte = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
        const auto line =
            std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(byte), '\n') + 1;
        throw input_error("not valid JSON", where + ":" + std::to_string(line));
    } catch (const nlohmann::json::exception&) {
        throw input_error("not valid JSON", where);
    }
}

std::string nearest_name(const std::string& name, std::span<const std::string> known) {
    std::string best;
    std::size_t least = std::max<std::size_t>(3, name.size() / 2);
    for (const std::string& candidate : known) {
        const std::size_t distance = edit_distance(name, candidate);
        if (distance < least) {
            least = distance;
            best = candidate;
        }
    }
    return best;
}

}  // namespace candela::io
