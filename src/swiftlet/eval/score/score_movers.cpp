// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>

#include "swiftlet/eval/score/score.hpp"

namespace swiftlet::eval {

ScoreResult score_movers(const Judged& judged);

namespace {

ScoreValue percentile(std::string name, std::vector<int> frames, double share_of) {
  if (frames.empty()) return {std::move(name), 0.0, Unit::kFrames, false, 0};
  const auto place = static_cast<std::size_t>(share_of * static_cast<double>(frames.size() - 1));
  std::ranges::nth_element(frames, frames.begin() + static_cast<std::ptrdiff_t>(place));
  return {std::move(name), static_cast<double>(frames[place]), Unit::kFrames, false, frames.size()};
}

}  // namespace

/// Frames in which a voxel must be seen until what has come into it is occupied, and until what has
/// gone is free: median and 95th percentile over the voxels that are free in the end, and the share
/// of all that was not free in time (see Reactions).
ScoreResult score_movers(const Judged& judged) {
  static_assert(Reactions::kFreedWithin == 10);
  if (judged.reactions == nullptr) return {};
  const Reactions& r = *judged.reactions;
  const std::size_t came = r.until_occupied().size() + r.missed();
  return {{percentile("what comes is occupied after, median", r.until_occupied(), 0.5),
           percentile("what comes is occupied after, 95 %", r.until_occupied(), 0.95),
           share("what comes and is never occupied", r.missed(), came, false),
           percentile("what has gone is free after, median", r.until_free(), 0.5),
           percentile("what has gone is free after, 95 %", r.until_free(), 0.95),
           share("what has gone and is not free after 10 frames", r.not_freed(),
                 r.freed() + r.not_freed(), false),
           {"ghost voxels at the end", static_cast<double>(r.ghosts()), Unit::kCount, false, came}},
          {}};
}

}  // namespace swiftlet::eval
