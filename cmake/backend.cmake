# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors

# swiftlet_backend(NAME octomap PACKAGE octomap)
#
# Declares an optional part, SWIFTLET_WITH_<NAME> = AUTO | ON | OFF, and sets SWIFTLET_HAS_<NAME> to 1 or 0.
# ON and missing is a configure error; AUTO and missing prints one line. The registries list both kinds.
macro(swiftlet_backend)
  cmake_parse_arguments(BACKEND "" "NAME;PACKAGE;VERSION" "" ${ARGN})
  string(TOUPPER ${BACKEND_NAME} BACKEND_UPPER)
  set(SWIFTLET_WITH_${BACKEND_UPPER} AUTO CACHE STRING "Build the ${BACKEND_NAME} backend: AUTO, ON or OFF")
  set_property(CACHE SWIFTLET_WITH_${BACKEND_UPPER} PROPERTY STRINGS AUTO ON OFF)
  set(SWIFTLET_HAS_${BACKEND_UPPER} 0)
  if(NOT SWIFTLET_WITH_${BACKEND_UPPER} STREQUAL "OFF")
    find_package(${BACKEND_PACKAGE} ${BACKEND_VERSION} QUIET)
    if(${BACKEND_PACKAGE}_FOUND)
      set(SWIFTLET_HAS_${BACKEND_UPPER} 1)
    elseif(SWIFTLET_WITH_${BACKEND_UPPER} STREQUAL "ON")
      message(FATAL_ERROR "SWIFTLET_WITH_${BACKEND_UPPER}=ON, but the package ${BACKEND_PACKAGE} was not found")
    else()
      message(STATUS "${BACKEND_NAME}: not built (package ${BACKEND_PACKAGE} not found)")
    endif()
  endif()
endmacro()
