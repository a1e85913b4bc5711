#include <sys/stat.h>

#include <functional>

#include "gltf_samples.hpp"
#include "limited_run.hpp"
#include "source_folder.hpp"

using namespace candela::test;

namespace {

namespace fs = std::filesystem;

constexpr const char* kScene = "bad.gltf";

struct Malformed {
    const char* name;
    const char*
        mentions;  ///< on the one line of standard error, or in the warning where the scene is readable
    std::function<void(const fs::path& folder)> write_files;
    bool readable = false;  ///< exit code 0 with a warning
};
void PrintTo(const Malformed& m, std::ostream* out) {
    *out << m.name;
}

Malformed bytes(const char* name, const char* mentions, const std::string& content) {
    return {name, mentions, [=](const fs::path& folder) { write(folder / kScene, content); }};
}
/// The same, but readable with a warning.
Malformed read(const char* name, const char* mentions, const std::string& content) {
    return {name, mentions, [=](const fs::path& folder) { write(folder / kScene, content); }, true};
}
Malformed glb(const char* name, const char* mentions, const GltfBuilder& b, bool readable = false) {
    return {name, mentions, [=](const fs::path& folder) { write(folder / kScene, b.glb()); }, readable};
}
Malformed glb(const char* name, const char* mentions, const std::function<void(GltfBuilder&)>& damage,
              bool readable = false) {
    GltfBuilder b = triangle();
    damage(b);
    return glb(name, mentions, b, readable);
}
/// The value at a JSON pointer replaced.
Malformed patched(const char* name, const char* pointer, const json& value, const char* mentions,
                  bool readable = false) {
    return glb(
        name, mentions, [&](GltfBuilder& b) { b.doc[json::json_pointer(pointer)] = value; }, readable);
}
Malformed buffer_uri(const char* name, const std::string& uri, const char* mentions) {
    return glb(name, mentions, [&](GltfBuilder& b) {
        b.doc["buffers"] = {{{"byteLength", 42}, {"uri", uri}}};
    });
}
Malformed picture(const char* name, const std::string& content, const char* mentions) {
    GltfBuilder b = with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    add_texture(b, {reinterpret_cast<const std::byte*>(content.data()),
                    reinterpret_cast<const std::byte*>(content.data()) + content.size()});
    return glb(name, mentions, b, true);
}

std::string big_endian(std::uint32_t v) {
    return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8),
            static_cast<char>(v)};
}

std::vector<Malformed> truncations() {
    const std::string whole = triangle().glb();
    const std::uint32_t json_bytes = *reinterpret_cast<const std::uint32_t*>(whole.data() + 12);
    std::vector<Malformed> out;
    const auto cut = [&](const char* name, std::size_t bytes_kept) {
        out.push_back(bytes(name, kScene, whole.substr(0, bytes_kept)));
    };
    cut("CutAfterMagic", 4);
    cut("CutAfterVersion", 8);
    cut("CutAfterHeader", 12);
    cut("CutInsideJsonChunkHeader", 16);
    cut("CutAfterJsonChunkHeader", 20);
    cut("CutInsideJson", 20 + json_bytes / 2);
    cut("CutAfterJson", 20 + json_bytes);
    cut("CutInsideBinaryChunkHeader", 24 + json_bytes);
    cut("CutAfterBinaryChunkHeader", 28 + json_bytes);
    cut("CutInsideBinary", whole.size() - 1);
    std::string long_chunk = whole;
    long_chunk.replace(12, 4, "\xff\xff\xff\x7f");
    out.push_back(bytes("ChunkLongerThanFile", "chunk", long_chunk));
    std::string no_json = whole;
    no_json.replace(16, 4, "NOSJ");
    out.push_back(bytes("NoJsonChunk", "JSON chunk", no_json));
    std::string version = whole;
    version[4] = 1;
    out.push_back(bytes("ContainerVersionOne", "version 2", version));
    // The container shortened consistently: the buffer then lacks its data.
    GltfBuilder b = triangle();
    b.doc["buffers"] = {{{"byteLength", b.binary.size()}}};
    b.binary.clear();
    out.push_back(glb("NoBinaryChunk", "/buffers/0", b));
    return out;
}

