# candela_add_module(NAME [DEPENDS module...] [PRIVATE lib...]): the static library candela_NAME of every .cpp in the
# current folder, for tests that need just this module. The shared library `candela` is made of the same objects.
function(candela_add_module name)
    cmake_parse_arguments(arg "" "" "DEPENDS;PRIVATE" ${ARGN})
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
    if(NOT sources)
        file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp CONTENT "")
        set(sources ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp)
    endif()
    add_library(candela_${name} STATIC ${sources})
    target_include_directories(candela_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
    target_link_libraries(candela_${name} PUBLIC ${arg_DEPENDS} PRIVATE candela_options ${arg_PRIVATE})
    target_compile_definitions(candela_${name} PUBLIC GLM_ENABLE_EXPERIMENTAL GLM_FORCE_DEPTH_ZERO_TO_ONE)
    set_property(GLOBAL APPEND PROPERTY CANDELA_MODULES candela_${name})
    set_property(GLOBAL APPEND PROPERTY CANDELA_MODULE_LIBRARIES ${arg_PRIVATE})
endfunction()

# candela_add_test(NAME LIBS...): the GoogleTest program test_NAME of every .cpp in the current folder, one CTest entry
# a case.
function(candela_add_test name)
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
    add_executable(test_${name} ${sources})
    target_link_libraries(test_${name} PRIVATE candela_options ${ARGN} GTest::gtest_main)
    target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    target_include_directories(test_${name} PRIVATE ${PROJECT_BINARY_DIR}/tests/generated)
    gtest_discover_tests(test_${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60)
endfunction()
