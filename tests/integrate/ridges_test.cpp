// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>

#include "support/every_instruction_set.hpp"
#include "support/seeds.hpp"
#include "swiftlet/integrate/image/ridge_kernels.hpp"

namespace swiftlet {
namespace {

constexpr int kRidgeWidth = 83, kRidgeHeight = 37;

std::uint16_t pixel_or_none(const Image<std::uint16_t>& image, int u, int v) {
  const bool is_inside = u >= 0 && v >= 0 && u < image.width() && v < image.height();
  return is_inside ? image.at(u, v) : std::uint16_t{0};
}

float clearly_behind(float z, const RidgeLimits& limits) {
  return z + std::max(limits.least_behind, limits.behind_per_square * z * z);
}

/// The definition, pixel by pixel.
bool is_ridge(const Image<std::uint16_t>& image, int u, int v, int reach,
              const RidgeLimits& limits) {
  const int z = pixel_or_none(image, u, v);
  if (z == 0) return false;
  const float far = clearly_behind(static_cast<float>(z), limits);
  const auto is_open = [&](int a, int b) {
    const auto blocks = [&](int other) { return other != 0 && static_cast<float>(other) <= far; };
    return !blocks(a) && !blocks(b) && (a != 0 || b != 0);
  };
  return is_open(pixel_or_none(image, u - reach, v), pixel_or_none(image, u + reach, v)) ||
         is_open(pixel_or_none(image, u, v - reach), pixel_or_none(image, u, v + reach));
}

TEST(Ridges, are_those_of_the_definition_on_every_instruction_set) {
  test::for_each_seed(20, [](test::Random& random) {
    Image<std::uint16_t> image(kRidgeWidth, kRidgeHeight);
    const int most = random.chance(0.5) ? 2000 : 65535;
    for (std::uint16_t& z : image.pixels())
      z = static_cast<std::uint16_t>(random.chance(0.2) ? 0 : random.integer(1, most));
    const RidgeLimits limits{.half_voxel_px = 0.0F,
                             .least_behind = static_cast<float>(random.real(1.0, 400.0)),
                             .behind_per_square = static_cast<float>(random.real(0.0, 1e-3))};
    const int reach = random.integer(2, static_cast<int>(RidgeLimits::kMostReach_px));
    BorderedImage bordered(static_cast<int>(RidgeLimits::kMostReach_px) + RidgeTile::kEdge);
    bordered.take(image);
    const int targets = test::on_every_instruction_set([&](const char* name) {
      int found = 0;
      for (int v = 0; v < kRidgeHeight; v += RidgeTile::kEdge) {
        for (int u = 0; u < kRidgeWidth; u += RidgeTile::kEdge) {
          const RidgeBits rows = find_ridges({&bordered, u, v, reach}, limits);
          for (int i = 0; i < RidgeTile::kEdge * RidgeTile::kEdge; ++i) {
            const int du = i % RidgeTile::kEdge, dv = i / RidgeTile::kEdge;
            const bool is_set = (rows[static_cast<std::size_t>(dv)] >> du & 1) != 0;
            ASSERT_EQ(is_set, is_ridge(image, u + du, v + dv, reach, limits))
                << name << " " << u + du << " " << v + dv << " " << random.repeat();
            found += is_set ? 1 : 0;
          }
        }
      }
      EXPECT_GT(found, 0) << name;
    });
    EXPECT_GE(targets, 1);
  });
}

}  // namespace
}  // namespace swiftlet
