// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/truth.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/base/narrow.hpp"

namespace swiftlet::eval {
namespace {

/// Of all lines of sight, every so manieth is kept; a prime, so that it is another column each row.
constexpr std::size_t kKeepEvery = 97;

void count_up(std::uint16_t& counter) {
  if (counter < std::numeric_limits<std::uint16_t>::max()) ++counter;
}

}  // namespace

Truth::Truth(std::vector<sim::Object> objects, double voxel_m, const VoxelBox& box)
    : voxel_m_(voxel_m), objects_(std::move(objects)), cells_(box, CellTruth{}) {
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const auto number = to<std::uint16_t>(i);
    for_each_held_cell(objects_[i], voxel_m, box, [&](const VoxelIndex& v, Holds holds) {
      CellTruth& cell = cells_.at(v);
      // The thinnest solid thing names the cell: a chair leg counts, not the floor it stands on.
      const bool is_thinner =
          cell.holds == holds && thickness_of(objects_[i]) < thickness_of(objects_[cell.object]);
      if (holds <= cell.holds && !is_thinner) return;
      cell.holds = holds;
      cell.object = number;
    });
  }
}

void Truth::add(const SightLine& line) {
  const Eigen::Vector3d eye = line.eye_m.cast<double>() / voxel_m_;
  const Eigen::Vector3d point = line.point_m.cast<double>() / voxel_m_;
  const Eigen::Vector3d deeper = point + 0.25 * (point - eye).normalized();
  const GridRay ray{eye, deeper};
  const Clip clip = clip_to_box(ray, cells_.box());
  if (clip.is_empty()) return;
  if (lines_++ % kKeepEvery == 0) kept_.push_back(line);
  const VoxelIndex end = voxel_containing(deeper, 1.0);
  const VoxelIndex surface = voxel_containing(point, 1.0);
  GridWalk walk(ray, cells_.box(), clip);
  do {
    CellTruth& cell = cells_.at(walk.cell());
    if (walk.cell() == end) {
      count_up(cell.hits);
    } else if (walk.cell() != surface) {
      count_up(cell.through);
    }
  } while (walk.advance());
}

void Truth::mark_swept(const VoxelIndex& cell) {
  if (cells_.contains(cell)) cells_.at(cell).is_swept = true;
}

std::string Truth::name_at(const VoxelIndex& v) const {
  if (!holds_matter(v)) return "nothing";
  const sim::Object& object = objects_[cells_.at(v).object];
  const std::string name = object.name.empty() ? "object without a name" : object.name;
  const auto* cylinder = std::get_if<sim::Cylinder>(&object.shape);
  if (cylinder == nullptr || cylinder->diameter_m >= voxel_m_) return name;
  return fmt::format("{} ({:.0f} mm thin)", name, 1e3 * cylinder->diameter_m);
}

bool Truth::is_never_seen(const VoxelIndex& v) const {
  return !any_within(v, 1, [this](const VoxelIndex& n) {
    if (!cells_.contains(n)) return false;
    const CellTruth& cell = cells_.at(n);
    return cell.through > 0 || cell.hits > 0 || cell.is_swept;
  });
}

}  // namespace swiftlet::eval
