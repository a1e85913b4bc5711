# cmake --install: the library with its headers and the shading sources, the programs, and find_package(candela).
include(CMakePackageConfigHelpers)

install(TARGETS candela EXPORT candela-targets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS candela_app candela-scenes RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY src/candela TYPE INCLUDE FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY shading TYPE INCLUDE FILES_MATCHING PATTERN "*.glsl")

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/candela)
install(EXPORT candela-targets NAMESPACE candela:: DESTINATION ${config_folder})
configure_package_config_file(cmake/candela-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/candela-config.cmake
                              INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/candela-config-version.cmake
                                 COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/candela-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/candela-config-version.cmake
        DESTINATION ${config_folder})
