// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/truth/object_voxels.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace swiftlet::eval {
namespace {

/// Against rounding, of coordinates in metres.
constexpr double kRounding_m = 1e-9;
/// Edges that a centre must lie within matter, for its voxel to be solid: nearer to the surface
/// half of the voxel is empty, and poses are known no better.
constexpr double kDeep = 0.05;

using Corners = std::array<Eigen::Vector3d, 2>;  // least and greatest coordinates [m, world]

template <class Visit>
void for_each_voxel_between(const Corners& corners, double voxel_m, const VoxelBox& box,
                            Visit&& visit) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(voxel_m);
  // Planes reach far beyond any box: limit before the numbers become indices.
  const Eigen::Vector3d least = centre_of(box.first, voxel_m).cwiseMax(corners[0] - margin);
  const Eigen::Vector3d most = centre_of(box.last, voxel_m).cwiseMin(corners[1] + margin);
  const VoxelIndex first = voxel_containing(least, voxel_m);
  const VoxelIndex last = voxel_containing(most, voxel_m);
  for (std::int32_t z = first.z; z <= last.z; ++z) {
    for (std::int32_t y = first.y; y <= last.y; ++y) {
      for (std::int32_t x = first.x; x <= last.x; ++x) visit(VoxelIndex{x, y, z});
    }
  }
}

/// Half the thickness of a sheet of voxels without holes across a direction [m] (a "naive" plane).
double half_sheet_m(const Eigen::Vector3d& unit, double voxel_m) {
  return 0.5 * voxel_m * unit.cwiseAbs().maxCoeff();
}

class BoxVoxels {
 public:
  BoxVoxels(const sim::Box& b, double voxel_m)
      : centre_m_(b.centre_m),
        axes_(b.R_world_box.toRotationMatrix()),
        half_m_(0.5 * b.size_m),
        grown_m_(half_m_.array() - kDeep * voxel_m),
        half_voxel_m_(0.5 * voxel_m) {
    for (int i = 0; i < 3; ++i) {
      if (b.size_m[i] < voxel_m)
        grown_m_[i] = std::max(half_m_[i], half_sheet_m(axes_.col(i), voxel_m));
    }
  }

  [[nodiscard]] Corners corners() const {
    const Eigen::Vector3d reach = axes_.cwiseAbs() * grown_m_.cwiseMax(half_m_);
    return {centre_m_ - reach, centre_m_ + reach};
  }
  [[nodiscard]] Holds at(const Eigen::Vector3d& centre) const {
    const Eigen::Vector3d p = axes_.transpose() * (centre - centre_m_);
    // Half open: of two voxels that share a thin board evenly, one is solid.
    const bool is_solid = (p.array() <= grown_m_.array() - kRounding_m).all() &&
                          (p.array() >= -grown_m_.array() - kRounding_m).all();
    if (is_solid) return Holds::kSolid;
    return overlaps(centre - centre_m_) ? Holds::kSliver : Holds::kNothing;
  }

 private:
  /// Separating axes of two boxes (Gottschalk et al. 1996); those that only touch do not overlap.
  [[nodiscard]] bool overlaps(const Eigen::Vector3d& offset) const {
    const auto is_separated_along = [&](const Eigen::Vector3d& axis) {
      const double length = axis.norm();
      if (length < 1e-6) return false;  // parallel edges
      const double reach = (axes_.transpose() * axis).cwiseAbs().dot(half_m_) +
                           half_voxel_m_ * axis.cwiseAbs().sum();
      return std::abs(axis.dot(offset)) >= reach - kRounding_m * length;
    };
    for (int i = 0; i < 3; ++i) {
      if (is_separated_along(axes_.col(i)) || is_separated_along(Eigen::Vector3d::Unit(i)))
        return false;
      for (int j = 0; j < 3; ++j) {
        if (is_separated_along(axes_.col(i).cross(Eigen::Vector3d::Unit(j)))) return false;
      }
    }
    return true;
  }

