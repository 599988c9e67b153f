# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors

# Several files of a target to one compiler run, for what is compiled more often than it is changed.
function(swiftlet_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON)
  target_compile_options(${target} PRIVATE -Wno-shadow -Wno-subobject-linkage)  # true of files, not of their sum
endfunction()

# Everything a Swiftlet target is compiled with; nothing of it reaches a consumer.
# -Wno-sign-conversion: clang's -Wconversion contains it, GCC's does not; the two shall agree.
function(swiftlet_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wdeprecated-copy-dtor
    -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual
    # The same map bits on x86-64 and aarch64: no silent fused multiply-add.
    -ffp-contract=off)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)  # "text" + std::string is a false alarm: GCC bug 105651
  endif()
  if(CMAKE_UNITY_BUILD)
    swiftlet_compile_together(${target})
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
