#define VK_NO_PROTOTYPES
#define VOLK_IMPLEMENTATION
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wpedantic"
#endif
#include <volk.h>
