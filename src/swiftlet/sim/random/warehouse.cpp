// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>

#include "swiftlet/sim/random/scene_draft.hpp"

namespace swiftlet::sim {
namespace {

using Eigen::Vector3d;

class Warehouse {
 public:
  explicit Warehouse(SceneDraft& draft)
      : draft_(draft),
        dice_(draft.dice),
        concrete_(draft.material("concrete", 0.75)),
        wall_(draft.material("wall", 0.6)),
        steel_(draft.material("steel", 0.65)),
        wood_(draft.material("wood", 0.85)),
        carton_(draft.material("carton", 0.9)),
        cable_(draft.material("cable", 0.6)),
        length_m_(draft.size_m(30.0)),
        half_m_(0.3 * length_m_) {
    const double room_m = half_m_ - 2.0;
    draft.task.start_m = {1.5, dice_.real(-room_m, room_m), 1.2};
    draft.task.goal_m = {length_m_ - 1.5, dice_.real(-room_m, room_m), 1.2};
    draft.task.start_yaw_rad = 0.0;
    draft.task.bounds_m = {Vector3d(0, -half_m_, 0), Vector3d(length_m_, half_m_, kHeight_m)};
  }

  void draw() {
    draft_.shell(concrete_, wall_, draft_.task.bounds_m.min(), draft_.task.bounds_m.max());
    double x = 3.5;
    while (x + kDepth_m < length_m_ - 3.0) {
      stand_row(x);
      x += kDepth_m + dice_.real(2.0, 3.2);
    }
    const double area_m2 = 2.0 * length_m_ * half_m_ * draft_.density();
    for (int i = dice_.about(0.02 * area_m2); i > 0; --i) leave_pallet();
    for (int i = dice_.about(0.03 * area_m2); i > 0; --i) hang_lamp();
    for (int i = dice_.about(0.012 * area_m2); i > 0; --i) string_cable();
    for (int i = dice_.about(0.004 * area_m2); i > 0; --i) lean_ladder();
  }

 private:
  static constexpr double kHeight_m = 5.0, kDepth_m = 1.0, kBay_m = 2.4, kPost_m = 0.09;

  /// Shelves from wall to wall, but for one or two bays to go through.
  void stand_row(double x) {
    const int bays = static_cast<int>(2.0 * half_m_ / kBay_m);
    const double first_y = -0.5 * bays * kBay_m;
    const int gap = dice_.integer(0, bays - 1);
    const int other_gap = dice_.chance(0.5) ? dice_.integer(0, bays - 1) : gap;
    for (int bay = 0; bay < bays; ++bay) {
      if (bay == gap || bay == other_gap) continue;
      fill_bay({x, first_y + bay * kBay_m, 0.0});
    }
  }

  void fill_bay(const Vector3d& corner) {
    for (const double y : {0.0, kBay_m - kPost_m}) {
      for (const double x : {0.0, kDepth_m - kPost_m}) {
        const Vector3d foot = corner + Vector3d(x, y, 0.0);
        draft_.box("post", steel_, foot, foot + Vector3d(kPost_m, kPost_m, 4.2));
      }
    }
    if (dice_.chance(0.3))
      draft_.rod("brace", steel_, corner, corner + Vector3d(0.0, kBay_m, 1.5), draft_.thin_m(0.03));
    for (const double height_m : {0.15, 1.75, 3.3}) {
      const Vector3d deck = corner + Vector3d(0.0, 0.0, height_m);
      draft_.box("deck", steel_, deck, deck + Vector3d(kDepth_m, kBay_m, 0.05));
      if (dice_.chance(0.3 + 0.5 * std::min(draft_.density(), 1.0)))
        stack(deck + 0.05 * Vector3d::UnitZ());
    }
  }

  /// Cartons side by side, some of them gone.
  void stack(const Vector3d& deck) {
    double y = kPost_m + 0.02;
    while (y < kBay_m - 0.6) {
      const Vector3d size = dice_.point({0.6, 0.35, 0.3}, {0.95, 0.9, 1.35});
      const double room_m = kBay_m - kPost_m - 0.02 - y;
      const double width_m = std::min(size.y(), room_m);
      if (dice_.chance(0.8)) {
        const Vector3d foot = deck + Vector3d(0.5 * (kDepth_m - size.x()), y, 0.0);
        draft_.box("carton", carton_, foot, foot + Vector3d(size.x(), width_m, size.z()));
      }
      y += width_m + dice_.real(0.02, 0.15);
    }
  }

  Vector3d somewhere(double height_m) {
    return dice_.point({2.0, 0.8 - half_m_, height_m}, {length_m_ - 2.0, half_m_ - 0.8, height_m});
  }

  void leave_pallet() {
    const Vector3d foot = somewhere(0.0);
    const double yaw = dice_.angle(), height_m = dice_.real(0.2, 1.6);
    if (draft_.is_kept_free(foot, 0.8)) return;
    draft_.standing("pallet", wood_, foot, {1.2, 0.8, 0.144}, yaw);
    draft_.standing("goods", carton_, foot + 0.144 * Vector3d::UnitZ(), {1.0, 0.7, height_m}, yaw);
  }

  void hang_lamp() {
    const Vector3d lamp = somewhere(dice_.real(2.0, 4.3));
    if (draft_.is_kept_free(lamp, 0.4)) return;
    draft_.rod("cable", cable_, lamp, {lamp.x(), lamp.y(), kHeight_m}, draft_.thinnest_m());
    draft_.rod("lamp", steel_, lamp - 0.15 * Vector3d::UnitZ(), lamp, dice_.real(0.2, 0.45));
  }

  /// Across an aisle, from shelf to shelf.
  void string_cable() {
    const Vector3d from = somewhere(dice_.real(1.0, 3.5));
    const double length_m = dice_.real(2.0, 4.0);
    const Vector3d to = from + length_m * dice_.direction(-0.1, 0.1);
    if (draft_.is_kept_free(from, length_m)) return;
    draft_.rope("cable", cable_, from, to, 0.1, draft_.thin_m(0.02));
  }

  void lean_ladder() {
    const Vector3d foot = somewhere(0.0);
    const double yaw = dice_.angle();
    if (draft_.is_kept_free(foot, 1.5)) return;
    const Eigen::Quaterniond R = rotation_from_ypr(yaw, -1.2, 0.0);
    const auto at = [&](double along, double across) -> Vector3d {
      return foot + R * Vector3d(along, across, 0.0);
    };
    for (const double side : {-0.2, 0.2})
      draft_.rod("ladder", steel_, at(0.0, side), at(3.0, side), 0.05);
    for (double rung = 0.3; rung < 3.0; rung += 0.3)
      draft_.rod("rung", steel_, at(rung, -0.2), at(rung, 0.2), 0.03);
  }

  SceneDraft& draft_;
  Dice& dice_;
  std::uint16_t concrete_, wall_, steel_, wood_, carton_, cable_;
  double length_m_, half_m_;  // inside: along x, and to either side
};

}  // namespace

void draw_warehouse(SceneDraft& draft) { Warehouse(draft).draw(); }

}  // namespace swiftlet::sim
