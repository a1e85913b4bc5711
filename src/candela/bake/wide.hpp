#pragma once

// Compiles a function a second time for processors with wide fused arithmetic, and takes that where it runs
// on one: loops over arrays are worth twice as much there. Not with a sanitizer, which meets the choice
// before it is set up.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define CANDELA_WIDE __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define CANDELA_WIDE
#endif
