// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/bench/bench_race.hpp"

#include <algorithm>

#include "swiftlet/base/progress.hpp"

namespace swiftlet::eval {

std::size_t every_nth(std::size_t factor, const Workload& workload) {
  constexpr std::size_t kFewest = 5;
  const std::size_t measured = workload.frames.size() - workload.warm_up;
  return std::clamp<std::size_t>(measured / kFewest, 1, factor);
}

void race(const Workload& workload, std::vector<TimedSubject>& timed,
          const ProgressFunction& progress) {
  std::size_t turns = 0;
  for (const TimedSubject& r : timed) turns += (workload.frames.size() + r.every - 1) / r.every;
  const ProgressTeller shown(progress, turns);
  std::size_t done = 0;
  Frame arrived = workload.frames.front();
  for (std::size_t i = 0; i < workload.frames.size(); ++i) {
    for (TimedSubject& runner : timed) {
      if (i % runner.every != 0) continue;
      arrived = workload.frames[i];
      const auto times = runner.subject->fuse(arrived);
      if (times && i >= workload.warm_up) runner.latency.add(*times);
      shown.update(++done);
    }
  }
}

}  // namespace swiftlet::eval
