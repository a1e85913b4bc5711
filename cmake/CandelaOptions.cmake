# Language level, warnings, sanitizers and the compiler cache, the same for every target.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_LINK_DEPENDS_NO_SHARED ON)
set(CMAKE_INSTALL_LIBDIR lib CACHE STRING "")  # the same folder on every distribution, so that archives relocate
if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

option(CANDELA_WARNINGS_AS_ERRORS "Treat warnings as errors" ON)
option(CANDELA_SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)

add_library(candela_options INTERFACE)
# Vulkan structures are filled by name after sType; g++ 12's -Wrestrict misfires on std::string operator+ (GCC bug 105329).
target_compile_options(candela_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                       -Wno-missing-field-initializers -Wno-restrict)
if(CANDELA_WARNINGS_AS_ERRORS)
    target_compile_options(candela_options INTERFACE -Werror)
endif()
if(CANDELA_SANITIZE)
    target_compile_options(candela_options INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer)
    target_link_options(candela_options INTERFACE -fsanitize=address,undefined)
endif()
target_compile_definitions(candela_options INTERFACE GLM_ENABLE_EXPERIMENTAL GLM_FORCE_DEPTH_ZERO_TO_ONE)

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
