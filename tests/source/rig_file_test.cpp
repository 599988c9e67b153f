// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/rig_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string complaint(const std::string& yaml) {
  const auto rig = parse_rig(yaml, "rig.yaml");
  return rig ? "" : rig.error().text();
}

Eigen::Vector3d looks(const RigCamera& camera) {
  return camera.T_body_camera.rotation() * Eigen::Vector3d::UnitZ();
}

TEST(RigFile, knows_intel_s_bracket) {
  const auto rig = parse_rig("cameras: [{ mount: intel_t265_d435, looks: forward }]", "rig.yaml");
  ASSERT_TRUE(rig) << rig.error().text();
  const RigCamera& camera = rig->rig.cameras.at(0);
  // 28 mm above the T265, 9 mm in front of it, 16 mm to its left, looking forward within 1 degree.
  EXPECT_LT((camera.T_body_camera.translation() - Eigen::Vector3d(0.0094, 0.0159, 0.0283)).norm(),
            1e-4);
  EXPECT_LT(std::acos(looks(camera).x()), 0.02);
  EXPECT_EQ(rig->rig.poses.gates.min_confidence, 2);
}

TEST(RigFile, reads_a_matrix_in_the_axes_of_a_t265_as_the_preset_does) {
  const auto rig = parse_rig(
      "cameras:\n"
      "  - axes: t265\n"
      "    matrix: [0.999968402, -0.006753626, -0.004188075, -0.015890727,\n"
      "             -0.006685408, -0.999848172, 0.016093893, 0.028273059,\n"
      "             -0.004296131, -0.016065384, -0.999861654, -0.009375589]\n",
      "rig.yaml");
  ASSERT_TRUE(rig) << rig.error().text();
  const auto preset = intel_t265_d435_mount();
  EXPECT_EQ(rig->rig.cameras[0].T_body_camera.translation(), preset.translation());
  EXPECT_EQ(rig->rig.cameras[0].T_body_camera.rotation().coeffs(), preset.rotation().coeffs());
}

TEST(RigFile, reads_four_cameras_and_every_gate) {
  const auto rig = parse_rig(R"(
cameras:
  - { name: front, at_m: [0.1, 0, 0], looks: forward, stream: /front/depth }
  - { name: left, at_m: [0, 0.1, 0], yaw_deg: 90, looks: left, pose_offset_s: -0.004 }
  - { name: back, at_m: [-0.1, 0, 0], yaw_deg: 180, looks: back, baseline_m: 0.095 }
  - { name: right, at_m: [0, -0.1, 0], yaw_deg: -90, looks: right }
pose: { stream: /odom, body_frame: drone, axes: optical, min_confidence: 3, max_gap_s: 0.1,
        stale_after_s: 1, max_speed_mps: 4, max_acceleration_mps2: 20, max_turn_degps: 90,
        slack_m: 0.03, slack_deg: 2, on_jump: clear }
body_box: { from_m: [-0.2, -0.2, -0.1], to_m: [0.2, 0.2, 0.05] }
)",
                             "rig.yaml");
  ASSERT_TRUE(rig) << rig.error().text();
  ASSERT_EQ(rig->rig.cameras.size(), 4U);
  EXPECT_EQ(rig->rig.cameras[0].stream, "/front/depth");
  EXPECT_EQ(rig->rig.cameras[1].pose_offset, std::chrono::milliseconds(-4));
  EXPECT_EQ(rig->rig.cameras[2].baseline_m, 0.095);
  EXPECT_LT((looks(rig->rig.cameras[3]) + Eigen::Vector3d::UnitY()).norm(), 1e-9);
  const PoseGates& gates = rig->rig.poses.gates;
  EXPECT_EQ(gates.min_confidence, 3);
  EXPECT_EQ(gates.max_speed_mps, 4.0);
  EXPECT_EQ(gates.max_acceleration_mps2, 20.0);
  EXPECT_NEAR(gates.max_turn_radps, M_PI / 2, 1e-12);
  EXPECT_EQ(gates.slack_m, 0.03);
  EXPECT_NEAR(gates.slack_rad, M_PI / 90, 1e-12);
  EXPECT_EQ(gates.on_jump, JumpPolicy::kClear);
  EXPECT_EQ(rig->rig.poses.track.max_gap, std::chrono::milliseconds(100));
  EXPECT_EQ(rig->rig.stale_after, std::chrono::seconds(1));
  EXPECT_EQ(rig->pose_stream, "/odom");
  EXPECT_EQ(rig->body_frame, "drone");
  EXPECT_EQ(rig->pose_axes, BodyAxes::kOptical);
  EXPECT_EQ(rig->rig.body_box->to_m.z(), 0.05);
}

