// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/report/bench_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "swiftlet/app/report/summary.hpp"

namespace swiftlet::app {
namespace {

using eval::BenchRow;
using eval::Machine;
using eval::ThesisLine;
using eval::ThesisTables;

std::string ratio_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.2f}", *value) : "-";
}

nlohmann::ordered_json json_of(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

std::string line_text(const ThesisLine& line, bool has_rate) {
  const auto time = [&](double ms) {
    if (ms <= 0.0) return fmt::format("{:>12}{}", "", has_rate ? fmt::format("{:>9}", "") : "");
    return fmt::format("{:>12.3f}", ms) + (has_rate ? fmt::format("{:>9.1f}", 1e3 / ms) : "");
  };
  std::string text = fmt::format("  {:<44}", line.what) + time(line.thesis_ms) + time(line.rays_ms);
  if (has_rate) text += time(line.projective_ms);
  while (text.ends_with(' ')) text.pop_back();
  return text + "\n";
}

}  // namespace

std::string machine_text(const Machine& m) {
  std::string text = fmt::format("{}, {} cores; {}, {} build, swiftlet {}\n", m.cpu, m.cores,
                                 m.compiler, m.build_type, m.swiftlet);
  if (m.build_type != "Release" && m.build_type != "RelWithDebInfo") {
    text += "This is no release build: its times say nothing.\n";
  }
  return text;
}

std::string rows_text(std::span<const BenchRow> rows) {
  std::size_t width = 8;
  for (const BenchRow& row : rows) width = std::max(width, row.workload.size());
  std::string text =
      fmt::format("{:{}}  {:>7}  {:<19} {:>7} {:>6} {:>9} {:>9} {:>9} {:>8} {:>9} {:>9} {:>9}\n",
                  "workload", width, "voxel m", "integrator", "threads", "frames", "min ms",
                  "median ms", "p99 ms", "Mpixel/s", "map", "x plain", "x discr.");
  for (const BenchRow& r : rows) {
    text += fmt::format(
        "{:{}}  {:>7}  {:<19} {:>7} {:>6} {:>9.3f} {:>9.3f} {:>9.3f} {:>8.1f} {:>9} {:>9} {:>9}\n",
        r.workload, width, r.voxel_m, r.integrator, r.threads, r.frames, r.min_ms, r.median_ms,
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
         {"voxel_m", r.voxel_m},
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

std::string tables_text(const ThesisTables& tables) {
  std::string text = fmt::format(
      "Table 4.2 of the thesis: function times, {}, voxels of {} m, one thread, median ms\n"
      "  {:<44}{:>12}{:>12}\n",
      tables.workload, eval::kThesisTablesVoxel_m, "", "thesis", "here");
  for (const ThesisLine& line : tables.functions) text += line_text(line, false);
  text += "  (colouring the depth image is left out: the map has no use for it)\n";
  text += fmt::format(
      "Table 4.3 of the thesis: mapping times, median ms and frames a second\n"
      "  {:<44}{:>12}{:>9}{:>12}{:>9}{:>12}{:>9}\n",
      "", "thesis", "fps", "line dr.", "fps", "projective", "fps");
  for (const ThesisLine& line : tables.mapping) text += line_text(line, true);
  text +=
      "  (its conditions with a 2-D or 3-D view are left out: Swiftlet draws no view while it "
      "maps)\n"
      "The thesis's machine was an i7-8550U, its camera 848 x 480 pixels.\n";
  return text;
}

nlohmann::ordered_json tables_json(const ThesisTables& tables) {
  const auto lines = [](const std::vector<ThesisLine>& table) {
    auto array = nlohmann::ordered_json::array();
    for (const ThesisLine& line : table) {
      nlohmann::ordered_json json{
          {"what", line.what}, {"thesis_ms", line.thesis_ms}, {"rays_ms", line.rays_ms}};
      if (line.projective_ms > 0.0) json["projective_ms"] = line.projective_ms;
      array.push_back(std::move(json));
    }
    return array;
  };
  return {{"workload", tables.workload},
          {"voxel_m", eval::kThesisTablesVoxel_m},
          {"functions_4_2", lines(tables.functions)},
          {"mapping_4_3", lines(tables.mapping)}};
}

}  // namespace swiftlet::app
