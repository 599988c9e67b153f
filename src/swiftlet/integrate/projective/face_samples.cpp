// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/projective/face_samples.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace swiftlet {
namespace {

constexpr float kGoldenRatio = 0.61803399F;

/// The step from point to point of a lattice of n of them: prime to n, so that all are met, and
/// about n times the golden ratio, so that the first few are spread over the face, too.
constexpr auto kStrides = [] {
  std::array<std::size_t, FaceSamples::kMost + 4> strides{};
  for (std::size_t n = 1; n < strides.size(); ++n) {
    strides[n] = (382 * n + 500) / 1000;
    while (std::gcd(strides[n], n) != 1) ++strides[n];
  }
  return strides;
}();

float fraction(float v) { return v - std::floor(v); }

}  // namespace

void FaceSamples::spread(int count, const Float3& p_world, float voxel_m,
                         const std::array<Float3, 3>& world_axis, std::uint64_t frame_number) {
  // A face's share of the image is that of its distance: the area of one is |n q| / q_z^3.
  Float3 distance;
  for (int i = 0; i < 3; ++i)
    distance[i] = std::max(0.1F * voxel_m, std::abs(p_world[i]) - 0.5F * voxel_m);
  const float per_all =
      static_cast<float>(std::min(count, kMost)) / (distance[0] + distance[1] + distance[2]);
  const float shift = fraction(static_cast<float>(frame_number % 1024U) * kGoldenRatio);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto n = static_cast<std::size_t>(std::max(1.0F, distance[i] * per_all + 0.5F));
    first_[i + 1] = first_[i] + n;
    const Float3 &a = world_axis[(i + 1) % 3], &b = world_axis[(i + 2) % 3];
    // A Fibonacci lattice: even for any number of points.
    std::size_t k = 0;
    for (std::size_t at = 0; at < n; ++at, k = (k + kStrides[n]) % n) {
      const float rank = static_cast<float>(k) + 0.5F;
      const float x = (fraction(rank / static_cast<float>(n) + shift) - 0.5F) * voxel_m;
      const float y = (fraction(rank * kGoldenRatio + shift) - 0.5F) * voxel_m;
      FaceSample& place = places_[first_[i] + at];
      place.along_j = x;
      place.along_k = y;
      for (std::size_t axis = 0; axis < 3; ++axis) place.to[axis] = x * a[axis] + y * b[axis];
    }
  }
}

}  // namespace swiftlet
