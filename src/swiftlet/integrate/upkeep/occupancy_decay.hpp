// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "swiftlet/base/time.hpp"
#include "swiftlet/integrate/depth_view.hpp"
#include "swiftlet/map/rolling_map.hpp"

namespace swiftlet {

/// Lets go of what has left and of what nothing is seen behind.
///
/// Somebody who walked through the view leaves his voxels occupied. Where a wall stands behind him,
/// readings clear them; where nothing does, the camera reports nothing, and they would stay for
/// ever. So a voxel above unknown loses belief while it is in view and within range, no reading of
/// its image lies at it or before it, and part of its image has none: from surely occupied to
/// unknown in decay_s, and never beyond unknown. What is hidden, out of view or seen keeps its
/// value or is the integrator's.
///
/// Eight steps or more at once, the same for all voxels; what is left is carried on. Time is that
/// of the stamps of each camera; one frame counts for a quarter of decay_s at most, so that no
/// single drop-out clears anything. Real time: allocates only while images grow. The same bits on
/// every machine and on any number of threads: it runs on one.
class OccupancyDecay {
 public:
  /// REQUIRES: decay_s > 0.
  explicit OccupancyDecay(double decay_s) : decay_s_(decay_s) {}

  /// What there is to know of a frame besides its view.
  struct Moment {
    Stamp stamp;
    std::uint8_t camera;
    double sigma_per_z2;  ///< deviation of a reading over the square of its depth [1/m]
    double max_range_m;   ///< beyond it there are no readings
  };

  /// After the integrator. Returns how many voxels lost belief.
  std::size_t apply(const DepthView& view, const Moment& moment, RollingMap& map);

 private:
  struct Clock {
    std::optional<Stamp> last;
    double carried = 0.0;  // steps
  };
  [[nodiscard]] std::int32_t steps_of(const Moment& moment);

  double decay_s_;
  std::array<Clock, 256> clocks_{};  // by camera
};

}  // namespace swiftlet
