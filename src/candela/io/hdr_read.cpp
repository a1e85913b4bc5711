#include "candela/io/hdr_read.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>

#include "candela/io/image_read_limits.hpp"
#include "candela/scene/error.hpp"

namespace candela::io::detail {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

/// The bytes of a picture, never read past their end.
class Bytes {
  public:
    Bytes(std::span<const std::byte> bytes, const std::string& where) : left_(bytes), where_(where) {}

    [[nodiscard]] std::uint8_t next() {
        if (left_.empty()) throw broken("the data ends too early");
        const auto value = std::to_integer<std::uint8_t>(left_.front());
        left_ = left_.subspan(1);
        return value;
    }
    [[nodiscard]] Rgbe next_texel() {
        Rgbe texel;
        for (std::uint8_t& c : texel) c = next();
        return texel;
    }
    [[nodiscard]] std::optional<Rgbe> peek_texel() const {
        if (left_.size() < 4) return std::nullopt;
        Rgbe texel;
        for (std::size_t c = 0; c < 4; ++c) texel[c] = std::to_integer<std::uint8_t>(left_[c]);
        return texel;
    }
    [[nodiscard]] std::string next_line() {
        constexpr std::size_t longest = 4096;
        std::string line;
        for (char c = 0; (c = static_cast<char>(next())) != '\n';) {
            line += c;
            if (line.size() > longest) throw broken("a header line without end");
        }
        if (line.ends_with('\r')) line.pop_back();
        return line;
    }
    [[nodiscard]] std::size_t left() const noexcept { return left_.size(); }
    [[nodiscard]] Error broken(const std::string& why) const {
        return input_error("broken Radiance picture: " + why, where_);
    }

  private:
    std::span<const std::byte> left_;
    const std::string& where_;
};

struct Header {
    glm::vec3 multiplier{1.0f};  ///< that the writer applied
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    bool columns_first = false;  ///< scan lines are columns
    bool right_to_left = false;
    bool bottom_to_top = false;
};

std::vector<float> numbers(const std::string& text) {
    std::istringstream stream(text);
    std::vector<float> out;
    for (float value = 0.0f; stream >> value;) out.push_back(value);
    return out;
}

void check_primaries(const std::vector<float>& values, const std::string& where, Diagnostics& diagnostics) {
    constexpr std::array<float, 8> rec709{0.640f, 0.330f, 0.300f, 0.600f, 0.150f, 0.060f, 0.3127f, 0.3290f};
    // Some writers leave the field there and empty.
    if (std::all_of(values.begin(), values.end(), [](float v) { return v == 0.0f; })) return;
    bool same = values.size() == rec709.size();
    for (std::size_t i = 0; same && i < rec709.size(); ++i) same = std::abs(values[i] - rec709[i]) < 0.002f;
    if (!same) diagnostics.warn(where + ": its primaries are not Rec.709's; they are read as if they were");
}

void read_variable(const std::string& line, Header& header, const Bytes& bytes, const std::string& where,
                   Diagnostics& diagnostics) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos || line.starts_with('#')) return;
    const std::string key = line.substr(0, equals), text = line.substr(equals + 1);
    if (key == "FORMAT" && text.find("32-bit_rle_rgbe") == std::string::npos)
        throw input_error("Radiance picture in an unsupported format: " + text, where,
                          "32-bit_rle_rgbe is read");
    const std::vector<float> values = numbers(text);
    if (key == "PRIMARIES") check_primaries(values, where, diagnostics);
    const std::size_t expected = key == "EXPOSURE" ? 1 : key == "COLORCORR" ? 3 : 0;
    if (expected == 0) return;
    if (values.size() < expected) throw bytes.broken("no number after " + key);
    for (int c = 0; c < 3; ++c) header.multiplier[c] *= values[expected == 3 ? std::size_t(c) : 0];
    for (int c = 0; c < 3; ++c) {
        if (!(header.multiplier[c] > 0.0f) || !std::isfinite(header.multiplier[c]))
            throw bytes.broken(key + " is not positive");
    }
}

/// "-Y 512 +X 1024": the first axis is that of the scan lines, a minus on Y and a plus on X is the usual way.
void read_resolution(const std::string& line, Header& header, const Bytes& bytes, const std::string& where) {
    std::istringstream stream(line);
    std::array<std::string, 2> axes;
    std::array<std::uint64_t, 2> sizes{};
    stream >> axes[0] >> sizes[0] >> axes[1] >> sizes[1];
    bool good = static_cast<bool>(stream);
    for (const std::string& axis : axes)
        good = good && axis.size() == 2 && (axis[0] == '+' || axis[0] == '-') &&
               (axis[1] == 'X' || axis[1] == 'Y');
    if (!good || axes[0][1] == axes[1][1]) throw bytes.broken("not a resolution: " + line);
    header.columns_first = axes[0][1] == 'X';
    const std::string& x = axes[header.columns_first ? 0 : 1];
    const std::string& y = axes[header.columns_first ? 1 : 0];
    header.right_to_left = x[0] == '-';
    header.bottom_to_top = y[0] == '+';
    const std::uint64_t width = sizes[header.columns_first ? 0 : 1];
    const std::uint64_t height = sizes[header.columns_first ? 1 : 0];
    check_size(width, height, where);
    header.width = static_cast<std::uint32_t>(width);
    header.height = static_cast<std::uint32_t>(height);
}

