#include "candela/io/json_reader.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "candela/io/json_position.hpp"
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

/// Edits of one letter, among them two neighbours that changed places (Damerau 1964, optimal string
/// alignment).
std::size_t edit_distance(const std::string& a, const std::string& b) {
    const std::size_t columns = b.size() + 1;
    std::vector<std::size_t> d((a.size() + 1) * columns);
    const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return d[i * columns + j]; };
    for (std::size_t i = 0; i <= a.size(); ++i) at(i, 0) = i;
    for (std::size_t j = 0; j <= b.size(); ++j) at(0, j) = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
        }
    }
    return d.back();
}

std::string without_dashes(const std::string& name) {
    return name.substr(std::min(name.find_first_not_of('-'), name.size()));
}

/// The names that begin with this one and go on with another word: power_lm for power.
std::string longer_names(const std::string& name, std::span<const std::string> known) {
    constexpr int most = 3;
    std::string out;
    int count = 0;
    for (const std::string& candidate : known) {
        if (name.size() < 3 || !(candidate.starts_with(name + "_") || candidate.starts_with(name + "-")))
            continue;
        if (++count > most) break;
        out += (out.empty() ? "" : " or ") + candidate;
    }
    return out;
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
        const TextPosition at = position_of_byte(text, byte);
        throw input_error("not valid JSON",
                          where + ":" + std::to_string(at.line) + ":" + std::to_string(at.column));
    } catch (const nlohmann::json::exception&) {
        throw input_error("not valid JSON", where);
    }
}

std::string nearest_name(const std::string& name, std::span<const std::string> known) {
    if (std::string longer = longer_names(name, known); !longer.empty()) return longer;
    std::string best;
    // A third of the letters wrong is another word.
    const std::string word = without_dashes(name);
    std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const std::string& candidate : known) {
        const std::size_t distance = edit_distance(word, without_dashes(candidate));
        if (distance < least) {
            least = distance;
            best = candidate;
        }
    }
    return best;
}

}  // namespace candela::io
