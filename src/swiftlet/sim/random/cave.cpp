// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <vector>

#include "swiftlet/sim/random/cave_rock.hpp"
#include "swiftlet/sim/random/scene_draft.hpp"

namespace swiftlet::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

class Cave {
 public:
  explicit Cave(SceneDraft& draft)
      : draft_(draft),
        dice_(draft.dice),
        stone_(draft.material("rock", 0.9)),
        timber_(draft.material("timber", 0.85)),
        cable_(draft.material("cable", 0.6)),
        length_m_(draft.size_m(32.0)),
        half_m_(0.3 * length_m_),
        rock_{dig(), static_cast<std::uint64_t>(dice_.integer(0, 1 << 30))} {
    draft.task.start_m = over(line_.front());
    draft.task.goal_m = over(line_.back());
    draft.task.start_yaw_rad = 0.0;
    draft.task.bounds_m = {Vector3d(-1, -half_m_ - 3, -0.5),
                           Vector3d(length_m_ + 1, half_m_ + 3, 5)};
  }

  void draw() {
    draft_.add("cave", stone_, rock_.mesh());
    const double way_m = 1.3 * length_m_ * draft_.density();
    for (int i = dice_.about(0.7 * way_m); i > 0; --i) drop_boulder();
    for (int i = dice_.about(0.25 * way_m); i > 0; --i) pour_rubble();
    for (int i = dice_.about(1.0 * way_m); i > 0; --i) grow_dripstone();
    for (int i = dice_.about(0.12 * way_m); i > 0; --i) set_props();
    for (int i = dice_.about(0.12 * way_m); i > 0; --i) lean_slab();
    for (int i = dice_.about(0.15 * way_m); i > 0; --i) hang_cable();
  }

 private:
  /// A line that winds from one end to the other, and chambers beside it.
  std::vector<CaveRock::Passage> dig() {
    Vector2d here(2.0, dice_.real(-0.5, 0.5) * half_m_);
    std::vector<CaveRock::Passage> passages;
    line_.push_back(here);
    while (here.x() < length_m_ - 2.0) {
      Vector2d next = here + Vector2d(dice_.real(1.5, 4.0), 0.0);
      next.y() = std::clamp(here.y() + dice_.real(-3.5, 3.5), -half_m_, half_m_);
      passages.push_back({here, next, dice_.real(1.5, 2.6), dice_.real(1.5, 2.6)});
      if (dice_.chance(0.3))
        passages.push_back({next, next, dice_.real(2.2, 3.6), dice_.real(1.8, 3.2)});
      line_.push_back(here = next);
    }
    return passages;
  }

  [[nodiscard]] Vector3d over(const Vector2d& p) const {
    const CaveRock::Gap gap = rock_.gap(p);
    return {p.x(), p.y(), 0.5 * (gap.floor_m + gap.ceiling_m)};
  }
  /// Near the line.
  Vector2d somewhere() {
    const auto last = static_cast<int>(line_.size()) - 2;
    const auto leg = static_cast<std::size_t>(dice_.integer(0, last));
    const Vector2d on_line = line_[leg] + dice_.real(0.0, 1.0) * (line_[leg + 1] - line_[leg]);
    return on_line + dice_.point({-2.0, -2.0, 0.0}, {2.0, 2.0, 0.0}).head<2>();
  }
  [[nodiscard]] Vector3d on_floor(const Vector2d& p) const {
    return {p.x(), p.y(), rock_.gap(p).floor_m};
  }
  [[nodiscard]] Vector3d on_ceiling(const Vector2d& p) const {
    return {p.x(), p.y(), rock_.gap(p).ceiling_m};
  }

