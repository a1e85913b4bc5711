#include <zlib.h>
#include <zstd.h>

#include <filesystem>
#include <fstream>

#include "environment_files/texture_files.hpp"

using namespace candela::test;

namespace {

void write(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

Text deflated(const Text& data) {
    uLongf size = compressBound(data.size());
    Text out(size, '\0');
    compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
             data.size());
    out.resize(size);
    return out;
}

Text zstandard(const Text& data) {
    Text out(ZSTD_compressBound(data.size()), '\0');
    out.resize(ZSTD_compress(out.data(), out.size(), data.data(), data.size(), 3));
    return out;
}

}  // namespace

/// Writes one small file a feature into the folder: where the fuzzer starts.
int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    const std::vector<glm::vec3> cube(6 * 4, glm::vec3(1.0f, 2.0f, 3.0f));
    for (const std::uint32_t format : {97u, 106u, 109u, 122u, 123u}) {
        Ktx2 file;
        file.format = format;
        file.width = file.height = 2;
        file.keys = ktx_key("candela.cubeSpace", "direct") + ktx_key("candela.nitPerUnit", "2");
        file.data = format < 122 ? pixels(cube, format) : Text(cube.size() * 4, '\x42');
        write(folder / ("plain" + std::to_string(format) + ".ktx2"), file.bytes());
        file.unpacked = file.data.size();
        const Text plain = file.data;
        file.packing = 3;
        file.data = deflated(plain);
        write(folder / ("zlib" + std::to_string(format) + ".ktx2"), file.bytes());
        file.packing = 2;
        file.data = zstandard(plain);
        write(folder / ("zstd" + std::to_string(format) + ".ktx2"), file.bytes());
    }
    for (const auto& [code, dxgi] : {std::pair{113u, 0u}, std::pair{116u, 0u}, std::pair{0x30315844u, 10u},
                                     std::pair{0x30315844u, 2u}, std::pair{0x30315844u, 67u}}) {
        Dds file;
        file.width = file.height = 2;
        file.four_cc = code;
        file.dxgi = dxgi;
        file.data = pixels(cube, code == 116 || dxgi == 2 ? 109 : 97);
        write(folder / ("dds" + std::to_string(code) + "_" + std::to_string(dxgi) + ".dds"), file.bytes());
    }
    return 0;
}
