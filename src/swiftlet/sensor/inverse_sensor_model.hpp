// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

namespace swiftlet {

/// What one depth reading says about the voxels along its ray, as log-odds (method 4, eq. 3.3
/// and 3.4):
///
///   p_base = p_min in front of the reading, 0.5 behind it
///   p      = min(p_max, p_base + (k / (sigma sqrt(2 pi)) + 0.5 - p_base) exp(-d^2 / (2 sigma^2)))
///   L      = ln(p / (1 - p)), and 0 beyond 3 sigma behind the reading
///
/// with d the depth of the voxel minus the depth that was read. k / (sigma sqrt(2 pi)) is about the
/// chance that the surface lies within a slice of thickness k, so k = voxel size is the natural
/// choice.
class InverseSensorModel {
 public:
  struct Options {
    double importance_m = 0.2;  ///< k
    double p_min = 0.3;
    double p_max = 0.97;
    friend bool operator==(const Options&, const Options&) = default;
  };
  /// Behind the reading by more than this many sigma there is no evidence.
  static constexpr double kBandSigma = 3.0;
  /// In front of the reading by more than this many sigma the evidence is free_log_odds(): there
  /// exp(-d^2 / (2 sigma^2)) is below 1e-13, so eq. 3.3 is p_min to more digits than a voxel can
  /// hold.
  static constexpr double kClearlyInFrontSigma = 8.0;

  /// REQUIRES: importance_m > 0, 0 < p_min < 0.5 < p_max < 1.
  explicit InverseSensorModel(const Options& options);

  [[nodiscard]] const Options& options() const { return options_; }

  /// Log-odds of a voxel d metres behind (positive) or in front of (negative) a reading of
  /// deviation sigma [m].
  [[nodiscard]] double log_odds(double d_m, double sigma_m) const;

  /// Log-odds far in front of every reading: ln(p_min / (1 - p_min)).
  [[nodiscard]] double free_log_odds() const { return free_log_odds_; }

  /// Mean of log_odds() at the true surface, over readings that scatter by sigma around it. While
  /// it is positive, a wall that is seen long enough becomes occupied; where it is negative, the
  /// wall dissolves.
  [[nodiscard]] double expected_at_surface(double sigma_m) const;

 private:
  Options options_;
  double free_log_odds_;
};

}  // namespace swiftlet
