// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/progress.hpp"
#include "swiftlet/config/config_file.hpp"
#include "swiftlet/session/mapping_session.hpp"
#include "swiftlet/source/frame_source.hpp"

namespace swiftlet {

/// How long a flight goes on, and who is told of it. The functions are called by the thread that
/// maps, which they must not hold up; empty ones are not called.
struct FlightOptions {
  std::size_t frames = 0;        ///< of the source, at most; 0 for all
  std::function<bool()> stop{};  ///< asked before each frame and while one is waited for
  ProgressFunction progress{};   ///< in frames
  std::function<void()> look{};  ///< as often as stop(), and after each frame: time for a glance
  std::function<void(const std::vector<RigEvent>&)> tell_events{};  ///< of the devices
  std::function<void()> tell_loss{};  ///< once, when the disk has refused the first block
};

/// Lines of `meta` for a map made of a source with a config (docs/formats/map_file.md).
[[nodiscard]] MapMeta flight_meta(const SourceInfo& info, const MapperConfig& config);

/// Maps frame by frame to the end of the source, the limit, an error or stop(); the summary of the
/// session tells of it. Saves nothing. Errors: those of the source and of the session.
[[nodiscard]] Status fly(FrameSource& source, MappingSession& session,
                         const FlightOptions& options = {});

/// Why a flight has left no map: nothing came, or nothing of it could be used.
[[nodiscard]] Error nothing_mapped(const MappingSummary& summary, const MapperConfig& config);

/// Maps a whole source into a file, or one a world: all that `swiftlet map` does without a screen.
/// What the source knows of its stereo pair holds unless the config says otherwise.
/// Errors: those of fly(), MappingSession::create() and save(); kCorruptInput if nothing could be
/// mapped. A flight that ends with an error is saved as far as it came.
[[nodiscard]] Expected<MappingSummary> map_into_file(FrameSource& source, LoadedConfig config,
                                                     SessionOptions session,
                                                     const FlightOptions& options = {});

}  // namespace swiftlet