TEST(RigFile, names_the_line_and_the_remedy_of_a_fault) {
  EXPECT_THAT(complaint("cameras: []"), HasSubstr("1 to 8 cameras"));
  EXPECT_THAT(complaint("camera: {}"), HasSubstr("rig.yaml"));
  EXPECT_THAT(complaint("cameras: [{}]"), HasSubstr("exactly one of mount, matrix, at_m"));
  EXPECT_THAT(complaint("cameras: [{mount: intel}]"), HasSubstr("intel_t265_d435"));
  EXPECT_THAT(complaint("cameras: [{at_m: [0, 0, 0], colour: red}]"),
              AllOf(HasSubstr("rig.yaml:1"), HasSubstr("unknown key 'colour'")));
  EXPECT_THAT(complaint("cameras: [{at_m: [16, 28, 9]}]"), HasSubstr("metres"));
  EXPECT_THAT(complaint("cameras: [{at_m: [0, 0, 0], yaw_deg: 180, looks: forward}]"),
              HasSubstr("180 degrees off 'forward'"));
  EXPECT_THAT(complaint("cameras: [{matrix: [1,0,0,0, 0,1,0,0, 0,0,-1,0]}]"),
              AllOf(HasSubstr("determinant is -1"), HasSubstr("mirror")));
  EXPECT_THAT(complaint("cameras: [{matrix: [1,0,0]}]"), HasSubstr("12 numbers"));
  EXPECT_THAT(complaint("cameras: [{at_m: [0,0,0]}]\npose: {on_jump: panic}"), HasSubstr("keep"));
  EXPECT_THAT(complaint("cameras: [{at_m: [0,0,0]}]\nbody_box: {from_m: [0,0,0], to_m: [1,1,0]}"),
              HasSubstr("no inside"));
  EXPECT_THAT(complaint("cameras: ["), HasSubstr("not YAML"));
}

TEST(BodyBox, drops_what_lies_in_it_and_nothing_else) {
  test::for_each_seed(50, [](test::Random& random) {
    const BodyBox box{random.vector(-0.6, -0.05), random.vector(0.05, 0.6)};
    const auto mount =
        Transform<Body, Camera>::from(random.rotation(), random.vector(-0.8, 0.8)).value();
    const auto intrinsics = PinholeIntrinsics::create(32, 24, 20.0, 20.0, 15.5, 11.5).value();
    const BodyBoxMask mask(box, mount, intrinsics);
    DepthImage depth{Image<std::uint16_t>(32, 24), 0.001F};
    for (auto& raw : depth.raw.pixels()) raw = random.integer<std::uint16_t>(1, 2000);
    const DepthImage before = depth;
    mask.clear(depth);
    for (int v = 0; v < 24; ++v) {
      for (int u = 0; u < 32; ++u) {
        const Eigen::Vector3d p =
            mount * intrinsics.back_project(u, v, double{before.depth_m(u, v)});
        const double inside = std::min((p - box.from_m).minCoeff(), (box.to_m - p).minCoeff());
        if (std::abs(inside) < 1e-5) continue;  // on its surface, to rounding
        EXPECT_EQ(depth.raw.at(u, v), inside > 0 ? 0 : before.raw.at(u, v));
      }
    }
  });
}

}  // namespace
}  // namespace swiftlet
