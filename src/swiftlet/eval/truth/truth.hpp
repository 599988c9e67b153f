// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "swiftlet/eval/truth/dense_grid.hpp"
#include "swiftlet/eval/truth/object_voxels.hpp"
#include "swiftlet/eval/truth/sight.hpp"
#include "swiftlet/sim/scene.hpp"

namespace swiftlet::eval {

/// What is true of one voxel.
struct VoxelTruth {
  Holds holds = Holds::kNothing;
  bool is_swept = false;           ///< something that moves is there at some time
  std::uint16_t object = 0xffffU;  ///< what it holds: index into the scene's objects
  std::uint16_t through = 0;       ///< lines of sight that passed it on their way to a surface
  std::uint16_t hits = 0;          ///< lines of sight that ended on a surface in it
};

/// The truth about a box of space: where matter is, and what of it a camera without faults saw from
/// the poses that were flown.
class Truth {
 public:
  /// A voxel counts as seen after so many lines of sight.
  static constexpr std::uint16_t kEnoughLines = 4;

  /// The static objects of a scene. What is thinner than a voxel and lies on something thicker, as
  /// a rug on a floor, adds a sliver to the voxels before it. REQUIRES: at most 65535 objects.
  Truth(std::vector<sim::Object> objects, double voxel_m, const VoxelBox& box);

  /// Books a line of sight. It ends a quarter of a voxel behind the surface, so that one on the
  /// boundary of two voxels is seen in the solid one.
  void add(const SightLine& line);
  /// Marks a voxel as one where something moves at some time: static scores leave it out.
  void mark_swept(const VoxelIndex& voxel);

  [[nodiscard]] double voxel_m() const { return voxel_m_; }
  [[nodiscard]] const DenseGrid<VoxelTruth>& voxels() const { return voxels_; }
  [[nodiscard]] const std::vector<sim::Object>& objects() const { return objects_; }
  /// The name of what a voxel holds.
  [[nodiscard]] std::string name_at(const VoxelIndex& v) const;

  /// Any matter at all; nothing outside the box.
  [[nodiscard]] bool holds_matter(const VoxelIndex& v) const {
    return voxels_.contains(v) && voxels_.at(v).holds != Holds::kNothing;
  }
  /// A solid voxel whose surface was seen: a map should call it occupied.
  [[nodiscard]] static bool is_seen_surface(const VoxelTruth& c) {
    return c.holds == Holds::kSolid && c.hits >= kEnoughLines && !c.is_swept;
  }
  /// A voxel without any matter that was looked through: a map should call it free.
  [[nodiscard]] static bool is_seen_empty(const VoxelTruth& c) {
    return c.holds == Holds::kNothing && c.through >= kEnoughLines && !c.is_swept;
  }
  /// Neither the voxel nor one of its 26 neighbours was ever seen: a map should call it unknown.
  [[nodiscard]] bool is_never_seen(const VoxelIndex& v) const;

  /// A selection of all lines of sight, to be cast through maps.
  [[nodiscard]] const std::vector<SightLine>& sight_lines() const { return kept_; }

 private:
  [[nodiscard]] bool lies_on_another(const VoxelIndex& v, std::uint16_t object) const;

  double voxel_m_;
  std::vector<sim::Object> objects_;
  DenseGrid<VoxelTruth> voxels_;
  std::vector<SightLine> kept_;
  std::size_t lines_ = 0;
};

}  // namespace swiftlet::eval
