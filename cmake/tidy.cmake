# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors

# Ninja then re-runs clang-tidy only on what changed. The hash of .clang-tidy goes into the command line, so
# that a changed rule re-runs it on everything.
if(SWIFTLET_TIDY)
  find_program(SWIFTLET_CLANG_TIDY NAMES clang-tidy-14 REQUIRED)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/.clang-tidy)
  file(SHA256 ${PROJECT_SOURCE_DIR}/.clang-tidy SWIFTLET_TIDY_RULES)
endif()

function(swiftlet_tidy target)
  if(SWIFTLET_TIDY)
    set_target_properties(${target} PROPERTIES CXX_CLANG_TIDY
      "${SWIFTLET_CLANG_TIDY};--quiet;--extra-arg=-Wno-unknown-warning-option;--extra-arg=-DSWIFTLET_TIDY_RULES=${SWIFTLET_TIDY_RULES}")
  endif()
endfunction()
