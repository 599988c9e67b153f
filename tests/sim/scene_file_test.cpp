// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/scene_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>

#include "swiftlet/sim/built_in_scenes.hpp"
#include "swiftlet/sim/stereo_camera.hpp"

namespace swiftlet::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

std::vector<std::string> built_in_names() {
  std::vector<std::string> names;
  for (const auto& scene : built_in_scenes()) names.emplace_back(scene.name);
  return names;
}

TEST(BuiltInScenes, are_those_that_the_experiments_need) {
  EXPECT_THAT(built_in_names(), IsSupersetOf({"aisle", "apartment", "corridor_loop", "large_box",
                                              "small_box", "thin", "walker", "wall"}));
}

class EveryBuiltInScene : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryBuiltInScene, loads_and_fills_half_of_its_first_picture) {
  auto scene = load_scene(GetParam());
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene->name, GetParam());
  EXPECT_GE(scene->flight.duration(), std::chrono::seconds(4));
  scene->camera.width /= 4;  // a quarter of the rays will do
  scene->camera.height /= 4;
  const auto world = RayCaster::create(*scene).value();
  auto camera = StereoCamera::create(scene->camera, scene->seed).value();
  const auto depth = camera.capture(world, scene->flight.camera_at(Nanoseconds(0)), 0);
  const auto pixels = depth.raw.pixels();
  EXPECT_LT(std::ranges::count(pixels, 0), static_cast<std::ptrdiff_t>(pixels.size() / 2));
}

TEST_P(EveryBuiltInScene, keeps_its_flight_20_cm_from_everything_that_stands_still) {
  const auto scene = load_scene(GetParam()).value();
  const auto world = RayCaster::create(scene).value();
  std::vector<Eigen::Vector3f> directions;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0)
          directions.push_back(Eigen::Vector3d(x, y, z).normalized().cast<float>());
  std::vector<Hit> hits(directions.size());
  for (Nanoseconds t{0}; t <= scene.flight.duration(); t += std::chrono::milliseconds(100)) {
    const Eigen::Vector3d p = scene.flight.at(t).translation();
    world.cast(p.cast<float>(), directions, hits);
    const float nearest_m = std::ranges::min(hits, {}, &Hit::distance).distance;
    ASSERT_GT(nearest_m, 0.2F) << "at " << seconds(t) << " s, " << p.transpose();
  }
}
INSTANTIATE_TEST_SUITE_P(BuiltIn, EveryBuiltInScene, ::testing::ValuesIn(built_in_names()),
                         [](const auto& scene) { return scene.param; });

TEST(SceneFile, puts_the_box_experiments_where_the_method_wants_them) {
  for (const auto& [name, size] : {std::pair{"large_box", Eigen::Vector3d(0.32, 0.47, 0.365)},
                                   {"small_box", Eigen::Vector3d(0.09, 0.25, 0.185)}}) {
    const auto scene = load_scene(name).value();
    const Eigen::Vector3d camera = scene.flight.at(Nanoseconds(0)).translation();
    EXPECT_EQ(camera, Eigen::Vector3d(0.1, 0.0, 0.1)) << "mid-voxel in x and z, on a boundary in y";
    const auto& box = std::get<Box>(scene.objects.front().shape);
    EXPECT_EQ(box.size_m, size);
    EXPECT_NEAR(box.centre_m.x() - size.x() / 2 - camera.x(), 2.0, 1e-12);
    EXPECT_EQ(box.centre_m.tail<2>(), camera.tail<2>());
    EXPECT_GE(seconds(scene.flight.duration()) * scene.camera.rate_hz, 105.0) << "100 good frames";
  }
}

constexpr std::string_view kGood = R"(materials:
  brick: { texture: 0.9 }
boxes:
  - { centre_m: [2, 0, 0], size_m: [1, 1, 1], yaw_deg: 90, material: brick }
mount: { at_m: [0.1, 0.2, 0.3], yaw_deg: 90 }
tracker: { nan_chance: 0.5, jump: { at_s: 3, by_m: [1, 2, 3] } }
camera: { width_px: 64, height_px: 48 }
flight:
  speed_mps: 2
  waypoints:
    - { at_m: [0, 0, 1] }
    - { at_m: [4, 0, 1] }
    - { at_m: [4, 0, 1], yaw_deg: 90, leg_s: 5 }
)";

TEST(SceneFile, reads_what_it_says) {
  const auto scene = parse_scene(kGood, "good.yaml");
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene->name, "good");
  EXPECT_EQ(scene->materials[scene->objects[0].material].texture, 0.9);
  EXPECT_EQ(scene->camera.width, 64);
  EXPECT_EQ(scene->tracker.jump->by_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(scene->flight.waypoints()[1].time_s, 2.0) << "4 m at 2 m/s";
  EXPECT_EQ(scene->flight.waypoints()[2].time_s, 7.0);
  // The mount is turned left: the camera looks along the body's y axis.
  const Eigen::Vector3d ahead = scene->T_body_camera * Eigen::Vector3d(0, 0, 1);
  EXPECT_LT((ahead - Eigen::Vector3d(0.1, 1.2, 0.3)).norm(), 1e-12);
}

struct Fault {
  std::string_view replaced, by, place, what;
  friend void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.what; }
};
class FaultyScene : public ::testing::TestWithParam<Fault> {};

