// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The projective integrator against ray tracing, on a real Kinect recording of a room.

#include <gtest/gtest.h>

#include "support/agreement.hpp"
#include "support/recorded.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet {
namespace {

void check_room(double voxel_m) {
  const auto folder = test::recorded_folder("sevenscenes_room200");
  SWIFTLET_NEEDS_RECORDING(folder);
  auto source = open_source("7scenes:" + folder.string());
  ASSERT_TRUE(source) << source.error().text();
  std::unique_ptr<test::AgreementCheck> check;
  for (int i = 0; i < 40; ++i) {
    for (int skipped = 0; skipped < 2; ++skipped) ASSERT_TRUE((*source)->next());
    const auto frame = (*source)->next();
    ASSERT_TRUE(frame && *frame);
    const Eigen::Vector3d middle_m = (*frame)->T_world_camera.translation();
    if (!check) {
      check = std::make_unique<test::AgreementCheck>(voxel_m, Eigen::Vector3d(11, 11, 11), middle_m,
                                                     5.0, 0.075);
    }
    check->add(**frame);
  }
  const test::Agreement agreement = check->result();
  testing::Test::RecordProperty("agreement", agreement.text());
  test::expect_agreement(agreement);
}

TEST(Room, agrees_with_rays_in_voxels_of_20_cm) { check_room(0.2); }
TEST(Room, agrees_with_rays_in_voxels_of_5_cm) { check_room(0.05); }

}  // namespace
}  // namespace swiftlet