std::vector<Malformed> texts() {
    return {
        bytes("EmptyFile", kScene, ""),
        bytes("NotJson", kScene, "hello"),
        bytes("JsonArray", "not an object", "[]"),
        bytes("JsonNull", "not an object", "null"),
        bytes("CutJson", ":1", R"({"asset":{"version":"2.0")"),
        bytes("DeepJson", "deep", std::string(1000000, '[')),
        bytes("DeepObjects", "deep",
              [] {
                  std::string s;
                  for (int i = 0; i < 100000; ++i) s += R"({"a":)";
                  return s;
              }()),
        read("InvalidUtf8", "Latin-1", "{\"asset\":{\"version\":\"2.0\",\"generator\":\"\xff\xfe\"}}"),
        read("DuplicateKeys", "meshes", R"({"asset":{"version":"2.0"},"meshes":[],"meshes":[]})"),
        bytes("NumberBeyondDouble", kScene, R"({"asset":{"version":"2.0"},"scene":1e999})"),
        bytes("NoVersion", "/asset/version", R"({"asset":{}})"),
        bytes("VersionOne", "/asset/version", R"({"asset":{"version":"1.0"}})"),
        read("VersionIsANumber", "/asset/version", R"({"asset":{"version":2.0}})"),
        {"EmptyScene", "empty",
         [](const fs::path& f) {
             write(f / kScene, R"({"asset":{"version":"2.0"},"scenes":[{}],"scene":0})");
         },
         true},
        {"NothingAtAll", "empty",
         [](const fs::path& f) { write(f / kScene, R"({"asset":{"version":"2.0"}})"); }, true},
        {"AFolder", "folder", [](const fs::path& f) { fs::create_directory(f / kScene); }},
        {"AFifo", "regular", [](const fs::path& f) { mkfifo((f / kScene).c_str(), 0600); }},
        {"NoSuchFile", "no such file", [](const fs::path&) {}},
    };
}

std::vector<Malformed> wrong_types() {
    std::vector<Malformed> out;
    const char* arrays[] = {"buffers", "bufferViews", "accessors", "meshes", "nodes",
                            "scenes",  "materials",   "textures",  "images", "samplers",
                            "skins",   "cameras",     "animations"};
    for (const char* key : arrays) {
        static std::vector<std::string> names;  // the table holds pointers
        names.reserve(64);
        names.push_back(std::string("ObjectFor_") + key);
        const char* name = names.back().c_str();
        out.push_back(
            bytes(name, key, R"({"asset":{"version":"2.0"},")" + std::string(key) + R"(":{"a":1}})"));
    }
    out.insert(
        out.end(),
        {patched("NodeIsAString", "/nodes/0", "node", "/nodes/0", true),
         patched("MeshIndexIsAString", "/nodes/0/mesh", "0", "/nodes/0/mesh", true),
         patched("NegativeIndex", "/nodes/0/mesh", -1, "/nodes/0/mesh", true),
         patched("FractionalIndex", "/nodes/0/mesh", 0.5, "/nodes/0/mesh", true),
         patched("NegativeCount", "/accessors/0/count", -3, "/accessors/0/count"),
         patched("NegativeOffset", "/bufferViews/0/byteOffset", -1, "/bufferViews/0/byteOffset"),
         patched("TranslationOfTwo", "/nodes/0/translation", {1, 2}, "/nodes/0/translation", true),
         patched("TranslationOfStrings", "/nodes/0/translation", {"1", "2", "3"}, "/nodes/0/translation",
                 true),
         patched("MatrixTooShort", "/nodes/0/matrix", {1, 2, 3}, "/nodes/0/matrix", true),
         patched("NumberBeyondFloat", "/nodes/0/scale", {1e300, 1, 1}, "/nodes/0/scale", true),
         patched("AttributesIsAnArray", "/meshes/0/primitives/0/attributes", json::array(), "attributes",
                 true),
         patched("UsedIsAnObject", "/extensionsUsed", {{"a", 1}}, "/extensionsUsed", true),
         patched("RequiredIsAnObject", "/extensionsRequired", {{"a", 1}}, "/extensionsRequired", true),
         patched("UnknownComponentType", "/accessors/0/componentType", 5124, "/accessors/0/componentType"),
         patched("UnknownAccessorType", "/accessors/0/type", "VEC5", "/accessors/0/type"),
         patched("UnknownMode", "/meshes/0/primitives/0/mode", 9, "/meshes/0/primitives/0/mode"),
         patched("ExtensionsIsAnArray", "/nodes/0/extensions", json::array(), "/nodes/0/extensions", true),
         patched("RequiredUnknownExtension", "/extensionsRequired", {"VENDOR_magic"}, "VENDOR_magic"),
         patched("UsedUnknownExtension", "/extensionsUsed", {"VENDOR_magic"}, "VENDOR_magic", true)});
    return out;
}

