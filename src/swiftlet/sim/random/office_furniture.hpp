// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "swiftlet/sim/random/scene_draft.hpp"

namespace swiftlet::sim {

/// What stands and hangs in an office. Nothing is put where the vehicle starts or shall arrive.
class OfficeFurniture {
 public:
  explicit OfficeFurniture(SceneDraft& draft);

  /// Something, at a place of the floor.
  void put_any(const Eigen::Vector3d& foot_m);
  void put_cabinet(const Eigen::Vector3d& foot_m, double yaw_rad);
  /// From a place of the ceiling, on a wire.
  void hang_lamp(const Eigen::Vector3d& ceiling_m);

 private:
  void put_desk(const Eigen::Vector3d& foot_m, double yaw_rad);
  void put_chair(const Eigen::Vector3d& foot_m, double yaw_rad);
  void put_floor_lamp(const Eigen::Vector3d& foot_m);
  void put_plant(const Eigen::Vector3d& foot_m);
  void put_screen(const Eigen::Vector3d& foot_m, double yaw_rad);

  SceneDraft& draft_;
  Dice& dice_;
  std::uint16_t wood_, fabric_, metal_, leaf_, wire_;
};

}  // namespace swiftlet::sim
