# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors

# find_package(swiftlet) gives swiftlet::core and swiftlet::swiftlet; tests/consumer does it.
include(CMakePackageConfigHelpers)
set(SWIFTLET_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/swiftlet)

install(TARGETS swiftlet_core swiftlet EXPORT swiftletTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT swiftletTargets NAMESPACE swiftlet:: DESTINATION ${SWIFTLET_PACKAGE_DIR})

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/swiftletConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/swiftletConfig.cmake
                              INSTALL_DESTINATION ${SWIFTLET_PACKAGE_DIR})
# Before 1.0 a minor version may break its users.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/swiftletConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/swiftletConfig.cmake ${PROJECT_BINARY_DIR}/swiftletConfigVersion.cmake
        DESTINATION ${SWIFTLET_PACKAGE_DIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

if(SWIFTLET_BUILD_PROGRAM)
  install(TARGETS swiftlet_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
