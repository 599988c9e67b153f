// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "swiftlet/sim/ray_caster.hpp"

namespace swiftlet::sim {

struct DeviceDeleter {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DevicePtr = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceDeleter>;
using ScenePtr = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneDeleter>;

/// What Embree keeps of a geometry, as it is now.
struct CornerBuffers {
  const float* vertices;           // x, y, z
  const std::uint32_t* triangles;  // three vertices each
};

struct RayCaster::Embree {
  struct Moving {
    Flight path;
    TriangleMesh at_origin;
    RTCGeometry geometry;  // owned by the scene
    float* vertices;       // Embree's copy
  };

  /// Triangles of geometry 0, which never move, and of one geometry per mover.
  Expected<unsigned> attach(const TriangleMesh& mesh, bool moves);

  DevicePtr device;
  ScenePtr scene;
  std::vector<float> texture_of_material;
  std::vector<std::vector<float>> texture_of;  // [geometry][triangle]
  std::vector<CornerBuffers> corners;          // [geometry]
  std::vector<Moving> movers;
};

}  // namespace swiftlet::sim
