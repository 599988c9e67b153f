# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors

# Core: what a planner that links swiftlet::core needs.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(tl-expected REQUIRED)
find_package(fmt 9 REQUIRED)
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET libhwy)  # SIMD, with dispatch at run time

# I/O: what swiftlet::swiftlet adds.
find_package(SQLite3 REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(yaml-cpp REQUIRED)
pkg_check_modules(zstd REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(lz4 REQUIRED IMPORTED_TARGET liblz4)
find_package(BZip2 REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)  # HMAC of poses that come over a network

# Optional parts (see swiftlet_backend()).
swiftlet_backend(NAME embree PACKAGE embree)    # ray casts the simulated scenes
swiftlet_backend(NAME octomap PACKAGE octomap)  # writes and reads .bt / .ot
swiftlet_backend(NAME ompl PACKAGE ompl)        # plans paths on the map
swiftlet_backend(NAME realsense PACKAGE realsense2)  # live cameras (docs/realsense.md)

# The program.
if(SWIFTLET_BUILD_PROGRAM)
  list(APPEND CMAKE_MODULE_PATH ${PROJECT_SOURCE_DIR}/cmake)
  swiftlet_backend(NAME view PACKAGE SwiftletView)  # the ground station: its server and its page
  swiftlet_backend(NAME mavlink PACKAGE Boost VERSION 1.74)  # links to an autopilot (docs/autopilot.md)
  find_package(CLI11 REQUIRED)
  find_package(nlohmann_json REQUIRED)
endif()

# yaml-cpp named its target plainly before 0.8.
if(TARGET yaml-cpp::yaml-cpp)
  set(SWIFTLET_YAML_CPP yaml-cpp::yaml-cpp)
else()
  set(SWIFTLET_YAML_CPP yaml-cpp)
endif()