  Eigen::Vector3d centre_m_;
  Eigen::Matrix3d axes_;
  Eigen::Vector3d half_m_;
  Eigen::Vector3d grown_m_;  // thin axes are one voxel wide
  double half_voxel_m_;
};

class CylinderVoxels {
 public:
  CylinderVoxels(const sim::Cylinder& c, double voxel_m)
      : from_m_(c.from_m),
        to_m_(c.to_m),
        radius_m_(0.5 * c.diameter_m),
        voxel_m_(voxel_m),
        is_thin_(c.diameter_m < voxel_m) {}

  [[nodiscard]] Corners corners() const {
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius_m_);
    return {from_m_.cwiseMin(to_m_) - reach, from_m_.cwiseMax(to_m_) + reach};
  }
  [[nodiscard]] Holds at(const Eigen::Vector3d& centre) const {
    if (is_thin_ ? is_on_axis(centre) : is_inside(centre)) return Holds::kSolid;
    return distance_of_axis(centre) < radius_m_ - kRounding_m ? Holds::kSliver : Holds::kNothing;
  }

 private:
  [[nodiscard]] bool is_inside(const Eigen::Vector3d& centre) const {
    const Eigen::Vector3d axis = to_m_ - from_m_;
    const double length = axis.norm();
    const double along = axis.dot(centre - from_m_) / length;
    const double deep_m = kDeep * voxel_m_;
    const double half_grown = length < voxel_m_ ? 0.5 * voxel_m_ : 0.5 * length - deep_m;
    const double across = (centre - from_m_ - along / length * axis).norm();
    return std::abs(along - 0.5 * length) <= half_grown + kRounding_m &&
           across <= radius_m_ - deep_m;
  }
  [[nodiscard]] bool is_on_axis(const Eigen::Vector3d& centre) const {
    const auto voxel = voxel_containing(centre, voxel_m_);
    const Clip clip = clip_to_box({from_m_ / voxel_m_, to_m_ / voxel_m_}, {voxel, voxel});
    if (clip.is_empty()) return false;
    const double length_voxels = (to_m_ - from_m_).norm() / voxel_m_;
    return (clip.end - clip.begin) * length_voxels >= std::min(0.5, 0.5 * length_voxels);
  }
  /// Distance [m] from the axis to the voxel around a centre: a convex function along the axis.
  [[nodiscard]] double distance_of_axis(const Eigen::Vector3d& centre) const {
    const auto distance_at = [&](double t) {
      const Eigen::Vector3d p = from_m_ + t * (to_m_ - from_m_);
      return ((p - centre).cwiseAbs().array() - 0.5 * voxel_m_).cwiseMax(0.0).matrix().norm();
    };
    constexpr int kThirds = 40;
    double low = 0.0, high = 1.0;
    for (int i = 0; i < kThirds; ++i) {
      const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
      if (distance_at(a) <= distance_at(b)) {
        high = b;
      } else {
        low = a;
      }
    }
    return distance_at(0.5 * (low + high));
  }

  Eigen::Vector3d from_m_, to_m_;
  double radius_m_;
  double voxel_m_;
  bool is_thin_;
};

class PlaneVoxels {
 public:
  PlaneVoxels(const sim::Plane& p, double voxel_m)
      : centre_m_(p.centre_m),
        normal_(p.normal.normalized()),
        half_side_m_(0.5 * p.side_m),
        half_sheet_m_(half_sheet_m(normal_, voxel_m)),
        half_touch_m_(0.5 * voxel_m * normal_.cwiseAbs().sum()) {
    side_ = normal_.unitOrthogonal();
  }

  [[nodiscard]] Corners corners() const {
    const Eigen::Vector3d reach =
        half_side_m_ * (side_.cwiseAbs() + normal_.cross(side_).cwiseAbs());
    return {centre_m_ - reach, centre_m_ + reach};
  }
  [[nodiscard]] Holds at(const Eigen::Vector3d& centre) const {
    const Eigen::Vector3d p = centre - centre_m_;
    const double in_plane = (p - normal_.dot(p) * normal_).cwiseAbs().maxCoeff();
    if (in_plane > half_side_m_) return Holds::kNothing;
    const double height = normal_.dot(p);
    if (height >= -half_sheet_m_ - kRounding_m && height < half_sheet_m_ - kRounding_m)
      return Holds::kSolid;
    return std::abs(height) < half_touch_m_ - kRounding_m ? Holds::kSliver : Holds::kNothing;
  }

