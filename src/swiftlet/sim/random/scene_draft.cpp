// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/random/scene_draft.hpp"

#include <utility>

#include "swiftlet/base/narrow.hpp"

namespace swiftlet::sim {

using Eigen::Vector3d;

SceneDraft::SceneDraft(std::uint64_t seed, std::uint64_t attempt, const RandomSceneOptions& options,
                       double density)
    : dice(seed, attempt), options_(options), density_(density) {
  scene.seed = seed;
  scene.materials.clear();
}

std::uint16_t SceneDraft::material(std::string_view name, double texture) {
  scene.materials.push_back({std::string(name), texture});
  return to<std::uint16_t>(scene.materials.size() - 1);
}

void SceneDraft::add(std::string_view name, std::uint16_t material, decltype(Object::shape) shape) {
  scene.objects.push_back({std::string(name), std::move(shape), material});
}

void SceneDraft::box(std::string_view name, std::uint16_t material, const Vector3d& from_m,
                     const Vector3d& to_m) {
  add(name, material, Box{0.5 * (from_m + to_m), (to_m - from_m).cwiseAbs()});
}

void SceneDraft::standing(std::string_view name, std::uint16_t material, const Vector3d& foot_m,
                          const Vector3d& size_m, double yaw_rad) {
  add(name, material,
      Box{foot_m + 0.5 * size_m.z() * Vector3d::UnitZ(), size_m,
          rotation_from_ypr(yaw_rad, 0.0, 0.0)});
}

void SceneDraft::rod(std::string_view name, std::uint16_t material, const Vector3d& from_m,
                     const Vector3d& to_m, double diameter_m) {
  add(name, material, Cylinder{from_m, to_m, diameter_m});
}

void SceneDraft::rope(std::string_view name, std::uint16_t material, const Vector3d& from_m,
                      const Vector3d& to_m, double sag_m, double diameter_m) {
  constexpr int kPieces = 8;
  const auto at = [&](int i) -> Vector3d {
    const double share = static_cast<double>(i) / kPieces;
    return from_m + share * (to_m - from_m) -
           4.0 * share * (1.0 - share) * sag_m * Vector3d::UnitZ();
  };
  for (int i = 0; i < kPieces; ++i) rod(name, material, at(i), at(i + 1), diameter_m);
}

void SceneDraft::shell(std::uint16_t floor, std::uint16_t wall, const Vector3d& from_m,
                       const Vector3d& to_m) {
  constexpr double kThick_m = 0.2;
  const Vector3d thick = Vector3d::Constant(kThick_m);
  const Vector3d low = from_m - thick, high = to_m + thick;
  box("floor", floor, low, {high.x(), high.y(), from_m.z()});
  box("ceiling", wall, {low.x(), low.y(), to_m.z()}, high);
  box("wall", wall, low, {from_m.x(), high.y(), high.z()});
  box("wall", wall, {to_m.x(), low.y(), low.z()}, high);
  box("wall", wall, low, {high.x(), from_m.y(), high.z()});
  box("wall", wall, {low.x(), to_m.y(), low.z()}, high);
}

bool SceneDraft::is_kept_free(const Vector3d& p_m, double reach_m) const {
  constexpr double kRoom_m = 1.2;
  const auto is_near = [&](const Vector3d& place) {
    return (place - p_m).head<2>().norm() < reach_m + kRoom_m;
  };
  return is_near(task.start_m) || is_near(task.goal_m);
}

}  // namespace swiftlet::sim
