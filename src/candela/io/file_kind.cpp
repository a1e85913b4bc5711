#include "candela/io/file_kind.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <optional>
#include <string_view>

namespace candela::io {
namespace {

constexpr const char* kExport = "export it as .glb, from Blender or another modelling program";
constexpr const char* kPhotometric = "candela light FILE, or the profile of a light in a stage";
constexpr const char* kEnvironment = "light from a picture: --env FILE";

struct Magic {
    std::string_view bytes;
    const char* name;
    const char* hint = "";
    std::size_t offset = 0;
};

using namespace std::string_view_literals;

constexpr std::array kMagics{
    Magic{"glTF"sv, "a binary glTF scene"},
    Magic{"\x89PNG\r\n\x1a\n"sv, "a PNG picture"},
    Magic{"\xff\xd8\xff"sv, "a JPEG picture"},
    Magic{"WEBP"sv, "a WebP picture", "", 8},
    Magic{"\x76\x2f\x31\x01"sv, "an OpenEXR picture", kEnvironment},
    Magic{"#?"sv, "a Radiance HDR picture", kEnvironment},
    Magic{"\xabKTX 20\xbb"sv, "a KTX 2 texture", kEnvironment},
    Magic{"DDS "sv, "a DDS texture", kEnvironment},
    Magic{"II*\0"sv, "a TIFF picture"},
    Magic{"MM\0*"sv, "a TIFF picture"},
    Magic{"GIF8"sv, "a GIF picture"},
    Magic{"BM"sv, "a BMP picture"},
    Magic{"8BPS"sv, "a Photoshop picture"},
    Magic{"ftypavif"sv, "an AVIF picture", "", 4},
    Magic{"ftyphei"sv, "a HEIF picture", "", 4},
    Magic{"IESNA"sv, "an IES photometric file", kPhotometric},
    Magic{"Kaydara FBX"sv, "an FBX scene", kExport},
    Magic{"; FBX"sv, "an FBX scene", kExport},
    Magic{"BLENDER"sv, "a Blender file", "export it from Blender as .glb"},
    Magic{"#usda"sv, "a USD scene", kExport},
    Magic{"PXR-USDC"sv, "a USD scene", kExport},
    Magic{"ply\n"sv, "a PLY mesh", kExport},
    Magic{"ply\r"sv, "a PLY mesh", kExport},
    Magic{"solid "sv, "an STL mesh", kExport},
    Magic{"version https://git-lfs"sv, "a Git LFS pointer, not the file itself", "git lfs pull"},
    Magic{"PK\x03\x04"sv, "a ZIP archive", "unpack it first"},
    Magic{"\x1f\x8b"sv, "a gzip archive", "unpack it first"},
    Magic{"%PDF"sv, "a PDF document"},
    Magic{"\x7f"
          "ELF"sv,
          "a program"},
    Magic{"MZ"sv, "a program"},
};

struct Ending {
    std::string_view ending;
    const char* name;
    const char* hint = "";
};

constexpr std::array kEndings{
    Ending{".obj", "an OBJ mesh", kExport},
    Ending{".mtl", "a material library of an OBJ mesh", kExport},
    Ending{".stl", "an STL mesh", kExport},
    Ending{".dae", "a COLLADA scene", kExport},
    Ending{".3ds", "a 3DS scene", kExport},
    Ending{".abc", "an Alembic scene", kExport},
    Ending{".vrm", "a VRM avatar", kExport},
    Ending{".pbrt", "a pbrt scene", kExport},
    Ending{".ldt", "a EULUMDAT photometric file", kPhotometric},
    Ending{".ies", "an IES photometric file", kPhotometric},
    Ending{".bin", "a buffer of a glTF scene", "name the .gltf file that belongs to it"},
    Ending{".tga", "a TGA picture"},
    Ending{".txt", "plain text"},
    Ending{".md", "plain text"},
    Ending{".csv", "a table"},
    Ending{".svg", "an SVG drawing"},
};

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string_view trimmed_front(std::string_view text) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0)
        text.remove_prefix(1);
    return text;
}

/// Of text that starts as JSON or markup does: which, by words that each kind has near its beginning.
std::optional<FileKind> kind_of_markup(std::string_view text) {
    text = trimmed_front(text);
    const auto has = [&](std::string_view word) { return text.find(word) != std::string_view::npos; };
    if (text.starts_with('{')) {
        if (has("\"asset\"")) return FileKind{"a glTF scene", "", true};
        if (has("\"environment\"") || has("\"lights\"") || has("\"exposure\"") ||
            has("\"reflection_probes\""))
            return FileKind{"a stage", "candela render SCENE.glb --stage FILE", true};
        return FileKind{"a JSON file", "", true};
    }
    if (!text.starts_with('<')) return std::nullopt;
    const std::string start = lower(std::string(text.substr(0, 512)));
    if (start.find("<html") != std::string::npos || start.find("<!doctype html") != std::string::npos)
        return FileKind{"a web page", "the download went wrong: it is the page about the file", true};
    if (start.find("<collada") != std::string::npos) return FileKind{"a COLLADA scene", kExport, true};
    if (start.find("<svg") != std::string::npos) return FileKind{"an SVG drawing", "", true};
    if (start.find("<scene") != std::string::npos) return FileKind{"a Mitsuba scene", kExport, true};
    return FileKind{"an XML file", "", true};
}

}  // namespace

FileKind kind_of_file(std::span<const std::byte> bytes, const std::filesystem::path& file) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string ending = lower(file.extension().string());
    if (text.starts_with("PK\x03\x04") && ending == ".usdz") return {"a USD scene", kExport, true};
    for (const Magic& magic : kMagics) {
        if (text.size() < magic.offset || !text.substr(magic.offset).starts_with(magic.bytes)) continue;
        // Two letters are no proof: text may begin with them.
        const bool short_name = magic.bytes == "BM" || magic.bytes == "MZ";
        if (short_name && std::none_of(text.begin(), text.end(), [](char c) { return c == '\0'; })) continue;
        return {magic.name, magic.hint, true};
    }
    if (const auto markup = kind_of_markup(text)) return *markup;
    for (const Ending& known : kEndings) {
        if (ending == known.ending) return {known.name, known.hint, false};
    }
    return {};
}

FileKind kind_of_file(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::array<char, 4096> first{};
    stream.read(first.data(), first.size());
    const auto count = static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0));
    return kind_of_file(std::as_bytes(std::span(first.data(), count)), file);
}

std::string not_a(const std::string& expected, const FileKind& kind) {
    return "not " + expected + (kind.name.empty() ? "" : ": " + kind.name);
}

}  // namespace candela::io