  void boulder(const Vector3d& at_m, double size_m) {
    const Vector3d size = size_m * dice_.point({0.6, 0.6, 0.4}, {1.0, 1.0, 0.9});
    draft_.add("boulder", stone_, Box{at_m, size, dice_.attitude(0.6)});
  }
  void drop_boulder() {
    const Vector3d foot = on_floor(somewhere());
    const double size_m = dice_.real(0.3, 1.1);
    if (!draft_.is_kept_free(foot, size_m)) boulder(foot, size_m);
  }
  void pour_rubble() {
    const Vector2d middle = somewhere();
    if (draft_.is_kept_free(on_floor(middle), 0.8)) return;
    for (int i = dice_.integer(8, 16); i > 0; --i) {
      const Vector2d at = middle + dice_.point({-0.7, -0.7, 0.0}, {0.7, 0.7, 0.0}).head<2>();
      const double heap_m = 0.5 * std::max(0.0, 0.8 - (at - middle).norm());
      boulder(on_floor(at) + heap_m * Vector3d::UnitZ(), dice_.real(0.12, 0.4));
    }
  }

  /// From the ceiling or the floor, thinner towards its tip.
  void grow_dripstone() {
    const Vector2d at = somewhere();
    const bool hangs = dice_.chance(0.7);
    Vector3d root = hangs ? on_ceiling(at) : on_floor(at);
    if (draft_.is_kept_free(root, 0.3)) return;
    const Vector3d step = dice_.real(0.15, 0.4) * (hangs ? -1.0 : 1.0) * Vector3d::UnitZ();
    double diameter_m = dice_.real(0.08, 0.3);
    root -= 0.5 * step;
    for (int i = 0; i < 4 && diameter_m > draft_.thinnest_m(); ++i) {
      draft_.rod("dripstone", stone_, root, root + step, diameter_m);
      root += step;
      diameter_m *= dice_.real(0.45, 0.7);
    }
  }

  /// Two posts and a beam across the passage.
  void set_props() {
    const auto last = static_cast<int>(line_.size()) - 2;
    const auto leg = static_cast<std::size_t>(dice_.integer(0, last));
    const Vector2d along = (line_[leg + 1] - line_[leg]).normalized();
    const Vector2d middle = line_[leg] + dice_.real(0.2, 0.8) * (line_[leg + 1] - line_[leg]);
    const Vector2d aside = dice_.real(0.85, 1.2) * Vector2d(-along.y(), along.x());
    if (draft_.is_kept_free(on_floor(middle), 1.2)) return;
    const double height_m = dice_.real(1.7, 2.3);
    for (const double side : {-1.0, 1.0}) {
      const Vector3d foot = on_floor(middle + side * aside);
      draft_.rod("prop", timber_, foot, {foot.x(), foot.y(), height_m}, 0.14);
    }
    const Vector2d left = middle + 1.15 * aside, right = middle - 1.15 * aside;
    draft_.rod("beam", timber_, {left.x(), left.y(), height_m}, {right.x(), right.y(), height_m},
               0.16);
  }

  void lean_slab() {
    const Vector3d foot = on_floor(somewhere());
    const Vector3d size = dice_.point({0.6, 0.8, 0.03}, {1.4, 1.8, 0.12});
    if (draft_.is_kept_free(foot, 1.0)) return;
    const double yaw = dice_.angle();
    draft_.add("slab", stone_,
               Box{foot + 0.3 * Vector3d::UnitZ(), size,
                   rotation_from_ypr(yaw, dice_.real(0.3, 1.2), 0.0)});
  }

  void hang_cable() {
    const Vector2d from = somewhere(), to = somewhere();
    const double span_m = (from - to).norm();
    if (span_m > 6.0 || draft_.is_kept_free(on_floor(0.5 * (from + to)), 0.5 * span_m)) return;
    draft_.rope("cable", cable_, on_ceiling(from), on_ceiling(to), 0.15 * span_m,
                draft_.thin_m(0.025));
  }

  SceneDraft& draft_;
  Dice& dice_;
  std::uint16_t stone_, timber_, cable_;
  double length_m_, half_m_;    // of the level: along x, and to either side
  std::vector<Vector2d> line_;  // from start to goal
  CaveRock rock_;
};

}  // namespace

void draw_cave(SceneDraft& draft) { Cave(draft).draw(); }

}  // namespace swiftlet::sim
