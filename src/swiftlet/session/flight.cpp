// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/session/flight.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <utility>

#include "swiftlet/session/depth_doubt.hpp"
#include "swiftlet/session/source_notes.hpp"

namespace swiftlet {
namespace {

bool is_asked_to_stop(const FlightOptions& options) { return options.stop && options.stop(); }

void look(const FlightOptions& options) {
  if (options.look) options.look();
}

/// How many frames there will be, if anybody knows.
std::optional<std::size_t> expected_frames(const FrameSource& source,
                                           const FlightOptions& options) {
  if (options.frames > 0) return options.frames;
  return source.info().frame_count;
}

}  // namespace

MapMeta flight_meta(const SourceInfo& info, const MapperConfig& config) {
  return {{"config", config_to_yaml(config)},
          {"source", info.uri},
          {"native_up_axis", info.native_up_axis},
          {"intrinsics", text_of(info.intrinsics)},
          {"program_version", SWIFTLET_VERSION},
          {"logodds_per_step", fmt::format("{}", config.integrate.logodds_per_step)},
          {"created", fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)))}};
}

Status fly(FrameSource& source, MappingSession& session, const FlightOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const ProgressTeller progress(options.progress, expected_frames(source, options));
  source.stop_when([&] {
    look(options);  // frames may stay away for long
    return is_asked_to_stop(options);
  });
  MappingSummary& summary = session.summary();
  summary.source = source.info().uri;
  summary.intrinsics = source.info().intrinsics;
  DepthDoubt doubt(source.info().assumed_depth_unit_m);
  Status outcome = Done{};
  bool is_loss_told = false;
  for (std::size_t done = 0; options.frames == 0 || done < options.frames;) {
    summary.was_interrupted = is_asked_to_stop(options);
    if (summary.was_interrupted) break;
    auto frame = source.next();
    if (const auto events = source.take_events(); options.tell_events) options.tell_events(events);
    if (!frame) {
      outcome = forward_error(std::move(frame));
      break;
    }
    if (!*frame) {
      summary.was_interrupted = is_asked_to_stop(options);
      break;
    }
    look(options);
    doubt.note((*frame)->depth);
    outcome = session.integrate(**frame);
    if (!outcome) break;
    if (summary.blocks_lost > 0 && !std::exchange(is_loss_told, true) && options.tell_loss)
      options.tell_loss();
    progress.update(++done);
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  summary.elapsed_s = took.count();
  summary.source_tally = source.tally();
  summary.notes = source_notes(source);
  summary.depth_doubt = doubt.text();
  look(options);
  return outcome;
}

Error nothing_mapped(const MappingSummary& summary, const MapperConfig& config) {
  if (summary.was_interrupted)
    return {ErrorCode::kNotFound, summary.source, "interrupted before anything was mapped", {}};
  std::string reasons;
  const bool is_far = summary.verdicts[static_cast<std::size_t>(FrameVerdict::kPoseOutOfRange)] > 0;
  for (const auto& [reason, count] : summary.dropped())
    reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", count, reason);
  return {ErrorCode::kCorruptInput, summary.source,
          fmt::format("no frame could be mapped ({})", reasons.empty() ? "there is none" : reasons),
          is_far
              ? fmt::format("maps end {} km from the origin: take an offset away from the poses, "
                            "as of UTM coordinates",
                            RollingMap::kMaxCoordinate_m * 1e-3)
              : fmt::format("check its poses and that it has depth readings from {} to {} m",
                            config.depth.min_range_m, config.depth.max_range_m)};
}

Expected<MappingSummary> map_into_file(FrameSource& source, LoadedConfig config, SessionOptions how,
                                       const FlightOptions& options) {
  const SourceInfo& info = source.info();
  adopt_baseline(info.baseline_m, config);
  if (how.meta.empty()) how.meta = flight_meta(info, config.mapper);
  auto session = MappingSession::create(config.mapper, how);
  if (!session) return forward_error(std::move(session));
  Status flown = fly(source, **session, options);
  if (!(*session)->has_map()) {
    if (!flown) return forward_error(std::move(flown));
    return tl::make_unexpected(nothing_mapped((*session)->summary(), config.mapper));
  }
  if (auto saved = (*session)->save(); !saved) return forward_error(std::move(saved));
  if (!flown) return forward_error(std::move(flown));
  return (*session)->summary();
}

}  // namespace swiftlet
