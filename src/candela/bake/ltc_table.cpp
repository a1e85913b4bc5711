#include "candela/bake/ltc_table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "candela/scene/error.hpp"
#include "candela_tables/files.hpp"
#include "shading/lights/ltc.glsl"

namespace candela::bake {
namespace {

static_assert(std::endian::native == std::endian::little, "the table's file is little-endian");

constexpr std::size_t kTexels = std::size_t{shading::kLtcSize} * std::size_t{shading::kLtcSize};

struct Header {
    std::array<char, 4> name{'C', 'L', 'T', 'C'};
    std::uint32_t version = kLtcVersion;
    std::uint32_t size = shading::kLtcSize;

    bool operator==(const Header&) const = default;
};

constexpr std::size_t kTexelBytes = kTexels * sizeof(glm::vec4);
constexpr std::size_t kBytes = sizeof(Header) + kTexelBytes + kTexels * sizeof(float);

}  // namespace

glm::vec4 LtcTable::read(float NoV, float perceptual_roughness) const {
    constexpr int size = shading::kLtcSize;
    const glm::vec2 at = shading::ltc_uv(NoV, perceptual_roughness) * static_cast<float>(size) - 0.5f;
    const int x = std::clamp(static_cast<int>(at.x), 0, size - 2);
    const int y = std::clamp(static_cast<int>(at.y), 0, size - 2);
    const float fx = std::clamp(at.x - static_cast<float>(x), 0.0f, 1.0f);
    const float fy = std::clamp(at.y - static_cast<float>(y), 0.0f, 1.0f);
    const glm::vec4* row = texels.data() + static_cast<std::ptrdiff_t>(y) * size + x;
    return (row[0] * (1.0f - fx) + row[1] * fx) * (1.0f - fy) +
           (row[size] * (1.0f - fx) + row[size + 1] * fx) * fy;
}

std::string encode_ltc_table(const LtcTable& table) {
    const Header header;
    std::string bytes(kBytes, '\0');
    std::memcpy(bytes.data(), &header, sizeof(Header));
    std::memcpy(bytes.data() + sizeof(Header), table.texels.data(), kTexelBytes);
    std::memcpy(bytes.data() + sizeof(Header) + kTexelBytes, table.errors.data(), kTexels * sizeof(float));
    return bytes;
}

LtcTable decode_ltc_table(std::string_view bytes, const std::string& where) {
    Header header;
    if (bytes.size() < sizeof(Header))
        throw input_error("this is not a table of linearly transformed cosines", where,
                          "candela bake ltc writes one");
    std::memcpy(&header, bytes.data(), sizeof(Header));
    if (header != Header{} || bytes.size() != kBytes)
        throw input_error("this is not a table of linearly transformed cosines of this version", where,
                          "candela bake ltc writes one");
    LtcTable table;
    table.texels.resize(kTexels);
    table.errors.resize(kTexels);
    std::memcpy(table.texels.data(), bytes.data() + sizeof(Header), kTexelBytes);
    std::memcpy(table.errors.data(), bytes.data() + sizeof(Header) + kTexelBytes, kTexels * sizeof(float));
    return table;
}

const LtcTable& ltc_table() {
    static const LtcTable table = decode_ltc_table(tables::ltc_table_bin, "ltc_table.bin");
    return table;
}

gpu::Image create_ltc_table(const gpu::Device& device, gpu::Commands& commands) {
    const std::vector<glm::vec4>& texels = ltc_table().texels;
    const std::size_t bytes = texels.size() * sizeof(glm::vec4);
    gpu::Buffer staging(device, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::MemoryKind::upload);
    std::memcpy(staging.mapped(), texels.data(), bytes);
    constexpr auto size = static_cast<std::uint32_t>(shading::kLtcSize);
    gpu::Image table(device, {size, size, VK_FORMAT_R32G32B32A32_SFLOAT, VK_IMAGE_USAGE_SAMPLED_BIT});
    commands.begin();
    commands.copy(staging, table);
    commands.use(table, gpu::Use::sampled);
    commands.submit_and_wait();
    return table;
}

}  // namespace candela::bake
