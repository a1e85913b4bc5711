# candela_embed_files(TARGET FOLDER NAMESPACE FILE...): embeds text files at build time. foo.bar.js is
# `candela::NAMESPACE::foo_bar_js`, a std::string_view declared in the generated header "FOLDER/files.hpp".
function(candela_embed_files target folder namespace)
    set(out ${CMAKE_CURRENT_BINARY_DIR}/${folder})
    set(declarations "")
    set(sources "")
    foreach(file IN LISTS ARGN)
        get_filename_component(path ${file} ABSOLUTE)
        get_filename_component(base ${file} NAME)
        string(MAKE_C_IDENTIFIER ${base} symbol)
        string(APPEND declarations "extern const std::string_view ${symbol};\n")
        add_custom_command(
            OUTPUT ${out}/${symbol}.cpp
            COMMAND ${CMAKE_COMMAND} -DIN=${path} -DOUT=${out}/${symbol}.cpp -DSYMBOL=${symbol} -DNAMESPACE=${namespace}
                    -P ${PROJECT_SOURCE_DIR}/cmake/EmbedFile.cmake
            DEPENDS ${path} ${PROJECT_SOURCE_DIR}/cmake/EmbedFile.cmake
            COMMENT "embed ${base}"
            VERBATIM)
        list(APPEND sources ${out}/${symbol}.cpp)
    endforeach()
    file(CONFIGURE OUTPUT ${out}/files.hpp CONTENT
"#pragma once
#include <string_view>
namespace candela::@namespace@ {
@declarations@}
" @ONLY)
    target_sources(${target} PRIVATE ${sources})
    target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
endfunction()
