#include <cstddef>
#include <cstdint>
#include <span>

#include "candela/io/gltf.hpp"
#include "candela/scene/error.hpp"

// Any bytes are either a scene or an Error; everything else (a signal, a leak, another exception) is a
// finding.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    candela::Diagnostics diagnostics;
    candela::io::GltfOptions options;
    options.time_s = 0.5f;
    try {
        (void)candela::io::load_gltf_from_memory(std::as_bytes(std::span(data, size)), "fuzz", options,
                                                 diagnostics);
    } catch (const candela::Error&) {
    }
    return 0;
}
