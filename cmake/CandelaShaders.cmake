# candela_add_shaders(TARGET FILE...): compiles each GLSL file to SPIR-V at build time and embeds the words in
# TARGET as `extern const std::span<const std::uint32_t>` found by its name: foo.comp.glsl is
# `candela::shaders::foo_comp`, declared in the generated header "candela_shaders/foo_comp.hpp".
find_program(GLSLC glslc REQUIRED)

function(candela_add_shaders target)
    set(out ${CMAKE_CURRENT_BINARY_DIR}/candela_shaders)
    file(MAKE_DIRECTORY ${out})
    foreach(file IN LISTS ARGN)
        get_filename_component(base ${file} NAME)
        string(REGEX REPLACE "\\.(comp|vert|frag)\\.glsl$" "_\\1" symbol ${base})
        string(REGEX MATCH "\\.(comp|vert|frag)\\.glsl$" stage ${base})
        string(REGEX REPLACE "\\.(comp|vert|frag)\\.glsl$" "\\1" stage ${stage})
        add_custom_command(
            OUTPUT ${out}/${symbol}.inc
            COMMAND ${GLSLC} --target-env=vulkan1.3 -O -Werror -fshader-stage=${stage} -I ${PROJECT_SOURCE_DIR}/shading
                    -mfmt=c -MD -MF ${out}/${symbol}.d -MT ${out}/${symbol}.inc -o ${out}/${symbol}.inc
                    ${CMAKE_CURRENT_SOURCE_DIR}/${file}
            DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file}
            DEPFILE ${out}/${symbol}.d
            COMMENT "glslc ${base}"
            VERBATIM)
        file(CONFIGURE OUTPUT ${out}/${symbol}.hpp CONTENT
"#pragma once
#include <cstdint>
#include <span>
namespace candela::shaders { extern const std::span<const std::uint32_t> @symbol@; }
" @ONLY)
        file(CONFIGURE OUTPUT ${out}/${symbol}.cpp CONTENT
"#include \"candela_shaders/@symbol@.hpp\"
namespace {
const std::uint32_t words[] =
#include \"@symbol@.inc\"
;
}
namespace candela::shaders { const std::span<const std::uint32_t> @symbol@{words}; }
" @ONLY)
        set_source_files_properties(${out}/${symbol}.cpp PROPERTIES OBJECT_DEPENDS ${out}/${symbol}.inc
                                    SKIP_PRECOMPILE_HEADERS ON)
        target_sources(${target} PRIVATE ${out}/${symbol}.cpp)
    endforeach()
    target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
endfunction()