std::vector<Malformed> ranges() {
    std::vector<Malformed> out{
        patched("MeshOutOfRange", "/nodes/0/mesh", 7, "/nodes/0/mesh", true),
        patched("SceneOutOfRange", "/scene", 3, "/scene", true),
        patched("RootOutOfRange", "/scenes/0/nodes", {9}, "/scenes/0/nodes/0", true),
        patched("RootListedTwice", "/scenes/0/nodes", {0, 0}, "/scenes/0/nodes/1", true),
        patched("MaterialOutOfRange", "/meshes/0/primitives/0/material", 0, "material", true),
        patched("AccessorOutOfRange", "/meshes/0/primitives/0/attributes/POSITION", 1u << 31, "POSITION"),
        patched("ViewOutOfRange", "/accessors/0/bufferView", 99, "/accessors/0/bufferView"),
        patched("BufferOutOfRange", "/bufferViews/0/buffer", 1, "/bufferViews/0/buffer"),
        patched("AccessorPastItsView", "/accessors/0/count", 4, "/accessors/0"),
        patched("AccessorOffsetNear64Bits", "/accessors/0/byteOffset", 18446744073709551604ull,
                "/accessors/0"),
        patched("ViewOffsetNear64Bits", "/bufferViews/0/byteOffset", 18446744073709551604ull,
                "/bufferViews/0"),
        patched("ViewLengthNear64Bits", "/bufferViews/0/byteLength", 18446744073709551615ull,
                "/bufferViews/0", true),
        patched("BillionVertices", "/accessors/0/count", 1000000000, "/accessors/0"),
        patched("CountNear64Bits", "/accessors/0/count", 18446744073709551615ull, "/accessors/0"),
        patched("HugeStride", "/bufferViews/0/byteStride", 4000000000u, "byteStride"),
        patched("StrideLessThanElement", "/bufferViews/0/byteStride", 4, "/accessors/0"),
        patched("IndicesOfFloats", "/accessors/1/componentType", 5126, "/accessors/1"),
        patched("SelfChild", "/nodes/0/children", {0}, "/nodes/0"),
    };
    out.push_back(glb("BillionVerticesWithoutData", "/accessors/0", [](GltfBuilder& b) {
        b.doc["accessors"][0].erase("bufferView");
        b.doc["accessors"][0]["count"] = 1000000000;
    }));
    out.push_back(glb(
        "IndexBeyondVertices", "/indices",
        [](GltfBuilder& b) {
            primitive_of(b)["indices"] = b.accessor<std::uint32_t>({0, 1, 0xffffffffu}, "SCALAR", 1);
        },
        true));
    out.push_back(glb("Cycle", "cycle", [](GltfBuilder& b) {
        b.push("nodes", {{"children", {2}}});
        b.push("nodes", {{"children", {1}}});
    }));
    out.push_back(glb(
        "TwoParents", "parent",
        [](GltfBuilder& b) {
            b.push("nodes", {{"children", {0}}});
            b.push("nodes", {{"children", {0}}});
        },
        true));
    out.push_back(glb(
        "NormalsFewerThanVertices", "NORMAL",
        [](GltfBuilder& b) {
            primitive_of(b)["attributes"]["NORMAL"] = b.accessor<float>({0, 0, 1}, "VEC3", 3);
        },
        true));
    // 40,000 primitives that use all of one accessor of four million zeros: no memory is there for that.
    out.push_back(glb("OneAccessorManyTimes", "memory", [](GltfBuilder& b) {
        b.doc["accessors"][0].erase("bufferView");
        b.doc["accessors"][0]["count"] = 1 << 22;
        primitive_of(b).erase("indices");
        const json primitive = primitive_of(b);
        for (int i = 0; i < 40000; ++i) b.doc["meshes"][0]["primitives"].push_back(primitive);
    }));
    out.push_back(glb(
        "SparseIndexOutOfRange", "sparse",
        [](GltfBuilder& b) {
            const std::vector<std::uint16_t> which{3};
            const int view = b.view(std::as_bytes(std::span(which)));
            b.doc["accessors"][0]["sparse"] = {{"count", 1},
                                               {"indices", {{"bufferView", view}, {"componentType", 5123}}},
                                               {"values", {{"bufferView", 0}}}};
        },
        true));
    for (const char* attribute : {"WEIGHTS_0", "JOINTS_0"}) {  // the fuzzer's finding: read past the end
        GltfBuilder none = skinned();
        const std::size_t index = primitive_of(none)["attributes"][attribute];
        none.doc["accessors"][index]["count"] = 0;
        out.push_back(glb(attribute[0] == 'W' ? "NoWeights" : "NoJoints", attribute, none, true));
    }
    out.push_back(glb("AccessorWithoutCount", "/accessors/0/count",
                      [](GltfBuilder& b) { b.doc["accessors"][0].erase("count"); }));
    GltfBuilder beyond = skinned();
    beyond.doc["skins"][0]["joints"] = {1};
    out.push_back(glb("JointBeyondSkin", "/nodes/0/skin", beyond, true));
    GltfBuilder undefined_time = triangle();
    animate(undefined_time, "translation", "LINEAR", {0, NAN}, {0, 0, 0, 1, 1, 1}, "VEC3", 3);
    out.push_back(glb("KeyTimeNotANumber", "/animations/0/samplers/0/input", undefined_time, true));
    return out;
}

