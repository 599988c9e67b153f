// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/sim/random/dice.hpp"
#include "swiftlet/sim/random/generated_scene.hpp"
#include "swiftlet/sim/scene.hpp"

namespace swiftlet::sim {

/// A scene while it is drawn: what a kind (scene_kinds.cpp) gets to draw with, and its drawing.
class SceneDraft {
 public:
  SceneDraft(std::uint64_t seed, std::uint64_t attempt, const RandomSceneOptions& options,
             double density);

  Dice dice;
  Scene scene;
  SceneTask task{};  ///< all but the way, which is looked for when all is drawn

  [[nodiscard]] double size_m(double usual_m) const { return options_.size_m.value_or(usual_m); }
  [[nodiscard]] double density() const { return density_; }
  [[nodiscard]] double thinnest_m() const { return options_.thinnest_m; }
  /// A thin thing's diameter: from the thinnest up to a usual one.
  [[nodiscard]] double thin_m(double up_to_m) {
    return dice.real(options_.thinnest_m, std::max(options_.thinnest_m, up_to_m));
  }

  /// The number of a new material.
  std::uint16_t material(std::string_view name, double texture);

  void add(std::string_view name, std::uint16_t material, decltype(Object::shape) shape);
  /// Along the axes, from corner to corner.
  void box(std::string_view name, std::uint16_t material, const Eigen::Vector3d& from_m,
           const Eigen::Vector3d& to_m);
  /// A box that stands at a place of the floor, turned about the vertical.
  void standing(std::string_view name, std::uint16_t material, const Eigen::Vector3d& foot_m,
                const Eigen::Vector3d& size_m, double yaw_rad);
  void rod(std::string_view name, std::uint16_t material, const Eigen::Vector3d& from_m,
           const Eigen::Vector3d& to_m, double diameter_m);
  /// A rope that hangs through between two points by `sag_m`, in straight pieces.
  void rope(std::string_view name, std::uint16_t material, const Eigen::Vector3d& from_m,
            const Eigen::Vector3d& to_m, double sag_m, double diameter_m);

  /// Floor, walls and ceiling of a hall whose inside goes from corner to corner.
  void shell(std::uint16_t floor, std::uint16_t wall, const Eigen::Vector3d& from_m,
             const Eigen::Vector3d& to_m);

  /// Whether a thing of that reach would stand where the vehicle starts or shall arrive.
  [[nodiscard]] bool is_kept_free(const Eigen::Vector3d& p_m, double reach_m) const;

 private:
  RandomSceneOptions options_;
  double density_;
};

}  // namespace swiftlet::sim
