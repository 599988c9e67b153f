// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "swiftlet/base/progress.hpp"
#include "swiftlet/eval/bench/benchmark_subject.hpp"
#include "swiftlet/eval/score/score_report.hpp"

namespace swiftlet::eval {

/// What is to be judged, and on what.
struct ScoreJob {
  std::string source;             ///< address
  MapperConfig config;            ///< of our maps; voxel size and range of all
  std::vector<std::string> maps;  ///< names of measurement models or integrators, or "octomap"
  std::size_t frames = 600;       ///< evenly over the flight
  ProgressFunction progress{};    ///< told of the frames; may be empty
};

/// A map that takes part. Names are unique.
struct ScoredMap {
  std::string name;                       ///< shown in the report
  std::unique_ptr<BenchmarkSubject> map;  ///< made anew for the job
};

/// The name of OctoMap among the maps of a job.
inline constexpr const char* kOctomap = "octomap";

/// The maps of a job. Errors: kUsage for a name that is neither model nor integrator; kUnsupported
/// for OctoMap if it was not built; those of Mapper::create().
[[nodiscard]] Expected<std::vector<ScoredMap>> make_scored_maps(const ScoreJob& job);

/// Flies a simulated flight and judges the maps by the truth.
/// Errors: those of the source and of make_scored_maps(); kUsage if the truth needs more voxels
/// than memory should hold; kUnsupported without Embree.
[[nodiscard]] Expected<ScoreReport> score_flight(const ScoreJob& job);

/// Maps a recording but for every fifth frame and judges the maps by those.
/// Errors: those of the source and of make_scored_maps(); kCorruptInput for fewer than five frames.
[[nodiscard]] Expected<ScoreReport> score_recording(const ScoreJob& job);

/// The one or the other, by what the source is: by the truth where there is one.
[[nodiscard]] Expected<ScoreReport> score_source(const ScoreJob& job);

}  // namespace swiftlet::eval
