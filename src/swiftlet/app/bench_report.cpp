// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/bench_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "swiftlet/app/summary.hpp"

namespace swiftlet::app {
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

std::string ratio_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.2f}", *value) : "-";
}

nlohmann::ordered_json json_of(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
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

std::string machine_text(const Machine& m) {
  std::string text = fmt::format("{}, {} cores; {}, {} build, swiftlet {}\n", m.cpu, m.cores,
                                 m.compiler, m.build_type, m.swiftlet);
  if (m.build_type != "Release" && m.build_type != "RelWithDebInfo") {
    text += "This is no release build: its times say nothing.\n";
  }
  return text;
}

std::vector<BenchRow> rows_of(const Workload& workload, double cell_m,
                              const std::vector<Runner>& runners, const std::string& suffix) {
  const auto pixels = static_cast<double>(workload.frames.front().depth.raw.pixels().size());
  std::vector<BenchRow> rows;
  for (const Runner& r : runners) {
    const auto at = [&](double share) { return in_ms(r.latency.frame_percentile(share)); };
    constexpr double kLeast = 1e-9;  // of any number of frames that is the first
    const double median_ms = at(0.5);
    const double mpixel_s = median_ms > 0.0 ? 1e-3 * pixels / median_ms : 0.0;
    rows.push_back({workload.name + suffix, cell_m, r.name, r.threads, r.latency.frame_count(),
                    at(kLeast), median_ms, at(0.99), mpixel_s, r.contender->map_bytes(),
                    std::nullopt, std::nullopt});
  }
  const auto plain_ms = median_of(rows, kOctomapPlain);
  const auto discretised_ms = median_of(rows, kOctomapDiscretised);
  for (BenchRow& row : rows) {
    row.speedup_vs_octomap_plain = ratio(plain_ms, row.median_ms);
    row.speedup_vs_octomap_discretised = ratio(discretised_ms, row.median_ms);
  }
  return rows;
}

std::string rows_text(std::span<const BenchRow> rows) {
  std::size_t width = 8;
  for (const BenchRow& row : rows) width = std::max(width, row.workload.size());
  std::string text =
      fmt::format("{:{}}  {:>6}  {:<19} {:>7} {:>6} {:>9} {:>9} {:>9} {:>8} {:>9} {:>9} {:>9}\n",
                  "workload", width, "cell m", "integrator", "threads", "frames", "min ms",
                  "median ms", "p99 ms", "Mpixel/s", "map", "x plain", "x discr.");
  for (const BenchRow& r : rows) {
    text += fmt::format(
        "{:{}}  {:>6}  {:<19} {:>7} {:>6} {:>9.3f} {:>9.3f} {:>9.3f} {:>8.1f} {:>9} {:>9} {:>9}\n",
        r.workload, width, r.cell_m, r.integrator, r.threads, r.frames, r.min_ms, r.median_ms,
        r.p99_ms, r.mpixel_s, size_text(r.map_bytes), ratio_text(r.speedup_vs_octomap_plain),
        ratio_text(r.speedup_vs_octomap_discretised));
  }
  return text;
}

nlohmann::ordered_json rows_json(const Machine& m, std::span<const BenchRow> rows) {
  nlohmann::ordered_json json{{"machine",
                               {{"cpu", m.cpu},
                                {"cores", m.cores},
                                {"compiler", m.compiler},
                                {"build_type", m.build_type},
                                {"swiftlet_version", m.swiftlet}}},
                              {"rows", nlohmann::ordered_json::array()}};
  for (const BenchRow& r : rows) {
    json["rows"].push_back(
        {{"workload", r.workload},
         {"cell_m", r.cell_m},
         {"integrator", r.integrator},
         {"threads", r.threads},
         {"frames", r.frames},
         {"min_ms", r.min_ms},
         {"median_ms", r.median_ms},
         {"p99_ms", r.p99_ms},
         {"mpixel_s", r.mpixel_s},
         {"map_bytes", r.map_bytes},
         {"speedup_vs_octomap_plain", json_of(r.speedup_vs_octomap_plain)},
         {"speedup_vs_octomap_discretised", json_of(r.speedup_vs_octomap_discretised)}});
  }
  return json;
}

}  // namespace swiftlet::app
