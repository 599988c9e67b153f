# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors

# find_package(swiftlet) gives swiftlet::core and swiftlet::swiftlet, pkg-config swiftlet-core and swiftlet; tests/consumer
# does both.
include(CMakePackageConfigHelpers)
set(SWIFTLET_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/swiftlet)

# Two sets: whoever asks for the component `core` alone never hears of the libraries that the rest needs.
foreach(part IN ITEMS core swiftlet)
  set(target swiftlet)
  if(part STREQUAL core)
    set(target swiftlet_core)
  endif()
  install(TARGETS ${target} EXPORT ${part}Targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT ${part}Targets NAMESPACE swiftlet:: DESTINATION ${SWIFTLET_PACKAGE_DIR})
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/swiftletConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/swiftletConfig.cmake
                              INSTALL_DESTINATION ${SWIFTLET_PACKAGE_DIR})
# Before 1.0 a minor version may break its users.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/swiftletConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/swiftletConfig.cmake ${PROJECT_BINARY_DIR}/swiftletConfigVersion.cmake
        DESTINATION ${SWIFTLET_PACKAGE_DIR})

# Libraries without a .pc file of their own go by the file that we link.
set(SWIFTLET_PC_LIBS "$<TARGET_LINKER_FILE:BZip2::BZip2>")
if(SWIFTLET_HAS_EMBREE)
  string(APPEND SWIFTLET_PC_LIBS " $<TARGET_LINKER_FILE:embree>")
endif()
if(SWIFTLET_HAS_OMPL)  # its own .pc file names a folder that was not found
  list(GET OMPL_LIBRARIES 0 ompl)
  string(APPEND SWIFTLET_PC_LIBS " ${ompl}")
endif()
if(SWIFTLET_HAS_REALSENSE)
  string(APPEND SWIFTLET_PC_LIBS " $<TARGET_LINKER_FILE:realsense2::realsense2>")
endif()
set(SWIFTLET_PC_REQUIRES "")
if(SWIFTLET_HAS_OCTOMAP)
  set(SWIFTLET_PC_REQUIRES " octomap")
endif()
# From <prefix>/lib/pkgconfig back to <prefix>, wherever that is put.
file(RELATIVE_PATH SWIFTLET_PC_TO_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
foreach(name IN ITEMS swiftlet-core swiftlet)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/${name}.pc.in ${PROJECT_BINARY_DIR}/${name}.pc.configured @ONLY)
  file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/${name}.pc INPUT ${PROJECT_BINARY_DIR}/${name}.pc.configured)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

if(SWIFTLET_BUILD_PROGRAM)
  install(TARGETS swiftlet_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
