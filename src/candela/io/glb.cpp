#include "candela/io/glb.hpp"

#include <cstdint>
#include <cstring>

#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
constexpr std::uint32_t kBinaryChunk = 0x004e4942;
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

std::uint32_t word(std::span<const std::byte> bytes, std::size_t at) {
    std::uint32_t w = 0;
    std::memcpy(&w, bytes.data() + at, sizeof(w));
    return w;
}

bool starts_chunk(std::span<const std::byte> bytes, std::size_t at) {
    if (at + kChunkHeaderBytes > bytes.size()) return false;
    const std::uint32_t kind = word(bytes, at + 4);
    return kind == kJsonChunk || kind == kBinaryChunk;
}

/// Where the chunk behind one that ends at `end` starts: at the next multiple of 4, which the specification
/// has it padded to, unless a chunk starts right there.
std::size_t next_chunk(std::span<const std::byte> bytes, std::size_t end, const std::string& name,
                       PlacedWarnings& warnings) {
    const std::size_t padded = (end + 3) & ~std::size_t{3};
    if (padded == end) return end;
    warnings.warn_at(name, "a chunk of the .glb is not padded to 4 bytes: read as it lies");
    return starts_chunk(bytes, padded) || !starts_chunk(bytes, end) ? padded : end;
}

}  // namespace

bool is_glb(std::span<const std::byte> bytes) {
    return bytes.size() >= 4 && word(bytes, 0) == kMagic;
}

GlbChunks split_glb(std::span<const std::byte> bytes, const std::string& name, PlacedWarnings& warnings) {
    if (bytes.size() < kHeaderBytes + kChunkHeaderBytes)
        throw input_error("truncated .glb: no room for its header", name);
    if (word(bytes, 4) != 2) throw input_error("not version 2 of the .glb container", name);
    const std::uint32_t length = word(bytes, 8);
    bool length_wrong = length > bytes.size();
    GlbChunks chunks;
    std::size_t at = kHeaderBytes;
    while (at + kChunkHeaderBytes <= bytes.size()) {
        // What follows the stated length is no chunk of this file, unless chunks are still missing.
        if (at >= length) {
            if (!starts_chunk(bytes, at) || !chunks.binary.empty()) break;
            length_wrong = true;
        }
        const std::uint32_t size = word(bytes, at);
        const std::uint32_t kind = word(bytes, at + 4);
        at += kChunkHeaderBytes;
        if (size > bytes.size() - at)
            throw input_error("truncated .glb: a chunk passes the end of the file", name);
        if (kind == kJsonChunk && chunks.json.empty()) chunks.json = bytes.subspan(at, size);
        if (kind == kBinaryChunk && chunks.binary.empty()) chunks.binary = bytes.subspan(at, size);
        length_wrong = length_wrong || at + size > length;
        at = next_chunk(bytes, at + size, name, warnings);
    }
    if (chunks.json.empty()) throw input_error("a .glb without a JSON chunk", name);
    if (length_wrong) {
        warnings.warn_at(name, "the .glb's header states " + std::to_string(length) + " of " +
                                   std::to_string(bytes.size()) + " bytes: its chunks are read");
    }
    return chunks;
}

}  // namespace candela::io
