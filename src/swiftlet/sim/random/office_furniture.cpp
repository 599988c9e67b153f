// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/random/office_furniture.hpp"

namespace swiftlet::sim {

using Eigen::Vector3d;

OfficeFurniture::OfficeFurniture(SceneDraft& draft)
    : draft_(draft),
      dice_(draft.dice),
      wood_(draft.material("wood", 0.85)),
      fabric_(draft.material("fabric", 0.9)),
      metal_(draft.material("metal", 0.65)),
      leaf_(draft.material("leaves", 0.95)),
      wire_(draft.material("wire", 0.6)) {}

void OfficeFurniture::put_any(const Vector3d& foot_m) {
  const double yaw = dice_.angle();
  if (draft_.is_kept_free(foot_m, 0.9)) return;
  switch (dice_.integer(0, 6)) {
    case 0:
    case 1:
      return put_desk(foot_m, yaw);
    case 2:
      return put_chair(foot_m, yaw);
    case 3:
      return put_floor_lamp(foot_m);
    case 4:
      return put_plant(foot_m);
    case 5:
      return put_screen(foot_m, yaw);
    default:
      return put_cabinet(foot_m, yaw);
  }
}

void OfficeFurniture::put_cabinet(const Vector3d& foot_m, double yaw_rad) {
  const double height_m = dice_.real(0.7, 2.0);
  if (draft_.is_kept_free(foot_m, 0.5)) return;
  draft_.standing("cabinet", wood_, foot_m, {0.8, 0.42, height_m}, yaw_rad);
}

/// A table with a chair, and a monitor on it.
void OfficeFurniture::put_desk(const Vector3d& foot_m, double yaw_rad) {
  const Eigen::Quaterniond R = rotation_from_ypr(yaw_rad, 0.0, 0.0);
  const auto at = [&](double x, double y, double z) -> Vector3d {
    return foot_m + R * Vector3d(x, y, z);
  };
  draft_.add("table", wood_, Box{at(0, 0, 0.73), {1.5, 0.75, 0.03}, R});
  for (const double x : {-0.7, 0.7}) {
    for (const double y : {-0.33, 0.33})
      draft_.rod("leg", metal_, at(x, y, 0.0), at(x, y, 0.72), draft_.thin_m(0.05));
  }
  draft_.add("monitor", metal_, Box{at(0, 0.2, 1.0), {0.6, 0.05, 0.35}, R});
  draft_.rod("foot", metal_, at(0, 0.2, 0.74), at(0, 0.2, 0.9), 0.04);
  put_chair(at(dice_.real(-0.4, 0.4), -0.6, 0.0), yaw_rad);
}

void OfficeFurniture::put_chair(const Vector3d& foot_m, double yaw_rad) {
  const Eigen::Quaterniond R = rotation_from_ypr(yaw_rad, 0.0, 0.0);
  draft_.rod("stem", metal_, foot_m, foot_m + 0.44 * Vector3d::UnitZ(), 0.06);
  draft_.add("seat", fabric_, Box{foot_m + Vector3d(0, 0, 0.47), {0.45, 0.45, 0.07}, R});
  draft_.add("back", fabric_, Box{foot_m + R * Vector3d(0, -0.22, 0.75), {0.42, 0.05, 0.5}, R});
}

void OfficeFurniture::put_floor_lamp(const Vector3d& foot_m) {
  const Vector3d top = foot_m + dice_.real(1.3, 1.9) * Vector3d::UnitZ();
  draft_.rod("foot", metal_, foot_m, foot_m + 0.03 * Vector3d::UnitZ(), 0.3);
  draft_.rod("pole", metal_, foot_m, top, draft_.thin_m(0.025));
  draft_.rod("shade", fabric_, top, top + 0.22 * Vector3d::UnitZ(), 0.32);
}

void OfficeFurniture::put_plant(const Vector3d& foot_m) {
  draft_.rod("pot", metal_, foot_m, foot_m + 0.35 * Vector3d::UnitZ(), 0.35);
  for (int i = 0; i < 10; ++i) {
    const double length_m = dice_.real(0.4, 1.1);
    const Vector3d stem = foot_m + 0.3 * Vector3d::UnitZ();
    const Vector3d tip = stem + length_m * dice_.direction(0.8, 1.5);
    draft_.rod("stem", leaf_, stem, tip, draft_.thin_m(0.015));
    draft_.add("leaf", leaf_, Box{tip, {0.18, 0.1, draft_.thinnest_m()}, dice_.attitude(0.8)});
  }
}

/// A sheet between two poles.
void OfficeFurniture::put_screen(const Vector3d& foot_m, double yaw_rad) {
  const double height_m = dice_.real(1.2, 1.9);
  draft_.standing("screen", fabric_, foot_m + 0.05 * Vector3d::UnitZ(),
                  {dice_.real(0.9, 1.6), 0.03, height_m}, yaw_rad);
}

void OfficeFurniture::hang_lamp(const Vector3d& ceiling_m) {
  const Vector3d lamp = ceiling_m - dice_.real(0.3, 1.0) * Vector3d::UnitZ();
  if (draft_.is_kept_free(lamp, 0.3)) return;
  draft_.rod("wire", wire_, lamp, ceiling_m, draft_.thinnest_m());
  draft_.rod("lamp", fabric_, lamp - 0.2 * Vector3d::UnitZ(), lamp, dice_.real(0.2, 0.5));
}

}  // namespace swiftlet::sim
