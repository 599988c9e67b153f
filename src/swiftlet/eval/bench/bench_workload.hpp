// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "swiftlet/base/progress.hpp"
#include "swiftlet/source/frame_source.hpp"

namespace swiftlet::eval {

/// How much of a source a benchmark holds in memory.
struct WorkloadOptions {
  std::size_t frames = 120;  ///< measured
  std::size_t warm_up = 20;  ///< fused before them, not measured
  std::optional<double>
      max_range_m;  ///< default: 10 m for the simulated rig (a D435), 5 m for recordings
  ProgressFunction progress{};
};

/// Frames of one source, in order, in memory, so that reading them costs nothing while times are
/// taken.
struct Workload {
  std::string name;
  std::string intrinsics{};  ///< where those of the cameras came from
  std::vector<Frame> frames;
  std::size_t warm_up = 0;    ///< the first of the frames, not measured
  std::size_t available = 0;  ///< frames of the whole flight
  double baseline_m = 0.0;
  double max_range_m = 0.0;
};

/// Reads frames spread evenly over the flight, so that all of it is seen; a source of unknown
/// length gives its first ones. Frames without a reading in range are left out. Of a flight that is
/// too short for both, at most a fifth warms up.
/// Errors: those of the source; kCorruptInput if no frame can be measured.
[[nodiscard]] Expected<Workload> read_workload(FrameSource& source, const WorkloadOptions& options);

/// Images that a source has been through, those that it could not deliver included.
[[nodiscard]] std::size_t images_seen(const FrameTally& tally);

/// Whether image `number` of a flight of `available` is the next one of `wanted` that lie evenly
/// over it, when `held` of them have been taken. The j-th is number j * available / wanted; one
/// that is missing there is made up for by the next.
[[nodiscard]] bool is_due(std::size_t number, std::size_t held, std::size_t wanted,
                          std::size_t available);

/// The range that a source is measured with.
[[nodiscard]] double range_of(const std::string& address, const WorkloadOptions& options);

/// "sim:apartment: 140 of 1801 frames, spread evenly over the flight, 20 of them warm up; ..."
[[nodiscard]] std::string workload_text(const Workload& workload);

}  // namespace swiftlet::eval
