// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/bench/bench_rows.hpp"

#include <algorithm>
#include <fstream>
#include <string_view>
#include <thread>

namespace swiftlet::eval {
namespace {

/// From /proc/cpuinfo, where the kernel names it: arm64 does not.
std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

double in_ms(Nanoseconds t) { return 1e3 * seconds(t); }

std::optional<double> median_of(const std::vector<BenchRow>& rows, std::string_view integrator) {
  const auto found = std::ranges::find(rows, integrator, &BenchRow::integrator);
  if (found == rows.end() || found->frames == 0) return std::nullopt;
  return found->median_ms;
}

std::optional<double> ratio(std::optional<double> of_ms, double ms) {
  if (!of_ms || ms <= 0.0) return std::nullopt;
  return *of_ms / ms;
}

}  // namespace

Machine this_machine() {
#if defined(__clang__)
  const char* const name = "";  // __VERSION__ says it
#else
  const char* const name = "GCC ";
#endif
  return {cpu_name(), std::thread::hardware_concurrency(), std::string(name) + __VERSION__,
          SWIFTLET_BUILD_TYPE, SWIFTLET_VERSION};
}

std::vector<BenchRow> rows_of(const Workload& workload, double voxel_m,
                              const std::vector<TimedSubject>& timed, const std::string& suffix) {
  const auto pixels = static_cast<double>(workload.frames.front().depth.raw.pixels().size());
  std::vector<BenchRow> rows;
  for (const TimedSubject& r : timed) {
    const auto at = [&](double share) { return in_ms(r.latency.frame_percentile(share)); };
    constexpr double kLeast = 1e-9;  // of any number of frames that is the first
    const double median_ms = at(0.5);
    const double mpixel_s = median_ms > 0.0 ? 1e-3 * pixels / median_ms : 0.0;
    rows.push_back({workload.name + suffix, voxel_m, r.name, r.threads, r.latency.frame_count(),
                    at(kLeast), median_ms, at(0.99), mpixel_s, r.subject->map_bytes(), std::nullopt,
                    std::nullopt});
  }
  const auto plain_ms = median_of(rows, kOctomapPlain);
  const auto discretised_ms = median_of(rows, kOctomapDiscretised);
  for (BenchRow& row : rows) {
    row.speedup_vs_octomap_plain = ratio(plain_ms, row.median_ms);
    row.speedup_vs_octomap_discretised = ratio(discretised_ms, row.median_ms);
  }
  return rows;
}

}  // namespace swiftlet::eval
