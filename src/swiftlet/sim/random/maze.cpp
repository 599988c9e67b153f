// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <utility>
#include <vector>

#include "swiftlet/sim/random/scene_draft.hpp"

namespace swiftlet::sim {
namespace {

using Eigen::Vector3d;

class Maze {
 public:
  explicit Maze(SceneDraft& draft)
      : draft_(draft),
        dice_(draft.dice),
        floor_(draft.material("floor", 0.8)),
        wall_(draft.material("wall", 0.75)),
        metal_(draft.material("metal", 0.65)),
        nx_(static_cast<int>(draft.size_m(24.0) / kCell_m)),
        ny_(nx_ * 2 / 3),
        walls_(static_cast<std::size_t>(2 * nx_ * ny_), true),
        is_reached_(static_cast<std::size_t>(nx_ * ny_), false) {
    draft.task.start_m = middle(0, dice_.integer(0, ny_ - 1)) + 1.2 * Vector3d::UnitZ();
    draft.task.goal_m = middle(nx_ - 1, dice_.integer(0, ny_ - 1)) + 1.2 * Vector3d::UnitZ();
    draft.task.start_yaw_rad = 0.0;
    draft.task.bounds_m = {Vector3d::Zero(), Vector3d(nx_ * kCell_m, ny_ * kCell_m, kHeight_m)};
  }

  void draw() {
    draft_.shell(floor_, wall_, draft_.task.bounds_m.min(), draft_.task.bounds_m.max());
    carve();
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      if (walls_[i] && !dice_.chance(0.12)) build_wall(static_cast<int>(i));
    }
    for (int i = dice_.about(0.7 * nx_ * ny_ * draft_.density()); i > 0; --i) put_obstacle();
  }

 private:
  static constexpr double kCell_m = 2.4, kHeight_m = 2.5, kWall_m = 0.12;

  [[nodiscard]] static Vector3d middle(int x, int y) {
    return {(x + 0.5) * kCell_m, (y + 0.5) * kCell_m, 0.0};
  }
  [[nodiscard]] std::size_t cell(int x, int y) const {
    return static_cast<std::size_t>(y * nx_ + x);
  }
  /// The wall towards +x (side 0) or +y (side 1) of a cell.
  [[nodiscard]] std::size_t wall(int x, int y, int side) const { return 2 * cell(x, y) + side; }

  /// Opens walls until every cell can be reached from every other (depth first).
  void carve() {
    struct Place {
      int x, y;
    };
    std::vector<Place> path{{0, 0}};
    is_reached_[cell(0, 0)] = true;
    while (!path.empty()) {
      const Place here = path.back();
      std::vector<Place> fresh;
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const int x = here.x + dx, y = here.y + dy;
        if (x >= 0 && x < nx_ && y >= 0 && y < ny_ && !is_reached_[cell(x, y)])
          fresh.push_back({x, y});
      }
      if (fresh.empty()) {
        path.pop_back();
        continue;
      }
      const Place next =
          fresh[static_cast<std::size_t>(dice_.integer(0, static_cast<int>(fresh.size()) - 1))];
      const bool is_along_x = next.y == here.y;
      walls_[wall(std::min(here.x, next.x), std::min(here.y, next.y), is_along_x ? 0 : 1)] = false;
      is_reached_[cell(next.x, next.y)] = true;
      path.push_back(next);
    }
  }

  void build_wall(int number) {
    const int side = number % 2, x = number / 2 % nx_, y = number / 2 / nx_;
    if ((side == 0 && x == nx_ - 1) || (side == 1 && y == ny_ - 1)) return;  // the hall's own
    const Vector3d half_thick = Vector3d(0.5 * kWall_m, 0.5 * kWall_m, 0.0);
    const Vector3d corner = middle(x, y) + 0.5 * kCell_m * Vector3d(1, 1, 0);
    const Vector3d along = side == 0 ? Vector3d(0, -kCell_m, 0) : Vector3d(-kCell_m, 0, 0);
    draft_.box("wall", wall_, corner + along - half_thick,
               corner + half_thick + kHeight_m * Vector3d::UnitZ());
  }

  /// Beside the middle of a cell, so that there is mostly a way around it.
  void put_obstacle() {
    const int x = dice_.integer(0, nx_ - 1), y = dice_.integer(0, ny_ - 1);
    Vector3d aside = dice_.point({0.45, 0.45, 0.0}, {0.95, 0.95, 0.0});
    if (dice_.chance(0.5)) aside.x() = -aside.x();
    if (dice_.chance(0.5)) aside.y() = -aside.y();
    const Vector3d at = middle(x, y) + aside;
    if (draft_.is_kept_free(at, 0.5)) return;
    switch (dice_.integer(0, 3)) {
      case 0:
        return lay_pipe(middle(x, y), aside);
      case 1:
        return draft_.rod("post", metal_, at, at + kHeight_m * Vector3d::UnitZ(),
                          draft_.thin_m(0.1));
      case 2:
        return build_step(middle(x, y));
      default:
        return draft_.rod("cable", metal_, at + dice_.real(0.6, 1.8) * Vector3d::UnitZ(),
                          at + kHeight_m * Vector3d::UnitZ(), draft_.thinnest_m());
    }
  }
  [[nodiscard]] Vector3d half_cell() {
    return 0.5 * kCell_m * (dice_.chance(0.5) ? Vector3d::UnitX() : Vector3d::UnitY());
  }
  /// From wall to wall, low or high.
  void lay_pipe(const Vector3d& middle_m, const Vector3d& aside_m) {
    const Vector3d half = half_cell();
    Vector3d centre =
        middle_m + (half.x() > 0.0 ? Vector3d(0, aside_m.y(), 0) : Vector3d(aside_m.x(), 0, 0));
    centre.z() = dice_.chance(0.5) ? dice_.real(0.2, 0.9) : dice_.real(1.6, 2.35);
    draft_.rod("pipe", metal_, centre - half, centre + half, draft_.thin_m(0.06));
  }
  /// A low wall to fly over.
  void build_step(const Vector3d& middle_m) {
    const Vector3d half = half_cell(), thick(0.12, 0.12, 0.0);
    const Vector3d up = dice_.real(0.3, 0.9) * Vector3d::UnitZ();
    draft_.box("low wall", wall_, middle_m - half - thick, middle_m + half + thick + up);
  }

  SceneDraft& draft_;
  Dice& dice_;
  std::uint16_t floor_, wall_, metal_;
  int nx_, ny_;  // cells
  std::vector<bool> walls_;
  std::vector<bool> is_reached_;
};

}  // namespace

void draw_maze(SceneDraft& draft) { Maze(draft).draw(); }

}  // namespace swiftlet::sim
