// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The projective integrator against rays on a simulated flight through the apartment.

#include "support/agreement.hpp"

#include <gtest/gtest.h>

#include "swiftlet/source/sources.hpp"

namespace swiftlet {
namespace {

void check_apartment(double voxel_m, int frames) {
  auto source = open_source("sim:apartment");
  ASSERT_TRUE(source);
  test::AgreementCheck check(voxel_m, {14, 12, 4}, {5, 4, 1}, 10.0);
  for (int i = 0; i < frames; ++i) {
    for (int skipped = 0; skipped < 1; ++skipped) ASSERT_TRUE((*source)->next());
    const auto frame = (*source)->next();
    ASSERT_TRUE(frame && *frame);
    check.add(**frame);
  }
  const test::Agreement agreement = check.result();
  testing::Test::RecordProperty("agreement", agreement.text());
  test::expect_agreement(agreement);
}

TEST(Apartment, agrees_with_rays_in_voxels_of_20_cm) { check_apartment(0.2, 30); }
TEST(Apartment, agrees_with_rays_in_voxels_of_10_cm) { check_apartment(0.1, 30); }
TEST(Apartment, agrees_with_rays_in_voxels_of_5_cm) { check_apartment(0.05, 20); }

}  // namespace
}  // namespace swiftlet
