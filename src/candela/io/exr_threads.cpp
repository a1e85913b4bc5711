#include "candela/io/exr_threads.hpp"

#include <ImfThreading.h>

#include <algorithm>
#include <mutex>
#include <thread>

namespace candela::io::detail {

int exr_threads(std::uint64_t texels) {
    constexpr std::uint64_t small = 1u << 16;
    constexpr int most = 16;
    const int cores = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, most);
    if (texels < small || cores == 1) return 0;
    // The pool belongs to OpenEXR and is one for the process; a program that set it up itself keeps its own.
    static std::once_flag once;
    std::call_once(once, [&] {
        if (Imf::globalThreadCount() == 0) Imf::setGlobalThreadCount(cores);
    });
    return cores;
}

}  // namespace candela::io::detail
