#include "candela/truth/checkpoint.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <vector>

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
    for (std::size_t i = 0; i < count; i += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes + i, std::min<std::size_t>(8, count - i));
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

CheckpointState load_checkpoint(const std::filesystem::path& file, std::uint64_t fingerprint, Film& film) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return CheckpointState::absent;
    const Header wanted;
    Header header{};
    std::ifstream in(file, std::ios::binary);
    in.read(reinterpret_cast<char*>(&header), sizeof(header));
    if (!in || std::memcmp(header.magic, wanted.magic, sizeof(header.magic)) != 0) {
        throw input_error("is there already and is no checkpoint", file.string(),
                          "--checkpoint FILE for another name, or remove it");
    }
    const bool same = header.fingerprint == fingerprint && header.width == film.width() &&
                      header.height == film.height() && header.channels == film.layout().channels() &&
                      header.tiles == film.tile_count();
    std::vector<std::byte> body(body_bytes(film));
    if (!same || !in.read(reinterpret_cast<char*>(body.data()), static_cast<std::streamsize>(body.size())) ||
        header.digest != digest_of(body.data(), body.size())) {
        return CheckpointState::other;
    }
    const std::byte* at = body.data();
    at = get(at, film.sums);
    at = get(at, film.ids);
    get(at, film.tiles);
    return CheckpointState::loaded;
}

}  // namespace candela::truth
