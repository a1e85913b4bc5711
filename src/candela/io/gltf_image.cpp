#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <thread>

#include "candela/io/gltf_material.hpp"
#include "candela/io/image_read.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

constexpr const char* kWithout = "drawn without this texture";

scene::Sampler read_sampler(const JsonView& sampler) {
    scene::Sampler out;
    if (!sampler.exists()) return out;
    const auto wrap = [](const JsonView& value) {
        switch (value.optional_unsigned().value_or(10497)) {
            case 10497:
                return scene::Wrap::repeat;
            case 33648:
                return scene::Wrap::mirrored_repeat;
            case 33071:
                return scene::Wrap::clamp_to_edge;
            case 10496:  // GL_CLAMP
            case 33069:  // GL_CLAMP_TO_BORDER
                value.repaired("is not a wrap mode of glTF: read as 33071 (clamp to edge)");
                return scene::Wrap::clamp_to_edge;
            default:
                value.repaired("is not a wrap mode of glTF: read as 10497 (repeat)");
                return scene::Wrap::repeat;
        }
    };
    out.wrap_s = wrap(sampler["wrapS"]);
    out.wrap_t = wrap(sampler["wrapT"]);
    using scene::Filter;
    using scene::MipFilter;
    const JsonView magnify = sampler["magFilter"];
    switch (magnify.optional_unsigned().value_or(9729)) {
        case 9729:
            break;
        case 9728:
            out.magnify = Filter::nearest;
            break;
        case 9984:
        case 9986:
            magnify.repaired("is not a filter for magnification: read as 9728 (nearest)");
            out.magnify = Filter::nearest;
            break;
        default:
            magnify.repaired("is not a filter for magnification: read as 9729 (linear)");
    }
    const JsonView minify = sampler["minFilter"];
    switch (minify.optional_unsigned().value_or(9987)) {
        case 9728:
            out.minify = Filter::nearest, out.mip = MipFilter::none;
            break;
        case 9729:
            out.minify = Filter::linear, out.mip = MipFilter::none;
            break;
        case 9984:
            out.minify = Filter::nearest, out.mip = MipFilter::nearest;
            break;
        case 9985:
            out.minify = Filter::linear, out.mip = MipFilter::nearest;
            break;
        case 9986:
            out.minify = Filter::nearest, out.mip = MipFilter::linear;
            break;
        case 9987:
            break;
        default:
            minify.repaired("is not a filter of glTF: read as 9987 (linear, mipmaps linear)");
    }
    return out;
}

std::vector<std::uint32_t> used_images(scene::Scene& scene) {
    std::set<std::uint32_t> used;
    for (scene::Material& m : scene.materials) {
        for (const scene::TextureRef* ref : texture_refs(m)) {
            if (*ref && scene.textures[ref->texture].image != scene::no_index)
                used.insert(scene.textures[ref->texture].image);
        }
    }
    return {used.begin(), used.end()};
}

/// Where the bytes of an image come from, found before the threads start.
struct ImageSource {
    std::uint32_t index = 0;
    std::string where;
    std::string uri;  ///< empty: of a buffer view
    std::span<const std::byte> bytes;
    std::optional<Error> fault;
    PlacedWarnings said;
};

/// Throws Error for a URI that may not be read.
ImageSource find_source(const GltfDocument& document, std::uint32_t index) {
    const JsonView image = document.element("images", index);
    const JsonView uri = image["uri"];
    ImageSource out;
    out.index = index;
    out.where = uri.exists() ? uri.where() : image.where();
    if (out.uri = uri.string_or(""); !out.uri.empty()) {
        document.check_uri(out.uri, out.where);
        return out;
    }
    try {
        out.bytes =
            document.buffer_view(image["bufferView"].required_index_below(document.count("bufferViews")));
    } catch (const Error& error) {
        out.fault = error;
    }
    return out;
}

void decode(const GltfDocument& document, ImageSource& source, scene::Image& out) {
    if (source.uri.empty()) {
        out = decode_image(source.bytes, source.where);
    } else {
        out = decode_image(document.read_uri(source.uri, source.where, source.said), source.where);
    }
}

/// Takes textures without an image out of the materials: they are drawn as if they had none.
void drop_textures_without_image(scene::Scene& scene) {
    for (scene::Material& m : scene.materials) {
        for (scene::TextureRef* ref : texture_refs(m)) {
            if (!*ref) continue;
            const std::uint32_t image = scene.textures[ref->texture].image;
            if (image == scene::no_index || scene.images[image].rgba.empty()) *ref = {};
        }
    }
}

}  // namespace

scene::Texture read_texture(const GltfDocument& document, std::uint32_t index) {
    const JsonView texture = document.element("textures", index);
    scene::Texture out;
    const std::size_t images = document.count("images");
    const auto webp = texture["extensions"]["EXT_texture_webp"]["source"].index_below(images);
    const auto image = webp ? webp : texture["source"].index_below(images);
    if (image) out.image = *image;
    if (!image) texture.repaired(std::string("has no image that can be read: ") + kWithout);
    if (const auto sampler = texture["sampler"].index_below(document.count("samplers")))
        out.sampler = read_sampler(document.element("samplers", *sampler));
    return out;
}

void read_images(const GltfDocument& document, const StepFunction& progress, scene::Scene& scene) {
    std::vector<ImageSource> work;
    // Compressed buffer views are decoded on demand into a shared cache: before the threads start.
    // What they decode to is known from their headers, before minutes go into decoding them.
    for (const std::uint32_t index : used_images(scene)) {
        work.push_back(find_source(document, index));
        if (!work.back().bytes.empty())
            document.reserve(decoded_bytes(work.back().bytes), document.array("images"));
    }
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    std::size_t decoded = 0;
    const auto decode_all = [&] {
        for (std::size_t i = next++; i < work.size(); i = next++) {
            ImageSource& source = work[i];
            try {
                if (!source.fault) {
                    scene::Image& image = scene.images[source.index];
                    decode(document, source, image);
                    const std::lock_guard lock(mutex);
                    if (!source.uri.empty()) document.reserve(image.rgba.size(), document.array("images"));
                }
            } catch (const Error& error) {
                source.fault = error;
                scene.images[source.index] = {};
            }
            if (!progress) continue;
            const std::lock_guard lock(mutex);
            progress("textures", double(++decoded) / double(work.size()));
        }
    };
    {
        std::vector<std::jthread> threads;
        const std::size_t count =
            std::min<std::size_t>(std::max(1u, std::thread::hardware_concurrency()), work.size());
        for (std::size_t t = 1; t < count; ++t) threads.emplace_back(decode_all);
        decode_all();
    }
    for (const ImageSource& source : work) {
        document.warnings().add(source.said);
        scene.images[source.index].name = document.element("images", source.index)["name"].string_or("");
        if (!source.fault) continue;
        document.try_to_read(document.element("images", source.index), kWithout,
                             [&] { throw Error(*source.fault); });
    }
    drop_textures_without_image(scene);
}

}  // namespace candela::io
