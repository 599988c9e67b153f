// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "swiftlet/eval/bench/bench_workload.hpp"
#include "swiftlet/eval/bench/benchmark_subject.hpp"
#include "swiftlet/session/latency.hpp"

namespace swiftlet::eval {

/// A subject in a race, and how it did.
struct TimedSubject {
  std::string name;
  int threads = 1;
  std::size_t every = 1;  ///< fuses every so manieth frame: a slow one would hold up the others
  std::unique_ptr<BenchmarkSubject> subject;
  Latency latency{};  ///< of the measured frames
};

/// How rarely a subject that is about `factor` times too slow for every frame runs, so that it
/// still sees at least five of the measured ones, spread over the flight.
[[nodiscard]] std::size_t every_nth(std::size_t factor, const Workload& workload);

/// Lets every runner fuse the frames of the workload, interleaved: all of them fuse a frame before
/// the next one's turn, so that a slow moment of the machine hits all alike. Each gets a fresh copy
/// of the image, in the cache as from a camera's driver.
void race(const Workload& workload, std::vector<TimedSubject>& timed,
          const ProgressFunction& progress = {});

}  // namespace swiftlet::eval