std::vector<Malformed> numbers() {
    const auto positions = [](const char* name, const std::vector<float>& p, const char* warning) {
        return glb(
            name, warning,
            [&](GltfBuilder& b) {
                primitive_of(b)["attributes"]["POSITION"] = b.accessor<float>(p, "VEC3", 3);
            },
            true);
    };
    return {positions("PositionNotANumber", {NAN, 0, 0, 1, 0, 0, 0, 1, 0}, "NaN"),
            positions("PositionInfinite", {INFINITY, 0, 0, 1, 0, 0, 0, 1, 0}, "NaN or infinite"),
            glb(
                "WorldOverflows", "not finite",
                [](GltfBuilder& b) {
                    b.doc["nodes"][0]["scale"] = {1e30, 1e30, 1e30};
                    b.push("nodes", {{"scale", {1e30, 1e30, 1e30}}, {"children", {0}}});
                    b.doc["scenes"][0]["nodes"] = {1};
                },
                true)};
}

std::vector<Malformed> uris() {
    std::vector<Malformed> out{
        buffer_uri("MissingBuffer", "nowhere.bin", "nowhere.bin"),
        buffer_uri("ParentFolder", "../../etc/passwd", "/buffers/0/uri"),
        buffer_uri("EncodedParentFolder", "%2e%2e/%2e%2e/etc/passwd", "/buffers/0/uri"),
        buffer_uri("EncodedSlash", "..%2F..%2Fetc%2Fpasswd", "/buffers/0/uri"),
        buffer_uri("InnerParentFolder", "a/../../etc/passwd", "/buffers/0/uri"),
        buffer_uri("AbsolutePath", "/etc/passwd", "/buffers/0/uri"),
        buffer_uri("EncodedAbsolutePath", "%2Fetc/passwd", "/buffers/0/uri"),
        buffer_uri("FileScheme", "file:///etc/passwd", "/buffers/0/uri"),
        buffer_uri("WebScheme", "https://example.org/a.bin", "/buffers/0/uri"),
        buffer_uri("EmptyUri", "", "/buffers/0/uri"),
        buffer_uri("EncodedZero", "a%00b", "/buffers/0/uri"),
        buffer_uri("ItsOwnFolder", ".", "folder"),
        buffer_uri("LongName", std::string(5000, 'a'), "/buffers/0/uri"),
        buffer_uri("LineBreakInName", "a%0Ab.bin", "no such file"),
        buffer_uri("BrokenBase64", "data:application/octet-stream;base64,AA*A", "/buffers/0/uri"),
        buffer_uri("CutBase64", "data:application/octet-stream;base64,AAAAA", "/buffers/0/uri"),
        buffer_uri("ShortBase64", "data:application/octet-stream;base64,AAAA", "/accessors/"),
        buffer_uri("DataWithoutBase64", "data:text/plain,hello", "/accessors/"),
    };
    const auto through_link = [](const char* name, const char* target) {
        return Malformed{name, "/buffers/0/uri", [=](const fs::path& folder) {
                             GltfBuilder b = triangle();
                             b.doc["buffers"] = {{{"byteLength", 1}, {"uri", "link"}}};
                             write(folder / kScene, b.glb());
                             fs::create_symlink(target, folder / "link");
                         }};
    };
    out.push_back(through_link("LinkOutside", "/etc/passwd"));
    out.push_back(through_link("LinkToItself", "link"));
    return out;
}

