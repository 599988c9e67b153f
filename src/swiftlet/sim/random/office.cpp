// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "swiftlet/sim/random/office_furniture.hpp"
#include "swiftlet/sim/random/scene_draft.hpp"

namespace swiftlet::sim {
namespace {

using Eigen::Vector3d;

/// Rooms on both sides of a corridor along x. The vehicle goes from the first room on one side to
/// the last one on the other.
class Office {
 public:
  explicit Office(SceneDraft& draft)
      : draft_(draft),
        dice_(draft.dice),
        carpet_(draft.material("carpet", 0.85)),
        plaster_(draft.material("plaster", 0.55)),
        door_(draft.material("door", 0.7)),
        furniture_(draft),
        length_m_(draft.size_m(24.0)),
        half_m_(0.3 * length_m_),
        side_(dice_.chance(0.5) ? 1.0 : -1.0) {
    draft.task.bounds_m = {Vector3d(0, -half_m_, 0), Vector3d(length_m_, half_m_, kHeight_m)};
  }

  void draw() {
    draft_.shell(carpet_, plaster_, draft_.task.bounds_m.min(), draft_.task.bounds_m.max());
    const std::vector<double> near = partitions(), far = partitions();
    const double y = side_ * 0.5 * (half_m_ + kCorridor_m);
    draft_.task.start_m = {0.5 * near[1], y, 1.2};
    draft_.task.goal_m = {0.5 * (far.end()[-2] + length_m_), -y, 1.2};
    draft_.task.start_yaw_rad = -side_ * 0.5 * std::numbers::pi;  // to the corridor
    build_side(near, side_);
    build_side(far, -side_);
    for (double x = 2.0; x < length_m_; x += dice_.real(2.5, 5.0))
      furniture_.hang_lamp({x, 0, kHeight_m});
    for (int i = dice_.about(0.12 * length_m_ * draft_.density()); i > 0; --i) {
      const double at = dice_.chance(0.5) ? 1.0 : -1.0;
      furniture_.put_cabinet({dice_.real(1.0, length_m_ - 1.0), at * (kCorridor_m - 0.25), 0.0},
                             0.0);
    }
  }

 private:
  static constexpr double kHeight_m = 2.7, kCorridor_m = 1.2;  // the corridor's half width
  static constexpr double kWall_m = 0.1, kDoorHeight_m = 2.1;

  /// Where the walls between the rooms of one side are, both ends included.
  std::vector<double> partitions() {
    std::vector<double> xs{0.0};
    while (length_m_ - xs.back() > 9.0) xs.push_back(xs.back() + dice_.real(3.2, 5.5));
    xs.push_back(length_m_);
    return xs;
  }

  void build_side(const std::vector<double>& xs, double side) {
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
      build_front(xs[i], xs[i + 1], side);
      if (i > 0) build_between(xs[i], side);
      furnish(xs[i], xs[i + 1], side);
    }
  }

  /// The wall to the corridor, with a door that stands open.
  void build_front(double from_x, double to_x, double side) {
    const double width_m = dice_.real(1.25, 1.7);
    const double left = dice_.real(from_x + 0.3, to_x - width_m - 0.3);
    const double y = side * kCorridor_m;
    wall({from_x, y, 0}, {left, y, kHeight_m});
    wall({left + width_m, y, 0}, {to_x, y, kHeight_m});
    wall({left, y, kDoorHeight_m}, {left + width_m, y, kHeight_m});
    if (!dice_.chance(0.6)) return;
    const double open = side * dice_.real(1.4, 2.2);  // into the room
    const Vector3d hinge(left, y + side * 0.1, 0.0);
    const Eigen::Quaterniond R = rotation_from_ypr(open, 0.0, 0.0);
    draft_.add("door", door_, Box{hinge + R * Vector3d(0.45, 0.0, 1.03), {0.9, 0.04, 2.06}, R});
  }

  /// The wall between two rooms; sometimes one goes through.
  void build_between(double x, double side) {
    const double inner = side * kCorridor_m, outer = side * half_m_;
    if (!dice_.chance(0.35)) return wall({x, inner, 0}, {x, outer, kHeight_m});
    const double width_m = dice_.real(0.8, 1.4);
    const double gap = inner + side * dice_.real(0.4, std::abs(outer - inner) - width_m - 0.4);
    wall({x, inner, 0}, {x, gap, kHeight_m});
    wall({x, gap + side * width_m, 0}, {x, outer, kHeight_m});
    wall({x, gap, kDoorHeight_m}, {x, gap + side * width_m, kHeight_m});
  }

  /// Between two points of its middle plane.
  void wall(const Vector3d& a, const Vector3d& b) {
    const Vector3d half_thick = Vector3d(0.5 * kWall_m, 0.5 * kWall_m, 0.0);
    draft_.box("wall", plaster_, a.cwiseMin(b) - half_thick, a.cwiseMax(b) + half_thick);
  }

  void furnish(double from_x, double to_x, double side) {
    const double inner = side * (kCorridor_m + 0.6), outer = side * (half_m_ - 0.5);
    const Vector3d low(from_x + 0.6, std::min(inner, outer), 0.0);
    const Vector3d high(to_x - 0.6, std::max(inner, outer), 0.0);
    const double area_m2 = (to_x - from_x) * (half_m_ - kCorridor_m);
    for (int i = dice_.about(0.28 * area_m2 * draft_.density()); i > 0; --i)
      furniture_.put_any(dice_.point(low, high));
    furniture_.hang_lamp(0.5 * (low + high) + kHeight_m * Vector3d::UnitZ());
  }

  SceneDraft& draft_;
  Dice& dice_;
  std::uint16_t carpet_, plaster_, door_;
  OfficeFurniture furniture_;
  double length_m_, half_m_;  // inside: along x, and to either side
  double side_;               // of the start: +1 left of the corridor, -1 right
};

}  // namespace

void draw_office(SceneDraft& draft) { Office(draft).draw(); }

}  // namespace swiftlet::sim
