#include "candela/truth/checkpoint.hpp"

#include <cstring>
#include <vector>

#include "candela/io/image_read.hpp"
#include "candela/io/image_write.hpp"
#include "candela/scene/error.hpp"

namespace candela::truth {
namespace {

struct Header {
    char magic[8] = {'C', 'A', 'N', 'D', 'E', 'L', 'A', '1'};
    std::uint64_t fingerprint = 0;
    std::uint64_t digest = 0;  ///< of everything that follows
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t channels = 0;
    std::uint32_t tiles = 0;
};

std::uint64_t digest_of(const std::byte* bytes, std::size_t count) {
    // FNV-1a over 8-byte words: a damaged file is noticed, a malicious one is not the point.
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (std::size_t i = 0; i + 8 <= count; i += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes + i, 8);
        hash = (hash ^ word) * 0x100000001b3u;
    }
    return hash ^ count;
}

template <class T>
std::byte* put(std::byte* at, const std::vector<T>& values) {
    std::memcpy(at, values.data(), values.size() * sizeof(T));
    return at + values.size() * sizeof(T);
}
template <class T>
const std::byte* get(const std::byte* at, std::vector<T>& values) {
    std::memcpy(values.data(), at, values.size() * sizeof(T));
    return at + values.size() * sizeof(T);
}

std::size_t body_bytes(const Film& film) {
    return film.tiles.size() * sizeof(Film::Tile) + film.sums.size() * sizeof(double) +
           film.ids.size() * sizeof(glm::uvec2);
}

}  // namespace

void save_checkpoint(const std::filesystem::path& file, const Film& film, std::uint64_t fingerprint) {
    std::vector<std::byte> bytes(sizeof(Header) + body_bytes(film));
    std::byte* at = bytes.data() + sizeof(Header);
    at = put(at, film.sums);
    at = put(at, film.ids);
    put(at, film.tiles);
    Header header;
    header.fingerprint = fingerprint;
    header.width = film.width();
    header.height = film.height();
    header.channels = static_cast<std::uint32_t>(film.layout().channels());
    header.tiles = film.tile_count();
    header.digest = digest_of(bytes.data() + sizeof(Header), body_bytes(film));
    std::memcpy(bytes.data(), &header, sizeof(header));
    io::write_file(file, bytes);
}

bool load_checkpoint(const std::filesystem::path& file, std::uint64_t fingerprint, Film& film) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return false;
    std::vector<std::byte> bytes;
    try {
        bytes = io::read_file(file, sizeof(Header) + body_bytes(film));
    } catch (const Error&) {
        return false;
    }
    if (bytes.size() != sizeof(Header) + body_bytes(film)) return false;
    Header header;
    const Header wanted;
    std::memcpy(&header, bytes.data(), sizeof(header));
    const bool same = std::memcmp(header.magic, wanted.magic, sizeof(header.magic)) == 0 &&
                      header.fingerprint == fingerprint && header.width == film.width() &&
                      header.height == film.height() && header.channels == film.layout().channels() &&
                      header.tiles == film.tile_count() &&
                      header.digest == digest_of(bytes.data() + sizeof(Header), body_bytes(film));
    if (!same) return false;
    const std::byte* at = bytes.data() + sizeof(Header);
    at = get(at, film.sums);
    at = get(at, film.ids);
    get(at, film.tiles);
    return true;
}

}  // namespace candela::truth
