# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors

# include/swiftlet/core.hpp and swiftlet.hpp are the lists of what is public. What they name, and what that includes, is
# installed; no other header is.

# swiftlet_public_headers(OUT LIST): the files that a list names, and all that those include; the list itself first.
function(swiftlet_public_headers out list)
  set(open swiftlet/${list})
  set(files "")
  while(open)
    list(POP_FRONT open header)
    set(file ${PROJECT_SOURCE_DIR}/src/${header})
    if(NOT EXISTS ${file})
      set(file ${PROJECT_SOURCE_DIR}/include/${header})
    endif()
    if(file IN_LIST files)
      continue()
    endif()
    list(APPEND files ${file})
    file(STRINGS ${file} lines REGEX "^#include \"swiftlet/")
    list(TRANSFORM lines REPLACE "^#include \"([^\"]+)\".*" "\\1")
    list(APPEND open ${lines})
  endwhile()
  # An #include that is added may add a header.
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
  set(${out} ${files} PARENT_SCOPE)
endfunction()

# swiftlet_has_public_headers(TARGET LIST WITHOUT FILE...): those of the list belong to the target and are installed
# with it, but for those that another target has.
function(swiftlet_has_public_headers target list)
  cmake_parse_arguments(HEADERS "" "" WITHOUT ${ARGN})
  swiftlet_public_headers(files ${list})
  if(HEADERS_WITHOUT)
    list(REMOVE_ITEM files ${HEADERS_WITHOUT})
  endif()
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/include
                                                   FILES ${files})
endfunction()
