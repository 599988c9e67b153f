// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Question: may my drone fly this trajectory, and how fast?
// Run: example_05_check_my_trajectory SOURCE

#include <cstdio>
#include <vector>

#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/query/sweep/speed_limit.hpp"
#include "swiftlet/query/sweep/sweep.hpp"
#include "swiftlet/source/sources.hpp"

namespace {

constexpr const char* kStates[] = {"clear", "unknown", "blocked"};

/// Straight ahead at 2 m/s, a pose every half second, turning to the left all the while.
std::vector<swiftlet::TimedPose> my_trajectory() {
  std::vector<swiftlet::TimedPose> poses;
  for (int i = 0; i <= 6; ++i) {
    const Eigen::Quaterniond yaw(Eigen::AngleAxisd(0.1 * i, Eigen::Vector3d::UnitZ()));
    poses.push_back({{500'000'000LL * i},
                     swiftlet::Transform<swiftlet::World, swiftlet::Body>::trusted(
                         yaw, {0.5 + 1.0 * i, 0.0, 0.0})});
  }
  return poses;
}

}  // namespace

int main(int argc, char** argv) {
  auto source = swiftlet::open_source(argc == 2 ? argv[1] : "");
  swiftlet::MapperConfig config;
  config.map.voxel_m = 0.1;
  auto mapper = swiftlet::Mapper::create(config);
  const auto drone = swiftlet::BodyShape::box({0.3, 0.3, 0.1});  // x, y, z
  if (!source || !mapper || !drone) {
    std::fprintf(stderr, "%s\n", (source ? mapper.error() : source.error()).text().c_str());
    return 2;
  }
  for (auto frame = (*source)->next(); frame && *frame; frame = (*source)->next())
    mapper->integrate(**frame);

  const auto map = mapper->snapshot();
  const auto poses = my_trajectory();
  const auto path = swiftlet::SweepPath::of(poses);
  if (!map || !path) return 1;
  const auto answer = swiftlet::sweep(*map, *drone, *path, {.margin_m = config.map.voxel_m});
  if (!answer) return 1;
  std::printf("the trajectory is %s", kStates[static_cast<int>(answer->state)]);
  if (answer->occupied)
    std::printf(" after %.2f s", static_cast<double>(answer->occupied->stamp.ns) * 1e-9);
  const auto limit_mps = swiftlet::speed_limit_mps(answer->clear_m, {4.0, 0.3});
  std::printf("; %.2f m of it are clear, good for %.2f m/s\n", answer->clear_m, *limit_mps);
}
