// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/score/score_job.hpp"

#include <algorithm>
#include <utility>

#include "swiftlet/integrate/measurement_models.hpp"

namespace swiftlet::eval {
namespace {

Expected<std::unique_ptr<BenchmarkSubject>> make_scored_map(const ScoreJob& job,
                                                            const std::string& name) {
  if (name != kOctomap) {
    MapperConfig config = job.config;
    const bool is_model = find_measurement_model(name).has_value();
    (is_model ? config.integrate.model : config.integrate.integrator) = name;
    return make_mapper_subject(config, true);
  }
  constexpr bool kIsDiscretised = false;
  auto made = make_octomap_subject(job.config, kIsDiscretised);
  if (made) return made;
  return fail(ErrorCode::kUnsupported, kOctomap, "this build of Swiftlet has no OctoMap",
              "configure with -DSWIFTLET_WITH_OCTOMAP=ON, or leave it out of --maps");
}

}  // namespace

Expected<std::vector<ScoredMap>> make_scored_maps(const ScoreJob& job) {
  std::vector<ScoredMap> scored_maps;
  for (const std::string& name : job.maps) {
    if (std::ranges::find(scored_maps, name, &ScoredMap::name) != scored_maps.end()) continue;
    auto map = make_scored_map(job, name);
    if (!map) return forward_error(std::move(map));
    scored_maps.push_back({name, std::move(*map)});
  }
  return scored_maps;
}

Expected<ScoreReport> score_source(const ScoreJob& job) {
  return job.source.starts_with("sim:") ? score_flight(job) : score_recording(job);
}

}  // namespace swiftlet::eval
