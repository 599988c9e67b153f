// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "swiftlet/sim/counter_random.hpp"
#include "swiftlet/sim/triangle_mesh.hpp"

namespace swiftlet::sim {

/// The rock around a cave: a floor and a ceiling over the level, rough, which meet where the cave
/// ends. It is hollow along a line, wider and higher in some places than in others.
class CaveRock {
 public:
  /// A stretch of the line; as wide as its radius on either side.
  struct Passage {
    Eigen::Vector2d from_m, to_m;
    double radius_m;
    double height_m;  ///< of the ceiling over where floor and ceiling meet
  };
  CaveRock(std::vector<Passage> passages, std::uint64_t seed)
      : passages_(std::move(passages)), random_(seed, 0xCA7E) {}

  /// What there is over a place of the level. Equal: rock.
  struct Gap {
    double floor_m, ceiling_m;
  };
  [[nodiscard]] Gap gap(const Eigen::Vector2d& p) const;

  /// Floor and ceiling of all of it. The cave is closed: where the mesh ends, they have met.
  [[nodiscard]] TriangleMesh mesh() const;

 private:
  [[nodiscard]] double roughness(const Eigen::Vector2d& p, double scale_m, unsigned layer) const;

  std::vector<Passage> passages_;
  CounterRandom random_;
};

}  // namespace swiftlet::sim
