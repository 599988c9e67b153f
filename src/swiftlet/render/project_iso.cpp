// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "swiftlet/query/known_voxels.hpp"
#include "swiftlet/render/floor_plan.hpp"

namespace swiftlet::render {
namespace {

constexpr int kSupersampling = 2;
constexpr double kBorder_px = 24.0;
constexpr Colour kFloor{236, 238, 241};

/// The face of a voxel that looks along +-1 of one axis.
struct Face {
  Eigen::Vector3i normal;
  double brightness;  // light from above and behind the left shoulder
};
/// Seen from behind, from the right and from above: these three faces look at the viewer.
const std::array<Face, 3> kFaces{Face{{0, 0, 1}, 1.0}, Face{{-1, 0, 0}, 0.80},
                                 Face{{0, -1, 0}, 0.60}};

/// Isometric projection: the world in voxels to pixels of the enlarged picture.
class IsoCamera {
 public:
  IsoCamera(const VoxelBox& box, double voxel_px) : voxel_px_(voxel_px) {
    Eigen::Vector2d low = Eigen::Vector2d::Constant(1e30);
    Eigen::Vector2d high = -low;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d p((corner & 1) ? box.last.x + 1 : box.first.x,
                              (corner & 2) ? box.last.y + 1 : box.first.y,
                              (corner & 4) ? box.last.z + 1 : box.first.z);
      low = low.cwiseMin(unshifted(p));
      high = high.cwiseMax(unshifted(p));
    }
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kBorder_px * kSupersampling);
    shift_ = margin - low;
    size_ = (high - low + 2.0 * margin).array().ceil().cast<int>() + kSupersampling;
  }

  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector3d& p_voxels) const {
    return unshifted(p_voxels) + shift_;
  }
  [[nodiscard]] const Eigen::Vector2i& size() const { return size_; }

 private:
  /// x runs to the upper right, y to the upper left, z up; 30 degrees each.
  [[nodiscard]] Eigen::Vector2d unshifted(const Eigen::Vector3d& p) const {
    static const double kCos30 = std::sqrt(3.0) / 2.0;
    return voxel_px_ * Eigen::Vector2d((p.x() - p.y()) * kCos30, -(p.x() + p.y()) * 0.5 - p.z());
  }

  double voxel_px_;
  Eigen::Vector2d shift_;
  Eigen::Vector2i size_;
};

VoxelIndex offset_by(const VoxelIndex& v, const Eigen::Vector3i& d) {
  return {v.x + d.x(), v.y + d.y(), v.z + d.z()};
}

/// One of the two axes that span a face.
Eigen::Vector3i axis_along(const Face& face) {
  return face.normal.z() != 0 ? Eigen::Vector3i::UnitX() : Eigen::Vector3i::UnitZ();
}

class IsoDrawing {
 public:
  IsoDrawing(const BlockMap& map, const VoxelBox& box, int voxel_px)
      : map_(map),
        box_(box),
        camera_(box, voxel_px * kSupersampling),
        picture_(camera_.size().x(), camera_.size().y(), kPaper) {}

  void draw_floor(std::int32_t x, std::int32_t y) {
    draw_face({x, y, box_.first.z - 1}, kFaces[0], kFloor);
  }

  void draw_voxel(const VoxelIndex& v) {
    const double span = std::max(1, box_.last.z - box_.first.z);
    const Colour colour = height_colour((v.z - box_.first.z) / span);
    for (const Face& face : kFaces) {
      if (is_drawn(offset_by(v, face.normal))) continue;
      draw_face(v, face, shaded(colour, face.brightness * openness(v, face)));
    }
  }

  [[nodiscard]] Picture finish() && { return reduced(picture_, kSupersampling); }

 private:
  [[nodiscard]] bool is_drawn(const VoxelIndex& v) const {
    return v.z <= box_.last.z && map_.occupancy(v) == Occupancy::kOccupied;
  }

  /// Ambient occlusion: matter around the voxel in front of a face takes light from it. 0.6 .. 1.
  [[nodiscard]] double openness(const VoxelIndex& v, const Face& face) const {
    const Eigen::Vector3i along = axis_along(face);
    const Eigen::Vector3i across = face.normal.cross(along);
    const VoxelIndex front = offset_by(v, face.normal);
    int walls = 0;
    for (const Eigen::Vector3i& side :
         {along, Eigen::Vector3i(-along), across, Eigen::Vector3i(-across)}) {
      walls += is_drawn(offset_by(front, side)) ? 1 : 0;
    }
    return 1.0 - 0.1 * walls;
  }

  void draw_face(const VoxelIndex& v, const Face& face, Colour colour) {
    const Eigen::Vector3d centre(v.x + 0.5, v.y + 0.5, v.z + 0.5);
    const Eigen::Vector3d middle = centre + 0.5 * face.normal.cast<double>();
    const Eigen::Vector3d u = 0.5 * axis_along(face).cast<double>();
    const Eigen::Vector3d w = face.normal.cast<double>().cross(u);
    const std::array corners{camera_(middle - u - w), camera_(middle + u - w),
                             camera_(middle + u + w), camera_(middle - u + w)};
    fill_polygon(picture_, corners, colour);
  }

  const BlockMap& map_;
  VoxelBox box_;
  IsoCamera camera_;
  Picture picture_;
};

}  // namespace

/// Painter's algorithm: voxels from the farthest to the nearest, which for cubes of one size is the
/// order of x + y - z, falling; only faces that no other voxel covers are drawn.
Picture draw_iso(const BlockMap& map, const VoxelBox& whole, const ProjectionOptions& options) {
  VoxelBox box = cut_box(whole, map.voxel_m(), options);
  std::vector<VoxelIndex> voxels;
  for_each_known_voxel(map, [&](const VoxelIndex& v, QuantizedLogOdds, Occupancy state) {
    if (state == Occupancy::kOccupied && v.z <= box.last.z) voxels.push_back(v);
  });
  std::ranges::sort(voxels, [](const VoxelIndex& a, const VoxelIndex& b) {
    const auto far = [](const VoxelIndex& v) { return std::int64_t{v.x} + v.y - v.z; };
    const std::int64_t far_a = far(a), far_b = far(b);
    return far_a != far_b ? far_a > far_b : a < b;  // the order of a hash map must not show
  });
  // The floor lies under the lowest matter, not under the lowest free voxel.
  box.first.z = lowest_matter(map, box).value_or(box.first.z);
  IsoDrawing drawing(map, box, options.voxel_px);
  const Columns columns(map, box);
  for_each_column(box, [&](std::int32_t x, std::int32_t y) {
    const Column column = columns.at(x, y);
    if (column.free + column.occupied > 0) drawing.draw_floor(x, y);
  });
  for (const VoxelIndex& voxel : voxels) drawing.draw_voxel(voxel);
  return std::move(drawing).finish();
}

}  // namespace swiftlet::render