 private:
  Eigen::Vector3d centre_m_, normal_, side_;
  double half_side_m_;
  double half_sheet_m_;
  double half_touch_m_;
};

template <class Voxels>
void visit_voxels(const Voxels& voxels, double voxel_m, const VoxelBox& box,
                  const std::function<void(const VoxelIndex&, Holds)>& visit) {
  for_each_voxel_between(voxels.corners(), voxel_m, box, [&](const VoxelIndex& voxel) {
    const Holds holds = voxels.at(centre_of(voxel, voxel_m));
    if (holds != Holds::kNothing) visit(voxel, holds);
  });
}

/// The voxels that hold points of the triangles, a quarter of a voxel apart.
void visit_mesh(const sim::TriangleMesh& mesh, double voxel_m, const VoxelBox& box,
                const std::function<void(const VoxelIndex&, Holds)>& visit) {
  std::set<VoxelIndex> seen;
  for (const auto& corners : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices_m[corners[0]].cast<double>();
    const Eigen::Vector3d ab = mesh.vertices_m[corners[1]].cast<double>() - a;
    const Eigen::Vector3d ac = mesh.vertices_m[corners[2]].cast<double>() - a;
    const int steps =
        1 + static_cast<int>(4.0 * std::max({ab.norm(), ac.norm(), (ab - ac).norm()}) / voxel_m);
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j)
        seen.insert(voxel_containing(a + (i * ab + j * ac) / steps, voxel_m));
    }
  }
  for (const VoxelIndex& voxel : seen) {
    if (box.contains(voxel)) visit(voxel, Holds::kSolid);
  }
}

}  // namespace

void for_each_held_voxel(const sim::Object& object, double voxel_m, const VoxelBox& box,
                         const std::function<void(const VoxelIndex&, Holds)>& visit) {
  if (const auto* b = std::get_if<sim::Box>(&object.shape)) {
    visit_voxels(BoxVoxels(*b, voxel_m), voxel_m, box, visit);
  } else if (const auto* c = std::get_if<sim::Cylinder>(&object.shape)) {
    visit_voxels(CylinderVoxels(*c, voxel_m), voxel_m, box, visit);
  } else if (const auto* p = std::get_if<sim::Plane>(&object.shape)) {
    visit_voxels(PlaneVoxels(*p, voxel_m), voxel_m, box, visit);
  } else {
    visit_mesh(std::get<sim::TriangleMesh>(object.shape), voxel_m, box, visit);
  }
}

bool is_thin_along(const sim::Object& object, int axis, double voxel_m) {
  const auto is_along = [axis](const Eigen::Vector3d& direction) {
    Eigen::Index nearest = 0;
    direction.cwiseAbs().maxCoeff(&nearest);
    return nearest == axis;
  };
  if (const auto* b = std::get_if<sim::Box>(&object.shape)) {
    const Eigen::Matrix3d R = b->R_world_box.toRotationMatrix();
    for (int i = 0; i < 3; ++i) {
      if (b->size_m[i] < voxel_m && is_along(R.col(i))) return true;
    }
    return false;
  }
  if (const auto* c = std::get_if<sim::Cylinder>(&object.shape)) {
    const Eigen::Vector3d length = c->to_m - c->from_m;
    return is_along(length) ? length.norm() < voxel_m : c->diameter_m < voxel_m;
  }
  return false;  // sheets are the surface of something
}

double thickness_of(const sim::Object& object) {
  if (const auto* b = std::get_if<sim::Box>(&object.shape)) return b->size_m.minCoeff();
  if (const auto* c = std::get_if<sim::Cylinder>(&object.shape))
    return std::min(c->diameter_m, (c->to_m - c->from_m).norm());
  return 0.0;
}

}  // namespace swiftlet::eval