Header read_header(Bytes& bytes, const std::string& where, Diagnostics& diagnostics) {
    Header header;
    for (std::string line; !(line = bytes.next_line()).empty();)
        read_variable(line, header, bytes, where, diagnostics);
    read_resolution(bytes.next_line(), header, bytes, where);
    return header;
}

/// The four components one after the other, each in runs (count above 128: one byte repeated).
void read_new_runs(Bytes& bytes, std::vector<Rgbe>& line) {
    for (std::size_t component = 0; component < 4; ++component) {
        for (std::size_t i = 0; i < line.size();) {
            std::size_t count = bytes.next();
            const bool repeated = count > 128;
            if (repeated) count -= 128;
            if (count == 0 || count > line.size() - i) throw bytes.broken("a run leaves its scan line");
            std::uint8_t value = repeated ? bytes.next() : std::uint8_t{0};
            for (const std::size_t end = i + count; i < end; ++i)
                line[i][component] = repeated ? value : bytes.next();
        }
    }
}

/// Texels; 1,1,1,n repeats the one before n times, and a chain of such counts is a number of base 256.
void read_old_runs(Bytes& bytes, std::vector<Rgbe>& line) {
    unsigned shift = 0;
    for (std::size_t i = 0; i < line.size();) {
        const Rgbe texel = bytes.next_texel();
        if (texel[0] != 1 || texel[1] != 1 || texel[2] != 1) {
            line[i++] = texel;
            shift = 0;
            continue;
        }
        const std::size_t count = shift <= 16 ? std::size_t{texel[3]} << shift : line.size();
        if (i == 0 || count > line.size() - i) throw bytes.broken("a run leaves its scan line");
        std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(i), count, line[i - 1]);
        i += count;
        shift += 8;
    }
}

void read_line(Bytes& bytes, std::vector<Rgbe>& line) {
    constexpr std::size_t shortest_new = 8, longest_new = 0x7fff;
    const std::optional<Rgbe> head = bytes.peek_texel();
    const bool new_coding = head && (*head)[0] == 2 && (*head)[1] == 2 && (*head)[2] < 128 &&
                            line.size() >= shortest_new && line.size() <= longest_new;
    if (!new_coding) return read_old_runs(bytes, line);
    if ((std::size_t{(*head)[2]} << 8 | (*head)[3]) != line.size())
        throw bytes.broken("a scan line of another length than the header says");
    (void)bytes.next_texel();
    read_new_runs(bytes, line);
}

glm::vec3 value_of(const Rgbe& texel) {
    if (texel[3] == 0) return glm::vec3(0.0f);
    const float step = std::ldexp(1.0f, int{texel[3]} - 136);
    return glm::vec3(texel[0], texel[1], texel[2]) * step;
}

}  // namespace

scene::Environment decode_hdr(std::span<const std::byte> data, const std::string& where,
                              Diagnostics& diagnostics, const std::optional<scene::MemoryBudget>& memory,
                              const ProgressFunction& progress) {
    Bytes bytes(data, where);
    const Header header = read_header(bytes, where, diagnostics);
    const std::uint32_t lines = header.columns_first ? header.width : header.height;
    const std::uint32_t length = header.columns_first ? header.height : header.width;
    // A scan line takes four bytes at least in either coding.
    check_claim(std::uint64_t{lines} * 4, bytes.left(), 1, where);
    check_memory(header.width, header.height, memory, where);
    scene::Environment out;
    out.width = header.width;
    out.height = header.height;
    out.luminance_nit.resize(std::size_t{out.width} * out.height);
    std::vector<Rgbe> line(length);
    for (std::uint32_t i = 0; i < lines; ++i) {
        read_line(bytes, line);
        if (progress && i % 64 == 0) progress(double(i) / lines);
        for (std::uint32_t j = 0; j < length; ++j) {
            std::uint32_t x = header.columns_first ? i : j, y = header.columns_first ? j : i;
            if (header.right_to_left) x = out.width - 1 - x;
            if (header.bottom_to_top) y = out.height - 1 - y;
            out.luminance_nit[std::size_t{y} * out.width + x] = value_of(line[j]) / header.multiplier;
        }
    }
    return out;
}

}  // namespace candela::io::detail
