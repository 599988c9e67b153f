// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/silhouette.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet {

Silhouette::Silhouette(const CubeView& view, const CubeInView& cell) {
  const float half = 0.5F * view.voxel_m();
  for (int i = 0; i < 3; ++i) {
    const float distance = std::abs(cell.p_world[i]) - half;
    sign_[i] = distance > 0.0F ? std::copysign(1.0F, cell.p_world[i]) : 0.0F;
    near_[i] = distance;
  }
  for (int i = 0; i < 3; ++i) {
    if (sign_[i] == 0.0F) continue;
    const Float3 entry = view.direction_row(i, sign_[i]);
    for (int j = 0; j < 3; ++j) {
      if (j == i) continue;
      const float p = cell.p_world[j];
      if (sign_[j] >= 0.0F) add_side(near_[i], entry, p + half, view.direction_row(j, 1.0F));
      if (sign_[j] <= 0.0F) add_side(near_[i], entry, half - p, view.direction_row(j, -1.0F));
    }
  }
}

// entry * (exit_normal . (u, v, 1)) <= exit * (entry_normal . (u, v, 1))
void Silhouette::add_side(float entry, const Float3& entry_normal, float exit,
                          const Float3& exit_normal) {
  const float a = entry * exit_normal[0] - exit * entry_normal[0];
  const float b = entry * exit_normal[1] - exit * entry_normal[1];
  const float c = entry * exit_normal[2] - exit * entry_normal[2];
  // Level to a millionth of a pixel a column: the row decides, not the column.
  if (std::abs(a) <= 1e-6F * std::abs(b)) {
    if (b > 0.0F) v_high_ = std::min(v_high_, -c / b);
    if (b < 0.0F) v_low_ = std::max(v_low_, -c / b);
    return;
  }
  const float per = -1.0F / a;
  const Side side{b * per, c * per};
  if (a > 0.0F) {
    right_[static_cast<std::size_t>(rights_++)] = side;
  } else {
    left_[static_cast<std::size_t>(lefts_++)] = side;
  }
}

void Silhouette::describe(const CubeView& view, ReadingQuery& query) const {
  for (std::size_t i = 0; i < 3; ++i) {
    const Float3 row = view.direction_row(static_cast<int>(i), sign_[i]);
    query.near[i] = near_[i];
    query.per_u[i] = row[0];
    query.per_v[i] = row[1];
    query.origin[i] = row[2];
  }
}

}  // namespace swiftlet
