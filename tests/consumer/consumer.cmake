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
    set(arguments "")
    if(program STREQUAL "library_tour")
      if(NOT SWIFTLET_HAS_EMBREE)  # no flight at hand; that it links is shown
        continue()
      endif()
      set(arguments ${PROJECT_SOURCE_DIR}/examples/configs/indoor.yaml sim:wall ${consumer_dir}/${name}/tour)
    endif()
    add_test(NAME consumer.${name}.${program} COMMAND ${consumer_dir}/${name}/${program} ${arguments})
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
  consumer_case(find_package PROGRAMS use_core use_all library_tour
                CONFIGURE -DCMAKE_PREFIX_PATH=${consumer_dir}/prefix)
  set_tests_properties(consumer.find_package.configure PROPERTIES FIXTURES_REQUIRED consumer_installed)
  # The core alone, on a machine that has nothing of what the rest needs.
  set(not_there "")
  foreach(package SQLite3 PNG yaml-cpp BZip2 OpenSSL embree octomap realsense2)
    list(APPEND not_there -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
  endforeach()
  consumer_case(core_alone PROGRAMS use_core
                CONFIGURE -DCMAKE_PREFIX_PATH=${consumer_dir}/prefix -DSWIFTLET_COMPONENTS=core ${not_there})
  set_tests_properties(consumer.core_alone.configure PROPERTIES FIXTURES_REQUIRED consumer_installed)
  # pkg-config, for who does not use CMake.
  set(pc_path ${consumer_dir}/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  foreach(use swiftlet-core:use_core swiftlet:use_all)
    string(REGEX REPLACE ":.*" "" package ${use})
    string(REGEX REPLACE ".*:" "" program ${use})
    set(built ${consumer_dir}/${package}.by_pkg_config)
    add_test(NAME consumer.pkg_config.${package}
             COMMAND sh -c "set -e; flags=$(PKG_CONFIG_PATH=${pc_path} pkg-config --cflags --libs ${package}); \
${CMAKE_CXX_COMPILER} -std=c++20 ${CMAKE_CURRENT_SOURCE_DIR}/consumer/${program}.cpp -o ${built} $flags; ${built}")
    set_tests_properties(consumer.pkg_config.${package} PROPERTIES FIXTURES_REQUIRED consumer_installed LABELS consumer)
    if(SWIFTLET_HAS_REALSENSE)  # the SDK may lie where no loader looks; CMake writes that into its programs, pkg-config not
      set_tests_properties(consumer.pkg_config.${package} PROPERTIES
                           ENVIRONMENT "LD_LIBRARY_PATH=$<TARGET_FILE_DIR:realsense2::realsense2>")
    endif()
  endforeach()
endif()
# The core alone: the rest would compile once more what the build before has shown to compile.
consumer_case(add_subdirectory PROGRAMS use_core CONFIGURE -DSWIFTLET_FOLDER=${PROJECT_SOURCE_DIR})
