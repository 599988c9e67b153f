// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>

#include "swiftlet/query/sweep/clear_by_field_private.hpp"
#include "swiftlet/query/sweep/path_piece_private.hpp"
#include "swiftlet/query/sweep/sweep.hpp"
#include "swiftlet/query/sweep/voxel_scan_private.hpp"

namespace swiftlet {

/// What stops a body, as a distance field has it.
[[nodiscard]] inline Obstacles obstacles_of(const SweepPolicy& policy) {
  return policy.unknown == UnknownSpace::kStops ? Obstacles::kNotFree : Obstacles::kOccupied;
}

/// What both searches of a sweep, for contacts and for clearance, know. [voxels]
struct SweepScene {
  SweepScene(const MapSnapshot& snapshot, const BodyShape& shape, const SweepPolicy& how)
      : map(snapshot),
        body(shape),
        policy(how),
        window(voxel_box(snapshot.window())),
        voxels_per_m(1.0 / snapshot.voxel_m()),
        lever(shape.lever_m() * voxels_per_m),
        reach(shape.reach_m() * voxels_per_m),
        margin(how.margin_m * voxels_per_m) {}

  const MapSnapshot& map;
  const BodyShape& body;
  const SweepPolicy& policy;
  VoxelBox window;
  double voxels_per_m;
  double lever;
  double reach;
  double margin;

  [[nodiscard]] WantedVoxels stopping() const {
    return {policy.unknown == UnknownSpace::kStops, true};
  }
  /// The shares of a leg between which the body, larger by `extra`, may touch the window.
  [[nodiscard]] Clip near_window(const PathLeg& leg, double extra) const;
};

/// Finds the first contact of each kind along a path, leg by leg.
class ContactSearch {
 public:
  explicit ContactSearch(const SweepScene& scene);

  /// What comes next on the path; false once there is nothing left to look for.
  bool follow(const PathLeg& leg, std::size_t number, double length_so_far_m);

  [[nodiscard]] const std::optional<SweepContact>& unknown() const { return unknown_; }
  [[nodiscard]] const std::optional<SweepContact>& occupied() const { return occupied_; }

 private:
  struct Touch {
    VoxelIndex voxel;
    Occupancy state;
  };
  [[nodiscard]] std::optional<Touch> touch(const PathLeg& leg, double begin, double end) const;
  [[nodiscard]] std::optional<Touch> touch_of(const MovingPart& part) const;
  void search(const PathLeg& leg, double begin, double end);
  bool search_pieces(const PathLeg& leg, double begin, double end);
  void keep(const PathLeg& leg, double share, const Touch& touch);

  const SweepScene& scene_;
  WantedVoxels wanted_;  // what has not been met yet
  std::optional<ClearByField> by_field_;
  std::size_t number_ = 0;
  double length_so_far_m_ = 0.0;
  std::optional<SweepContact> unknown_;
  std::optional<SweepContact> occupied_;
};

/// Finds the voxel that comes nearest to the body along a path, leg by leg.
class ClearanceSearch {
 public:
  explicit ClearanceSearch(const SweepScene& scene)
      : scene_(scene), least_(scene.policy.clearance_reach_m * scene.voxels_per_m) {}

  void follow(const PathLeg& leg, double length_so_far_m);
  [[nodiscard]] SweepClearance answer() const;

 private:
  void search(const PathLeg& leg, double begin, double end, double length_so_far_m);
  void look_at_rim(const MovingPart& part, double path_m);

  const SweepScene& scene_;
  double least_;  // so far; what is not nearer is not looked at
  std::optional<VoxelIndex> voxel_;
  double path_m_ = 0.0;
};

}  // namespace swiftlet
