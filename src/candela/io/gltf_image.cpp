#include <atomic>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

#include "candela/io/gltf_material.hpp"
#include "candela/io/image_read.hpp"

namespace candela::io {
namespace {

scene::Sampler read_sampler(const JsonView& sampler) {
    scene::Sampler out;
    if (!sampler.exists()) return out;
    const auto wrap = [](const JsonView& value) {
        switch (value.unsigned_or(10497)) {
            case 10497:
                return scene::Wrap::repeat;
            case 33648:
                return scene::Wrap::mirrored_repeat;
            case 33071:
                return scene::Wrap::clamp_to_edge;
            default:
                value.fail("is not a wrap mode of glTF");
        }
    };
    out.wrap_s = wrap(sampler["wrapS"]);
    out.wrap_t = wrap(sampler["wrapT"]);
    const std::uint64_t magnify = sampler["magFilter"].unsigned_or(9729);
    if (magnify != 9728 && magnify != 9729) sampler["magFilter"].fail("is not a filter of glTF");
    out.magnify = magnify == 9728 ? scene::Filter::nearest : scene::Filter::linear;
    const std::uint64_t minify = sampler["minFilter"].unsigned_or(9987);
    using scene::Filter;
    using scene::MipFilter;
    switch (minify) {
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
            sampler["minFilter"].fail("is not a filter of glTF");
    }
    return out;
}

std::set<std::uint32_t> used_images(const scene::Scene& scene) {
    std::set<std::uint32_t> used;
    const auto use = [&](const scene::TextureRef& ref) {
        if (ref && scene.textures[ref.texture].image != scene::no_index)
            used.insert(scene.textures[ref.texture].image);
    };
    for (const scene::Material& m : scene.materials) {
        for (const scene::TextureRef* ref :
             {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.occlusion_texture,
              &m.emissive_texture, &m.specular_texture, &m.specular_color_texture, &m.clearcoat.texture,
              &m.clearcoat.roughness_texture, &m.clearcoat.normal_texture, &m.sheen.color_texture,
              &m.sheen.roughness_texture, &m.anisotropy.texture}) {
            use(*ref);
        }
    }
    return used;
}

scene::Image load_image(const GltfDocument& document, std::uint32_t index) {
    const JsonView image = document.element("images", index);
    scene::Image out;
    if (const JsonView uri = image["uri"]; uri.exists()) {
        const std::vector<std::byte> bytes = document.read_uri(uri.string_or(""), uri.where());
        out = decode_image(bytes, uri.where());
    } else {
        const std::uint32_t view = image["bufferView"].required_index_below(document.count("bufferViews"));
        out = decode_image(document.buffer_view(view), image.where());
    }
    out.name = image["name"].string_or("");
    return out;
}

}  // namespace

void read_textures(const GltfDocument& document, scene::Scene& scene) {
    for (std::size_t i = 0; i < document.count("textures"); ++i) {
        const JsonView texture = document.element("textures", i);
        scene::Texture out;
        const JsonView extensions = texture["extensions"];
        const JsonView webp = extensions["EXT_texture_webp"]["source"];
        const JsonView source = webp.exists() ? webp : texture["source"];
        if (const auto image = source.index_below(document.count("images"))) out.image = *image;
        if (const auto sampler = texture["sampler"].index_below(document.count("samplers"))) {
            out.sampler = read_sampler(document.element("samplers", *sampler));
        }
        scene.textures.push_back(out);
    }
    scene.images.resize(document.count("images"));
}

void read_images(const GltfDocument& document, const StepFunction& progress, scene::Scene& scene) {
    const std::set<std::uint32_t> used = used_images(scene);
    const std::vector<std::uint32_t> work(used.begin(), used.end());
    // Compressed buffer views are decoded on demand into a shared cache: before the threads start.
    // What they decode to is known from their headers, before minutes go into decoding them.
    for (const std::uint32_t i : work) {
        const JsonView image = document.element("images", i);
        if (const auto index = image["bufferView"].index_below(document.count("bufferViews")))
            document.reserve(decoded_bytes(document.buffer_view(*index)), document.array("images"));
    }
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    std::size_t decoded = 0;
    std::exception_ptr first_error;
    std::size_t first_error_at = work.size();
    const auto decode = [&] {
        for (std::size_t i = next++; i < work.size(); i = next++) {
            try {
                scene.images[work[i]] = load_image(document, work[i]);
                const std::lock_guard lock(mutex);
                if (document.element("images", work[i])["uri"].exists())
                    document.reserve(scene.images[work[i]].rgba.size(), document.array("images"));
                if (progress) progress("textures", double(++decoded) / double(work.size()));
            } catch (...) {
                // The first in the file's order is reported, whichever thread met it.
                const std::lock_guard lock(mutex);
                if (i < first_error_at) {
                    first_error_at = i;
                    first_error = std::current_exception();
                }
            }
        }
    };
    {
        std::vector<std::jthread> threads;
        const std::size_t count =
            std::min<std::size_t>(std::max(1u, std::thread::hardware_concurrency()), work.size());
        for (std::size_t t = 1; t < count; ++t) threads.emplace_back(decode);
        decode();
    }
    if (first_error) std::rethrow_exception(first_error);
}

}  // namespace candela::io
