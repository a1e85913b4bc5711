#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "candela/io/texture_read.hpp"
#include "candela/scene/error.hpp"

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

/// A header may claim what compressed data could hold and a fuzzer's memory cannot.
bool is_small(std::span<const std::byte> bytes, std::size_t width_at, std::size_t height_at) {
    constexpr std::uint32_t largest = 512;
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i)
            value |= std::to_integer<std::uint32_t>(bytes[at + i]) << 8 * i;
        return value;
    };
    return number(width_at) <= largest && number(height_at) <= largest;
}

}  // namespace

// Any bytes are either a picture of the size that they say or an Error; everything else (a signal, a leak,
// another exception) is a finding.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace candela::io::detail;
    const std::span bytes = std::as_bytes(std::span(data, size));
    try {
        TextureFile file;
        if (is_ktx2(bytes) && is_small(bytes, 20, 24))
            file = decode_ktx2(bytes, "fuzz");
        else if (is_dds(bytes) && is_small(bytes, 16, 12))
            file = decode_dds(bytes, "fuzz");
        else
            return 0;
        require(file.faces == 1 || (file.faces == 6 && file.width == file.height));
        require(file.texels.size() == std::size_t{file.width} * file.height * file.faces);
    } catch (const candela::Error&) {
    }
    return 0;
}
