// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

namespace swiftlet {

/// What one depth reading says about a voxel that its ray crosses, weighted by its precision
/// (method 6).
///
/// The ray enters the voxel at depth z_in and leaves it at z_out: that is its intersection with the
/// voxel. A reading before the middle of it says that most of it lies in matter, one behind it that
/// most of it is empty. How loudly, is the log of a likelihood ratio: of a surface half a voxel
/// before the middle to one half a voxel behind it, c (z_mid - z) / sigma^2. So the sum over
/// readings asks on which side of the middle their mean lies, weighted by precision: many blurred
/// readings do not outvote a sharp one. A ray counts by the length of its intersection; all rays
/// through a voxel together give it one observation.
///
/// Three things are not the ratio's. A reading well before the voxel says nothing: the voxel is
/// hidden. One far behind it speaks twice as loud, as no pose is that much off: so what has left is
/// cleared soon. And a voxel in which rays end, be it behind its middle, holds some matter: it may
/// become unknown, but not free.
class PrecisionWeightedModel {
 public:
  /// The noise of neighbouring readings is not independent: the ratio counts for less.
  static constexpr float kIndependence = 0.7F;
  /// A reading so many voxels before the voxel, and kFadeSigma before that, hides it.
  static constexpr float kHidingVoxels = 0.65F, kFadeSigma = 1.0F;
  /// No reading says more: a twentieth of a voxel's rays that hit outweighs the others.
  static constexpr float kMostLogOdds = 20.0F;
  /// A reading so many voxels, and so many of its deviations, behind a voxel counts kClearGain
  /// times.
  static constexpr float kClearVoxels = 3.0F, kClearSigma = 4.0F, kClearGain = 2.0F;
  /// A reading up to so many voxels behind a voxel may have ended in it: poses are off by some
  /// centimetres.
  static constexpr float kEndVoxels = 0.15F;
  /// Of the rays that reach a voxel, the share that must end in it so that it is not called free.
  static constexpr float kLeastEnds = 0.2F;

  /// `free_log_odds` (negative) is the least that a reading says that is not far behind the voxel.
  PrecisionWeightedModel(double voxel_m, double free_log_odds)
      : voxel_m_(voxel_m), free_log_odds_(free_log_odds) {}

  struct Evidence {
    double log_odds = 0.0;  ///< for an intersection of a voxel's length
    /// 1 - kLeastEnds for a ray that ends in the voxel, -kLeastEnds for one that passes it, 0 for
    /// one that does not reach it. If the rays of a frame add up to more than 0, the frame does not
    /// call the voxel free.
    double ends = 0.0;
  };
  /// Of a reading at depth z_m with deviation sigma_m [m]. REQUIRES: z_in_m <= z_out_m, sigma > 0.
  [[nodiscard]] Evidence evaluate(double z_in_m, double z_out_m, double z_m, double sigma_m) const;

 private:
  double voxel_m_;
  double free_log_odds_;
};

}  // namespace swiftlet
