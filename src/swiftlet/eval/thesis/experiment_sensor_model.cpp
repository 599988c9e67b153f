// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <cmath>

#include "swiftlet/eval/thesis/experiment.hpp"
#include "swiftlet/sensor/inverse_sensor_model.hpp"
#include "swiftlet/sensor/stereo_noise.hpp"

namespace swiftlet::eval {

Expected<ExperimentResult> run_sensor_model(const ProgressFunction& progress);

Expected<ExperimentResult> run_sensor_model(const ProgressFunction& /*progress*/) {
  constexpr StereoNoise kD435{415.2, 0.05};
  const InverseSensorModel model({});
  ExperimentResult result;
  Figure figure{"sensor_model", "Occupancy by a reading, at 1, 2, 4 and 8 m",
                "distance of the voxel behind the reading [m]", "probability of occupied"};
  for (const double z_m : {1.0, 2.0, 4.0, 8.0}) {
    Curve curve{fmt::format("reading at {} m", z_m), {}, false};
    for (double d_m = -1.0; d_m <= 1.0; d_m += 0.005) {
      const double logodds = model.log_odds(d_m, kD435.sigma_m(z_m));
      curve.points.emplace_back(d_m, 1.0 / (1.0 + std::exp(-logodds)));
    }
    figure.curves.push_back(std::move(curve));
  }
  Figure mean{"sensor_mean", "Mean update at a wall, by distance: walls hold while it is positive",
              "distance of the wall [m]", "mean log-odds a reading"};
  double zero_of_small_k_m = 0.0;
  for (const double k : {0.05, 0.2}) {
    const InverseSensorModel with_k({.importance_m = k});
    Curve curve{fmt::format("k = {} m", k), {}, false};
    for (double z_m = 1.0; z_m <= 16.0; z_m += 0.1) {
      const double update = with_k.expected_at_surface(kD435.sigma_m(z_m));
      curve.points.emplace_back(z_m, update);
      if (k < 0.1 && update > 0.0) zero_of_small_k_m = z_m;
    }
    mean.curves.push_back(std::move(curve));
  }
  const double far = model.expected_at_surface(kD435.sigma_m(10.0));
  result.checks = {{"a far wall with the default k", "its mean update is positive at 10 m",
                    fmt::format("{:.2f}", far), far > 0.0},
                   {"a far wall with k = 0.05 m", "dissolves, near 11 m (method 4)",
                    fmt::format("from {:.1f} m on", zero_of_small_k_m),
                    std::abs(zero_of_small_k_m - 11.0) < 1.0}};
  result.figures = {std::move(figure), std::move(mean)};
  return result;
}

}  // namespace swiftlet::eval
