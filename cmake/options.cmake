# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors

# No more compilers at once than the machine's memory holds (Ninja obeys; each takes up to 1.3 GB).
cmake_host_system_information(RESULT memory_mb QUERY TOTAL_PHYSICAL_MEMORY)
math(EXPR compilers "${memory_mb} / 1500 + 1")
set_property(GLOBAL APPEND PROPERTY JOB_POOLS swiftlet_compilers=${compilers})

# Release optimises for the frame path (-O3). LEVEL is for what never runs in a frame: less time to compile.
function(swiftlet_optimise target level)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
endfunction()

# Everything a Swiftlet target is compiled with; nothing of it reaches a consumer.
# -Wno-sign-conversion: clang's -Wconversion contains it, GCC's does not; the two shall agree.
function(swiftlet_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON
                                             JOB_POOL_COMPILE swiftlet_compilers)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wdeprecated-copy-dtor
    -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual
    # The same map bits on x86-64 and aarch64: no silent fused multiply-add.
    -ffp-contract=off)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)  # "text" + std::string is a false alarm: GCC bug 105651
  endif()
  if(SWIFTLET_UNITY)  # several files to one compiler run: most of the time goes into headers that they share
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 32)
    # True of files, not of their sum.
    target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
  if(SWIFTLET_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(SWIFTLET_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${SWIFTLET_SANITIZE} -fno-omit-frame-pointer
                                             -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC $<BUILD_INTERFACE:-fsanitize=${SWIFTLET_SANITIZE}>)
  endif()
  if(SWIFTLET_COVERAGE)
    target_compile_options(${target} PRIVATE --coverage)
    target_link_options(${target} PUBLIC $<BUILD_INTERFACE:--coverage>)
  endif()
endfunction()