std::vector<Malformed> codecs() {
    std::vector<Malformed> out;
    const std::string side = big_endian(100000);
    out.push_back(picture("HugePng",
                          "\x89PNG\r\n\x1a\n" + big_endian(13) + "IHDR" + side + side +
                              std::string("\x08\x06\0\0\0\0\0\0\0", 9),
                          "/images/0"));
    out.push_back(picture("HugeJpeg",
                          std::string("\xff\xd8\xff\xc0\x00\x11\x08\xff\xff\xff\xff\x03\x01\x22\0\x02\x11\x01"
                                      "\x03\x11\x01\xff\xda",
                                      23),
                          "/images/0"));
    // VP8X: canvas of 2^24 on a side.
    out.push_back(picture("HugeWebp",
                          std::string("RIFF\x16\0\0\0WEBPVP8X\x0a\0\0\0\0\0\0\0\xff\xff\xff\xff\xff\xff", 30),
                          "/images/0"));
    const std::vector<std::byte> png = png_of_four_texels();
    out.push_back(picture("CutPng", std::string(reinterpret_cast<const char*>(png.data()), png.size() / 2),
                          "/images/0"));
    out.push_back(picture("NoPicture", "GIF89a", "/images/0"));
    out.push_back(picture("EmptyPicture", "", "/images/0"));
    GltfBuilder draco = draco_strip(4);
    const std::size_t length = draco.doc["bufferViews"][0]["byteLength"];
    GltfBuilder garbage = draco;
    for (std::size_t i = 11; i < length; ++i) garbage.binary[i] = std::byte{0x55};
    out.push_back(glb("DracoGarbage", "KHR_draco_mesh_compression", garbage));
    GltfBuilder cut = draco;
    cut.doc["bufferViews"][0]["byteLength"] = length / 2;
    out.push_back(glb("DracoCut", "KHR_draco_mesh_compression", cut));
    GltfBuilder claims = draco;  // a sequential mesh of 2^32 - 1 faces
    const unsigned char header[] = {1, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, 0x0f, 0xff, 0xff, 0xff, 0xff, 0x0f};
    std::memcpy(claims.binary.data() + 7, header, 1);
    claims.binary[8] = std::byte{0};
    std::memcpy(claims.binary.data() + 11, header + 4, 10);
    out.push_back(glb("DracoBillions", "claims", claims));
    GltfBuilder attribute = draco;
    primitive_of(attribute)["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 9;
    out.push_back(glb("DracoAttributeMissing", "POSITION", attribute));
    const GltfBuilder packed = meshopt_triangle();
    const auto meshopt = [&](const char* name, const char* key, const json& value, const char* mentions) {
        GltfBuilder b = packed;
        b.doc["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value;
        out.push_back(glb(name, mentions, b));
    };
    meshopt("MeshoptCut", "byteLength", 10, "EXT_meshopt_compression");
    meshopt("MeshoptPastBuffer", "byteLength", 100000, "EXT_meshopt_compression");
    meshopt("MeshoptBillions", "count", 1000000000, "/count");
    meshopt("MeshoptStride", "byteStride", 7, "/byteStride");
    meshopt("MeshoptMode", "mode", "TRIANGLES", "/byteStride");
    meshopt("MeshoptFilter", "filter", "OCTAHEDRAL", "/filter");
    GltfBuilder noise = packed;
    std::fill(noise.binary.begin() + 44, noise.binary.end(), std::byte{0xa7});
    out.push_back(glb("MeshoptGarbage", "EXT_meshopt_compression", noise));
    return out;
}

std::vector<Malformed> all() {
    std::vector<Malformed> out;
    for (auto* list : {truncations, texts, wrong_types, ranges, numbers, uris, codecs}) {
        const std::vector<Malformed> some = list();
        out.insert(out.end(), some.begin(), some.end());
    }
    return out;
}

class MalformedInput : public testing::TestWithParam<Malformed> {};

}  // namespace

TEST_P(MalformedInput, IsOneClearLine) {
    const TemporaryFolder folder;
    GetParam().write_files(folder.path());
    const Outcome outcome = info_within_limits(folder / kScene);
    if (!GetParam().readable) {
        expect_one_clear_line(outcome, GetParam().mentions);
        return;
    }
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("  warning  "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(GetParam().mentions), std::string::npos) << outcome.out;
}

INSTANTIATE_TEST_SUITE_P(Gltf, MalformedInput, testing::ValuesIn(all()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(MalformedFiles, OfOthersAreOneClearLineToo) {
    const fs::path folder = CANDELA_SOURCE_DIR "/../shared/data/gltf/malformed";
    if (!fs::exists(folder)) GTEST_SKIP() << "shared data is not here";
    for (const auto& entry : fs::directory_iterator(folder)) {
        const Outcome outcome = info_within_limits(entry.path().string());
        SCOPED_TRACE(entry.path().string());
        if (outcome.exit_code == 0) {
            // Drawn as other viewers draw it, and said.
            EXPECT_NE(outcome.out.find("  warning  "), std::string::npos) << outcome.out;
        } else {
            expect_one_clear_line(outcome, entry.path().parent_path().string());
        }
    }
}
