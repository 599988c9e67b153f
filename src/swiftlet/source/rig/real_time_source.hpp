// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>

#include "swiftlet/source/frame_source.hpp"

namespace swiftlet {

/// How frames wait for a mapper that is busy, live or played in real time.
struct QueuePolicy {
  std::size_t capacity = 2;  ///< the oldest waiting frame makes room for a newer one (counted)
  double speed = 1.0;        ///< of the recording's own time
};

/// Plays a source at the speed it was recorded with, as a live rig would deliver it: a thread of
/// its own takes frames when their time has come and puts them into a short queue; when the mapper
/// is late, the oldest frame in it is lost as kOverload. What is lost depends on the machine;
/// without this, every frame is used and the map has the same bits each time.
///
/// `source` is used by that thread alone from now on. Memory: `capacity` frames.
/// REQUIRES: capacity >= 1, speed > 0.
[[nodiscard]] FrameSourcePtr play_in_real_time(FrameSourcePtr source,
                                               const QueuePolicy& policy = {});

}  // namespace swiftlet
