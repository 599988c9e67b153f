// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/report/score_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

namespace swiftlet::app {
namespace {

using eval::Finding;
using eval::ScoreReport;
using eval::ScoreRow;
using eval::Unit;

constexpr std::array<const char*, 6> kUnitNames{"share", "m",          "deg",
                                                "count", "per_minute", "frames"};

std::string value_of(const std::optional<double>& value, Unit unit) {
  if (!value) return "-";
  switch (unit) {
    case Unit::kShare:
      return fmt::format("{:.3f} %", 100.0 * *value);
    case Unit::kMetres:
      return fmt::format("{:.1f} mm", 1e3 * *value);
    case Unit::kDegrees:
      return fmt::format("{:.2f} deg", *value);
    case Unit::kPerMinute:
      return fmt::format("{:.1f} /min", *value);
    case Unit::kCount:
    case Unit::kFrames:
      break;
  }
  return fmt::format("{:.0f}", *value);
}

/// Those that nothing warns of first, in the order of their voxels otherwise.
std::vector<Finding> worst_first(std::vector<Finding> findings) {
  std::stable_partition(findings.begin(), findings.end(),
                        [](const Finding& f) { return !f.is_warned; });
  return findings;
}

std::string findings_text(const std::string& map, const std::vector<Finding>& all, double voxel_m) {
  constexpr std::size_t kShown = 12;
  if (all.empty()) return {};
  std::map<std::string, std::size_t> by_object;
  for (const Finding& f : all) ++by_object[f.what];
  std::string text = fmt::format("\n{}: {} solid voxels called free\n", map, all.size());
  std::size_t shown = 0;
  for (const Finding& f : worst_first(all)) {
    if (shown++ == kShown) break;
    const Eigen::Vector3d p = centre_of(f.voxel, voxel_m);
    text += fmt::format("  ({:6.2f}, {:6.2f}, {:6.2f}) m  {}{}\n", p.x(), p.y(), p.z(), f.what,
                        f.is_warned ? "" : "; no occupied neighbour");
  }
  if (all.size() > kShown)
    text += fmt::format("  and {} more; --json lists all\n", all.size() - kShown);
  return text;
}

std::size_t column_width(const std::string& map) { return std::max(map.size(), std::size_t{14}); }

}  // namespace

std::string score_text(const ScoreReport& report) {
  std::size_t width = 0;
  for (const ScoreRow& row : report.rows) width = std::max(width, row.meaning.name.size());
  std::string text = fmt::format("{}: {} frames, {:.1f} s of flight; voxels of {} m\n",
                                 report.source, report.frames, report.flight_s, report.voxel_m);
  if (!report.intrinsics.empty()) text += fmt::format("intrinsics {}\n", report.intrinsics);
  text += fmt::format("\n{:{}}  better", "", width);
  for (const std::string& map : report.maps) text += fmt::format(" {:>{}}", map, column_width(map));
  text += "\n";
  std::string last;
  for (const ScoreRow& row : report.rows) {
    if (!last.empty() && row.score != last) text += "\n";
    last = row.score;
    text += fmt::format("{:{}}  {:6}", row.meaning.name, width,
                        row.meaning.higher_is_better ? "high" : "low");
    for (std::size_t i = 0; i < row.values.size(); ++i)
      text += fmt::format(" {:>{}}", value_of(row.values[i], row.meaning.unit),
                          column_width(report.maps[i]));
    text += "\n";
  }
  for (std::size_t i = 0; i < report.findings.size(); ++i)
    text += findings_text(report.maps[i], report.findings[i], report.voxel_m);
  return text;
}

nlohmann::ordered_json score_json(const ScoreReport& report) {
  using Json = nlohmann::ordered_json;
  Json rows = Json::array();
  for (const ScoreRow& row : report.rows) {
    Json values = Json::object();
    for (std::size_t i = 0; i < report.maps.size(); ++i)
      values[report.maps[i]] = row.values[i] ? Json(*row.values[i]) : Json(nullptr);
    rows.push_back({{"score", row.score},
                    {"name", row.meaning.name},
                    {"unit", kUnitNames[static_cast<std::size_t>(row.meaning.unit)]},
                    {"higher_is_better", row.meaning.higher_is_better},
                    {"of", row.meaning.of},
                    {"values", std::move(values)}});
  }
  Json free_but_solid = Json::object();
  for (std::size_t i = 0; i < report.findings.size(); ++i) {
    Json voxels = Json::array();
    for (const Finding& f : worst_first(report.findings[i])) {
      const Eigen::Vector3d p = centre_of(f.voxel, report.voxel_m);
      voxels.push_back({{"voxel", {f.voxel.x, f.voxel.y, f.voxel.z}},
                        {"centre_m", {p.x(), p.y(), p.z()}},
                        {"holds", f.what},
                        {"has_occupied_neighbour", f.is_warned}});
    }
    free_but_solid[report.maps[i]] = std::move(voxels);
  }
  return {{"source", report.source},     {"intrinsics", report.intrinsics},
          {"voxel_m", report.voxel_m},   {"frames", report.frames},
          {"flight_s", report.flight_s}, {"maps", report.maps},
          {"scores", std::move(rows)},   {"solid_voxels_called_free", std::move(free_but_solid)}};
}

}  // namespace swiftlet::app
