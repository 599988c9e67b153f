// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <cmath>

#include "swiftlet/sim/random/scene_draft.hpp"

namespace swiftlet::sim {
namespace {

using Eigen::Vector3d;

struct Tree {
  Vector3d foot_m, top_m;

  [[nodiscard]] Vector3d at(double height_m) const {
    return foot_m + (height_m - foot_m.z()) / (top_m.z() - foot_m.z()) * (top_m - foot_m);
  }
};

class Forest {
 public:
  explicit Forest(SceneDraft& draft)
      : draft_(draft),
        dice_(draft.dice),
        ground_(draft.material("ground", 0.95)),
        bark_(draft.material("bark", 0.95)),
        twig_(draft.material("twig", 0.8)),
        leaf_(draft.material("leaves", 0.95)),
        stone_(draft.material("stone", 0.85)),
        wire_(draft.material("wire", 0.6)),
        length_m_(draft.size_m(30.0)),
        half_m_(0.35 * length_m_) {
    const double room_m = half_m_ - 2.0;
    draft.task.start_m = {1.5, dice_.real(-room_m, room_m), 1.3};
    draft.task.goal_m = {length_m_ - 1.5, dice_.real(-room_m, room_m), 1.3};
    draft.task.start_yaw_rad = 0.0;
    draft.task.bounds_m = {Vector3d(0, -half_m_, 0.4), Vector3d(length_m_, half_m_, 3.0)};
  }

  void draw() {
    const double area_m2 = 2.0 * length_m_ * half_m_ * draft_.density();
    draft_.add("ground", ground_, Plane{Vector3d::Zero(), Vector3d::UnitZ(), 300.0});
    grow_edge();
    for (int i = dice_.about(0.075 * area_m2); i > 0; --i) plant_tree();
    for (int i = dice_.about(0.05 * area_m2); i > 0; --i) plant_bush();
    for (int i = dice_.about(0.02 * area_m2); i > 0; --i) drop_stone();
    for (int i = dice_.about(0.006 * area_m2); i > 0; --i) fell_tree();
    for (int i = dice_.about(0.02 * area_m2); i > 0; --i) hang_wire();
  }

 private:
  Vector3d somewhere() {
    return dice_.point({0.3, -half_m_, 0.0}, {length_m_ - 0.3, half_m_, 0.0});
  }

  /// A thicket all around: what a camera sees behind the trees.
  void grow_edge() {
    constexpr double kOut_m = 2.5, kSpacing_m = 1.2;
    for (double x = -kOut_m; x < length_m_ + kOut_m; x += kSpacing_m) {
      grow_thicket({x, -half_m_ - kOut_m, 0.0});
      grow_thicket({x, half_m_ + kOut_m, 0.0});
    }
    for (double y = -half_m_ - kOut_m; y < half_m_ + kOut_m; y += kSpacing_m) {
      grow_thicket({-kOut_m, y, 0.0});
      grow_thicket({length_m_ + kOut_m, y, 0.0});
    }
  }
  void grow_thicket(const Vector3d& near_m) {
    const Vector3d foot = dice_.point(near_m, near_m + Vector3d(0.5, 0.5, 0.0));
    const Vector3d size = dice_.point({1.3, 1.3, 3.5}, {1.9, 1.9, 5.0});
    draft_.standing("thicket", leaf_, foot, size, dice_.angle());
  }

  void plant_tree() {
    const Vector3d foot = somewhere() - 0.2 * Vector3d::UnitZ();
    const Vector3d lean = dice_.direction(1.43, 1.57);
    const Tree tree{foot, foot + dice_.real(5.0, 9.0) * lean};
    const bool is_fir = dice_.chance(0.45);
    if (draft_.is_kept_free(foot, is_fir ? 1.2 : 0.5)) return;
    draft_.rod("trunk", bark_, tree.foot_m, tree.top_m, dice_.real(0.12, 0.45));
    trees_.push_back(tree);
    is_fir ? grow_fir(tree) : grow_branches(tree);
  }

