# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors

# swiftlet_embed_scenes(swiftlet)
#
# Puts the scene files of sim/scenes/ into the library, so that `sim:apartment` works from anywhere. Writes
# <build>/generated/built_in_scenes.cpp, again whenever a scene changes.
function(swiftlet_embed_scenes target)
  file(GLOB scenes CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/sim/scenes/*.yaml)
  list(SORT scenes)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${scenes})
  set(SWIFTLET_SCENE_ROWS "")
  foreach(scene IN LISTS scenes)
    cmake_path(GET scene STEM name)
    file(READ ${scene} yaml)
    if(NOT yaml MATCHES "\nabout: ([^\n]+)")
      message(FATAL_ERROR "${scene} has no line 'about: ...'")
    endif()
    string(APPEND SWIFTLET_SCENE_ROWS "    {\"${name}\", R\"(${CMAKE_MATCH_1})\", R\"scene_file(${yaml})scene_file\"},\n")
  endforeach()
  set(generated ${PROJECT_BINARY_DIR}/generated/built_in_scenes.cpp)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/built_in_scenes.cpp.in ${generated} @ONLY)
  target_sources(${target} PRIVATE ${generated})
endfunction()
