// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/bench/bench_workload.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "swiftlet/base/progress.hpp"

namespace swiftlet::eval {
namespace {

constexpr double kSimulatedRange_m = 10.0;
constexpr double kRecordedRange_m = 5.0;
constexpr double kD435Baseline_m = 0.05;

bool has_reading(const DepthImage& depth, double max_range_m) {
  return std::ranges::any_of(depth.raw.pixels(), [&](std::uint16_t raw) {
    return raw != 0 && double{depth.unit_m} * raw <= max_range_m;
  });
}

}  // namespace

std::size_t images_seen(const FrameTally& tally) {
  return std::accumulate(tally.lost.begin(), tally.lost.end(), tally.delivered);
}

bool is_due(std::size_t number, std::size_t held, std::size_t wanted, std::size_t available) {
  return held < wanted && held * available <= number * wanted;
}

double range_of(const std::string& address, const WorkloadOptions& options) {
  const bool is_simulated = address.starts_with("sim:");
  return options.max_range_m.value_or(is_simulated ? kSimulatedRange_m : kRecordedRange_m);
}

Expected<Workload> read_workload(FrameSource& source, const WorkloadOptions& options) {
  const SourceInfo& info = source.info();
  Workload made{.name = info.uri,
                .intrinsics = text_of(info.intrinsics),
                .frames = {},
                .baseline_m = info.baseline_m.value_or(kD435Baseline_m),
                .max_range_m = range_of(info.uri, options)};
  const std::size_t most = options.frames + options.warm_up;
  const std::size_t wanted = info.frame_count ? std::min(*info.frame_count, most) : most;
  made.available = info.frame_count.value_or(wanted);
  const ProgressTeller shown(options.progress, info.frame_count);
  while (made.frames.size() < wanted) {
    auto frame = source.next();
    if (!frame) return forward_error(std::move(frame));
    if (!*frame) break;
    const std::size_t seen = images_seen(source.tally());
    shown.update(seen);
    if (!is_due(seen - 1, made.frames.size(), wanted, made.available)) continue;
    if (has_reading((*frame)->depth, made.max_range_m)) made.frames.push_back(std::move(**frame));
  }
  made.warm_up = options.warm_up;
  if (made.frames.size() < most) made.warm_up = std::min(made.warm_up, made.frames.size() / 5);
  if (!made.frames.empty()) return made;
  return fail(
      ErrorCode::kCorruptInput, made.name, "there is no frame to measure",
      fmt::format("check its poses and that it has depth readings up to {} m", made.max_range_m));
}

std::string workload_text(const Workload& w) {
  const DepthImage& depth = w.frames.front().depth;
  return fmt::format(
      "{}: {} of {} frames, spread evenly over the flight, the first {} to warm up; {} x {} "
      "pixels, range {} m; intrinsics {}\n",
      w.name, w.frames.size(), w.available, w.warm_up, depth.raw.width(), depth.raw.height(),
      w.max_range_m, w.intrinsics);
}

}  // namespace swiftlet::eval
