// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/query/voxel_counts.hpp"
#include "swiftlet/session/latency.hpp"
#include "swiftlet/source/frame_source.hpp"

namespace swiftlet {

/// A map file that a run has written.
struct SavedFile {
  std::string path;          ///< of the file
  std::uintmax_t bytes = 0;  ///< 0 if the system does not tell
  std::size_t blocks = 0;    ///< that it holds
  std::uint64_t frames = 0;  ///< that it has seen
  VoxelCounts voxels;        ///< of its blocks
};

/// What a mapping run did.
struct MappingSummary {
  std::string source;         ///< address
  IntrinsicsNote intrinsics;  ///< where those of its cameras came from
  std::string depth_doubt;    ///< why its unit of depth looks wrong; empty: it does not
  FrameTally source_tally;    ///< frames that never came out of the source
  /// Frames by what became of them.
  std::array<std::size_t, kFrameVerdictNames.size()> verdicts{};
  double elapsed_s = 0.0;           ///< of the whole flight
  Latency latency;                  ///< of the integrated frames
  std::size_t late_frames = 0;      ///< of which max_frame_ms left far blocks out
  std::size_t blocks_left = 0;      ///< of all these frames together
  std::size_t blocks_evicted = 0;   ///< blocks that left the window
  std::size_t blocks_restored = 0;  ///< blocks that came back into it
  std::size_t memory_bytes = 0;     ///< window and scratch
  std::size_t restarts = 0;         ///< times the poses lost their place, and a new map began
  bool was_interrupted = false;     ///< the user stopped it
  std::vector<std::string> notes;   ///< of the source; see source_notes()
  std::uint64_t blocks_lost = 0;    ///< of the map, since the disk refused them
  std::vector<SavedFile> files;     ///< one a world; none until the map is saved

  /// Frames that are in the map.
  [[nodiscard]] std::size_t integrated() const { return verdicts[0]; }
  /// Frames that did not reach the map, by reason; reasons that did not occur are left out.
  [[nodiscard]] std::map<std::string, std::size_t> dropped() const;
};

}  // namespace swiftlet
