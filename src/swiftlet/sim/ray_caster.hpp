// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/time.hpp"
#include "swiftlet/sim/scene.hpp"

namespace swiftlet::sim {

/// Where a ray meets the scene first.
struct Hit {
  float distance = std::numeric_limits<float>::infinity();  ///< in lengths of the ray's direction
  float cos_incidence = 0.0F;                               ///< 1 head-on, 0 grazing
  float texture = 0.0F;                                     ///< of the surface's material
};

/// Corners of a triangle. [m, world]
using Triangle = std::array<Eigen::Vector3f, 3>;

/// The geometry of a scene, for rays and for distances (Embree). Frame: world, metres, float:
/// errors stay below 1e-6 of the scene's extent. Thread safety: rays may be cast from many threads;
/// move_to() needs the object alone.
class RayCaster {
 public:
  /// Errors: kInvalidConfig for more than kMaxTriangles and for corners beyond is_within_reach();
  /// kOutOfMemory, kUnsupported with Embree's own words.
  [[nodiscard]] static Expected<RayCaster> create(const Scene& scene);
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;
  ~RayCaster();

  /// Puts the movers where they are at a time. Cost: nothing without movers, else O(objects).
  void move_to(Nanoseconds since_start);

  /// First hits of rays that share an origin, none from beyond is_within_reach(); faster if
  /// neighbours point in similar directions. REQUIRES: hits.size() == directions.size().
  void cast(const Eigen::Vector3f& origin_m, std::span<const Eigen::Vector3f> directions,
            std::span<Hit> hits) const;

  /// Whether nothing stands between `eye_m` and each point. A point counts as seen if its own
  /// surface is the first; what lies within 0.1 % of the distance in front of it is its surface.
  /// REQUIRES: is_seen.size() == points_m.size().
  void look(const Eigen::Vector3f& eye_m, std::span<const Eigen::Vector3f> points_m,
            std::span<std::uint8_t> is_seen) const;

  /// Called for a triangle; returns how far from the point to search on.
  using LookAt = std::function<float(const Triangle&)>;
  /// Looks at all triangles that come within `radius_m` of a point, and perhaps at others; nothing
  /// beyond is_within_reach(). Cost: that of the triangles near by, if what `look` returns shrinks.
  void search_near(const Eigen::Vector3f& point_m, float radius_m, const LookAt& look) const;

 private:
  struct Embree;
  explicit RayCaster(std::unique_ptr<Embree> embree);
  std::unique_ptr<Embree> embree_;
};

}  // namespace swiftlet::sim