  /// Most of them bare, with twigs.
  void grow_branches(const Tree& tree) {
    for (int i = dice_.integer(3, 8); i > 0; --i) {
      const Vector3d from = tree.at(dice_.real(0.8, 4.5));
      const double length_m = dice_.real(0.4, 1.7);
      const Vector3d along = length_m * dice_.direction(-0.3, 0.9);
      if (draft_.is_kept_free(from, length_m)) continue;
      draft_.rod("branch", twig_, from, from + along, draft_.thin_m(0.05));
      for (int twigs = dice_.integer(0, 3); twigs > 0; --twigs) grow_twig(from, along);
      if (dice_.chance(0.4)) grow_leaves(from + along, 0.35);
    }
    grow_leaves(tree.at(5.0), 1.6);
  }
  void grow_twig(const Vector3d& branch_m, const Vector3d& along) {
    const Vector3d from = branch_m + dice_.real(0.4, 1.0) * along;
    const double length_m = dice_.real(0.15, 0.5);
    const Vector3d to = from + length_m * dice_.direction(-0.5, 0.9);
    draft_.rod("twig", twig_, from, to, draft_.thin_m(0.018));
  }
  void grow_leaves(const Vector3d& at_m, double reach_m) {
    for (int i = 0; i < 6; ++i) {
      const double out_m = dice_.real(0.0, reach_m);
      const Vector3d centre = at_m + out_m * dice_.direction(-0.5, 1.0);
      const double size_m = dice_.real(0.1, 0.25) + 0.3 * reach_m;
      draft_.add("leaves", leaf_, Box{centre, {size_m, size_m, 0.04}, dice_.attitude(0.8)});
    }
  }

  /// Whorls of branches that hang down, shorter towards the top.
  void grow_fir(const Tree& tree) {
    constexpr double kDroop_rad = 0.35;
    for (double height_m = 0.7; height_m < 4.8; height_m += 0.55) {
      const double reach_m = 1.2 - 0.2 * height_m;
      double turn = dice_.angle();
      for (int i = 0; i < 6; ++i) {
        turn += dice_.real(0.85, 1.25);
        const Eigen::Quaterniond R = rotation_from_ypr(turn, kDroop_rad, 0.0);
        const Vector3d from = tree.at(height_m), out = R * Vector3d(reach_m, 0, 0);
        draft_.rod("fir branch", twig_, from, from + out, draft_.thin_m(0.03));
        draft_.add("needles", leaf_,
                   Box{from + 0.6 * out, {0.7 * reach_m, 0.3 * reach_m, 0.04}, R});
      }
    }
  }

  void plant_bush() {
    const Vector3d foot = somewhere();
    const double width_m = dice_.real(0.5, 1.1), height_m = dice_.real(0.5, 2.4);
    if (draft_.is_kept_free(foot, width_m)) return;
    draft_.standing("bush", leaf_, foot, {0.5 * width_m, 0.5 * width_m, 0.7 * height_m},
                    dice_.angle());
    for (int i = 0; i < 14; ++i) {
      const double out_m = dice_.real(0.3, 0.8) * width_m;
      Vector3d tip = foot + out_m * dice_.direction(0.0, 0.0);
      tip.z() = dice_.real(0.3, 1.0) * height_m;
      draft_.rod("stem", twig_, foot, tip, draft_.thin_m(0.02));
    }
  }

  void drop_stone() {
    const Vector3d foot = somewhere();
    const Vector3d size = dice_.point({0.2, 0.2, 0.1}, {0.9, 0.7, 0.7});
    if (draft_.is_kept_free(foot, size.x())) return;
    draft_.add("stone", stone_, Box{foot, size, dice_.attitude(0.5)});
  }

  /// Lies, or leans across the way.
  void fell_tree() {
    const Vector3d foot = somewhere();
    const double length_m = dice_.real(3.0, 7.0);
    const Vector3d top = foot + length_m * dice_.direction(0.03, 0.6);
    if (draft_.is_kept_free(0.5 * (foot + top), 0.5 * length_m)) return;
    draft_.rod("fallen tree", bark_, foot, top, dice_.real(0.15, 0.35));
  }

  void hang_wire() {
    if (trees_.size() < 2) return;
    const int last = static_cast<int>(trees_.size()) - 1;
    const Tree& from = trees_[static_cast<std::size_t>(dice_.integer(0, last))];
    const Tree& to = trees_[static_cast<std::size_t>(dice_.integer(0, last))];
    const double span_m = (from.foot_m - to.foot_m).norm();
    const double height_m = dice_.real(1.0, 2.6);
    if (span_m < 1.5 || span_m > 9.0) return;
    draft_.rope("wire", wire_, from.at(height_m), to.at(height_m + dice_.real(-0.3, 0.3)),
                0.03 * span_m, draft_.thinnest_m());
  }

  SceneDraft& draft_;
  Dice& dice_;
  std::uint16_t ground_, bark_, twig_, leaf_, stone_, wire_;
  double length_m_, half_m_;  // of the ground: along x, and to either side
  std::vector<Tree> trees_;
};

}  // namespace

void draw_forest(SceneDraft& draft) { Forest(draft).draw(); }

}  // namespace swiftlet::sim