TEST_P(FaultyScene, is_refused_with_the_file_and_the_line) {
  std::string yaml(kGood);
  const auto at = yaml.find(GetParam().replaced);
  ASSERT_NE(at, std::string::npos);
  yaml.replace(at, GetParam().replaced.size(), GetParam().by);
  const auto scene = parse_scene(yaml, "bad.yaml");
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().text(),
              AllOf(HasSubstr(std::string("bad.yaml:") + std::string(GetParam().place)),
                    HasSubstr(std::string(GetParam().what))));
}
INSTANTIATE_TEST_SUITE_P(
    Faults, FaultyScene,
    ::testing::Values(Fault{"speed_mps: 2", "sped_mps: 2", "9:", "unknown key 'sped_mps'"},
                      Fault{"yaw_deg: 90, material", "yaw_dge: 90, material",
                            "4:", "known are: centre_m"},
                      Fault{"centre_m: [2, 0, 0], size", "size", "4:", "lacks the key 'centre_m'"},
                      Fault{"size_m: [1, 1, 1]", "size_m: [1, -1, 1]", "4:", "longer than 0"},
                      Fault{"size_m: [1, 1, 1]", "size_m: [1, 1]", "4:", "three numbers"},
                      Fault{"size_m: [1, 1, 1]", "size_m: [1, x, 1]", "4:", "must be a number"},
                      Fault{"at_m: [0, 0, 1]", "at_m: [0, .nan, 1]", "11:", "cannot be nan"},
                      Fault{"material: brick", "material: brik", "4:", "known are: default, brick"},
                      Fault{"texture: 0.9", "texture: 1.9", "2:", "from 0 to 1"},
                      Fault{"nan_chance: 0.5", "nan_chance: 2", "6:", "from 0 to 1"},
                      Fault{"leg_s: 5", "leg_s: 0", "13:", "greater than 0"},
                      Fault{"speed_mps: 2", "speed_mps: 2\n  speed_mps: 3", "10:", "stands twice"},
                      Fault{"width_px: 64", "width_px: many", "7:", "must be a number"},
                      Fault{"flight:", "fligth:", "1:", "the flight is missing"},
                      Fault{"    - { at_m: [0, 0, 1] }\n    - { at_m: [4, 0, 1] }\n"
                            "    - { at_m: [4, 0, 1], yaw_deg: 90, leg_s: 5 }\n",
                            "    []\n", "9:", "the flight has no waypoints"},
                      Fault{"flight:\n", "flight: }\n", "8:", "not YAML"}));

TEST(SceneFile, names_the_scenes_there_are_when_it_does_not_know_one) {
  const auto scene = load_scene("appartment");
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(scene.error().text(), HasSubstr("aisle, apartment, calibration, corridor_loop"));
  EXPECT_THAT(load_scene("no/such.yaml").error().text(), HasSubstr("no/such.yaml"));
}

TEST(SceneFile, finds_meshes_beside_itself) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "swiftlet_scene_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "roof.ply") << "ply\nformat ascii 1.0\nelement vertex 3\n"
                                        "property float x\nproperty float y\nproperty float z\n"
                                        "element face 1\nproperty list uchar int vertex_indices\n"
                                        "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  std::ofstream(folder / "house.yaml")
      << "meshes: [ { file: roof.ply, at_m: [5, 0, 0], scale: 2 } ]\n"
         "flight: { waypoints: [ { at_m: [0, 0, 0] } ] }\n";
  const auto scene = load_scene((folder / "house.yaml").string());
  ASSERT_TRUE(scene) << scene.error().text();
  const auto& mesh = std::get<TriangleMesh>(scene->objects.front().shape);
  EXPECT_EQ(mesh.vertices_m[1], Eigen::Vector3f(7, 0, 0));
  std::filesystem::remove(folder / "roof.ply");
  EXPECT_THAT(load_scene((folder / "house.yaml").string()).error().text(),
              AllOf(HasSubstr("house.yaml:1"), HasSubstr("roof.ply")));
}

TEST(SceneFile, refuses_what_a_few_bytes_make_endless) {
  const auto complaint = [](const std::string& yaml) {
    const auto scene = parse_scene(yaml, "s.yaml");
    return scene ? std::string("none") : scene.error().text();
  };
  const std::string flight = "flight: { waypoints: [ { at_m: [0, 0, 1] } ] }\n";
  std::string laughs = "boxes: &b0\n  - { from_m: [3, -2, 0], to_m: [4, 2, 2] }\n";
  for (int i = 1; i < 9; ++i) {
    laughs += fmt::format("k{0}: &b{0} [", i);
    for (int k = 0; k < 10; ++k) laughs += fmt::format("*b{}, ", i - 1);
    laughs += "]\n";
  }
  EXPECT_THAT(complaint(laughs + flight), HasSubstr("stands for more than"));

  std::string pillars = flight + "cylinders:\n";
  for (int i = 0; i < 3000; ++i)
    pillars += "  - { from_m: [0, 0, 0], to_m: [0, 0, 9], diameter_m: 99 }\n";
  EXPECT_THAT(complaint(pillars), AllOf(HasSubstr("s.yaml:"), HasSubstr("triangles")));

  EXPECT_THAT(complaint(flight + "cylinders: [ { from_m: [0, 0, 0], to_m: [0, 0, 9], "
                                 "diameter_m: -0.003 } ]\n"),
              HasSubstr("s.yaml:2"));
  EXPECT_THAT(complaint("boxes: [ { from_m: [3, -2, 0], to_m: [3.2, 2, 1e20] } ]\n" + flight),
              AllOf(HasSubstr("s.yaml:1"), HasSubstr("1000000")));
  EXPECT_THAT(complaint("planes: [ { centre_m: [3, 0, 0], normal: [1, 0, 0] } ]\n"
                        "flight: { speed_mps: 1e-9, waypoints: [ { at_m: [0, 0, 1] }, "
                        "{ at_m: [9, 0, 1] } ] }\n"),
              HasSubstr("more than a day"));
}

}  // namespace
}  // namespace swiftlet::sim
