// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/truth/truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <utility>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/base/narrow.hpp"

namespace swiftlet::eval {
namespace {

/// Of all lines of sight, every so manieth is kept; a prime, so that it is another column each row.
constexpr std::size_t kKeepEvery = 97;

bool is_sheet(const sim::Object& object) {
  return std::holds_alternative<sim::Plane>(object.shape) ||
         std::holds_alternative<sim::TriangleMesh>(object.shape);
}

void count_up(std::uint16_t& counter) {
  if (counter < std::numeric_limits<std::uint16_t>::max()) ++counter;
}

}  // namespace

Truth::Truth(std::vector<sim::Object> objects, double voxel_m, const VoxelBox& box)
    : voxel_m_(voxel_m), objects_(std::move(objects)), voxels_(box, VoxelTruth{}) {
  std::vector<std::uint16_t> by_thickness(objects_.size());
  for (std::size_t i = 0; i < objects_.size(); ++i) by_thickness[i] = to<std::uint16_t>(i);
  // The thinnest solid thing names the voxel: a chair leg counts, not the floor it stands on.
  std::ranges::stable_sort(by_thickness, std::ranges::greater{}, [this](std::uint16_t i) {
    return is_sheet(objects_[i]) ? std::numeric_limits<double>::infinity()
                                 : thickness_of(objects_[i]);
  });
  for (const std::uint16_t i : by_thickness) {
    for_each_held_voxel(objects_[i], voxel_m, box, [&](const VoxelIndex& v, Holds holds) {
      VoxelTruth& voxel = voxels_.at(v);
      if (holds == Holds::kSolid && lies_on_another(v, i)) holds = Holds::kSliver;
      if (holds < voxel.holds) return;
      voxel.holds = holds;
      voxel.object = i;
    });
  }
}

bool Truth::lies_on_another(const VoxelIndex& v, std::uint16_t object) const {
  const auto is_thicker = [&](const VoxelIndex& n) {
    if (!voxels_.contains(n) || voxels_.at(n).holds != Holds::kSolid) return false;
    const sim::Object& other = objects_[voxels_.at(n).object];
    return is_sheet(other) || thickness_of(other) >= voxel_m_;
  };
  constexpr std::array<VoxelIndex, 3> kSteps{VoxelIndex{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_thin_along(objects_[object], axis, voxel_m_)) continue;
    const VoxelIndex& step = kSteps[static_cast<std::size_t>(axis)];
    if (is_thicker({v.x + step.x, v.y + step.y, v.z + step.z}) ||
        is_thicker({v.x - step.x, v.y - step.y, v.z - step.z}))
      return true;
  }
  return false;
}

void Truth::add(const SightLine& line) {
  const Eigen::Vector3d eye = line.eye_m.cast<double>() / voxel_m_;
  const Eigen::Vector3d point = line.point_m.cast<double>() / voxel_m_;
  const Eigen::Vector3d deeper = point + 0.25 * (point - eye).normalized();
  const GridRay ray{eye, deeper};
  const Clip clip = clip_to_box(ray, voxels_.box());
  if (clip.is_empty()) return;
  if (lines_++ % kKeepEvery == 0) kept_.push_back(line);
  const VoxelIndex end = voxel_containing(deeper, 1.0);
  const VoxelIndex surface = voxel_containing(point, 1.0);
  GridWalk walk(ray, voxels_.box(), clip);
  do {
    VoxelTruth& voxel = voxels_.at(walk.voxel());
    if (walk.voxel() == end) {
      count_up(voxel.hits);
    } else if (walk.voxel() != surface) {
      count_up(voxel.through);
    }
  } while (walk.advance());
}

void Truth::mark_swept(const VoxelIndex& voxel) {
  if (voxels_.contains(voxel)) voxels_.at(voxel).is_swept = true;
}

std::string Truth::name_at(const VoxelIndex& v) const {
  if (!holds_matter(v)) return "nothing";
  const sim::Object& object = objects_[voxels_.at(v).object];
  std::string name = object.name.empty() ? "object without a name" : object.name;
  const auto* cylinder = std::get_if<sim::Cylinder>(&object.shape);
  if (cylinder == nullptr || cylinder->diameter_m >= voxel_m_) return name;
  return fmt::format("{} ({:.0f} mm thin)", name, 1e3 * cylinder->diameter_m);
}

bool Truth::is_never_seen(const VoxelIndex& v) const {
  return !any_within(v, 1, [this](const VoxelIndex& n) {
    if (!voxels_.contains(n)) return false;
    const VoxelTruth& voxel = voxels_.at(n);
    return voxel.through > 0 || voxel.hits > 0 || voxel.is_swept;
  });
}

}  // namespace swiftlet::eval
