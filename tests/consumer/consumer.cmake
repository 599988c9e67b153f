# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors

# Defines the ctest cases of label `consumer`: Swiftlet installed and found, and Swiftlet added as a folder.
set(consumer_dir ${PROJECT_BINARY_DIR}/consumer)
set(consumer_common -G ${CMAKE_GENERATOR} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER})
if(SWIFTLET_HAS_REALSENSE)
  list(APPEND consumer_common -Drealsense2_DIR=${realsense2_DIR})
endif()

# consumer_case(NAME PROGRAMS use_core ... CONFIGURE -D...): configures, builds and runs programs of the consumer.
function(consumer_case name)
  cmake_parse_arguments(CASE "" "" "PROGRAMS;CONFIGURE" ${ARGN})
  add_test(NAME consumer.${name}.configure
           COMMAND ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_SOURCE_DIR}/consumer -B ${consumer_dir}/${name} --fresh
                   ${consumer_common} ${CASE_CONFIGURE})
  add_test(NAME consumer.${name}.build COMMAND ${CMAKE_COMMAND} --build ${consumer_dir}/${name} --parallel 2
                   --target ${CASE_PROGRAMS})
  set_tests_properties(consumer.${name}.configure PROPERTIES FIXTURES_SETUP consumer_${name}_configured)
  set_tests_properties(consumer.${name}.build PROPERTIES FIXTURES_REQUIRED consumer_${name}_configured
                                                         FIXTURES_SETUP consumer_${name}_built)
  set_tests_properties(consumer.${name}.configure consumer.${name}.build PROPERTIES LABELS consumer)
  foreach(program IN LISTS CASE_PROGRAMS)
    add_test(NAME consumer.${name}.${program} COMMAND ${consumer_dir}/${name}/${program})
    set_tests_properties(consumer.${name}.${program} PROPERTIES FIXTURES_REQUIRED consumer_${name}_built LABELS consumer)
  endforeach()
endfunction()

if(SWIFTLET_INSTALL)
  # Into a fresh folder: a file that was forgotten must not be found from an earlier install.
  add_test(NAME consumer.clear COMMAND ${CMAKE_COMMAND} -E rm -rf ${consumer_dir}/prefix)
  add_test(NAME consumer.install
           COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${consumer_dir}/prefix)
  set_tests_properties(consumer.clear PROPERTIES LABELS consumer FIXTURES_SETUP consumer_cleared)
  set_tests_properties(consumer.install PROPERTIES LABELS consumer FIXTURES_REQUIRED consumer_cleared
                                                   FIXTURES_SETUP consumer_installed)
  consumer_case(find_package PROGRAMS use_core use_all CONFIGURE -DCMAKE_PREFIX_PATH=${consumer_dir}/prefix)
  set_tests_properties(consumer.find_package.configure PROPERTIES FIXTURES_REQUIRED consumer_installed)
endif()
# The core alone: the rest would compile once more what the build before has shown to compile.
consumer_case(add_subdirectory PROGRAMS use_core CONFIGURE -DSWIFTLET_FOLDER=${PROJECT_SOURCE_DIR})
