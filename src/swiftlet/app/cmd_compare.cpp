// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/map_reader.hpp"
#include "swiftlet/store/octomap_import.hpp"

namespace swiftlet::app {
namespace {

struct CompareOptions {
  std::string first;
  std::string second;
  bool as_json = false;
};

/// What a map claims: its free and occupied cells; all others are unknown.
struct Claims {
  double voxel_m = 0.0;
  std::unordered_map<VoxelIndex, Occupancy, VoxelHash> cells;

  [[nodiscard]] Occupancy at(const VoxelIndex& voxel) const {
    const auto found = cells.find(voxel);
    return found == cells.end() ? Occupancy::kUnknown : found->second;
  }
};

Expected<Claims> read_octomap_claims(const std::string& path) {
  Claims claims;
  auto summary = read_octomap(path, [&](const OctomapLeaf& leaf) {
    const Occupancy state = leaf.is_occupied ? Occupancy::kOccupied : Occupancy::kFree;
    VoxelIndex v = leaf.first;
    for (v.z = leaf.first.z; v.z < leaf.first.z + leaf.edge; ++v.z) {
      for (v.y = leaf.first.y; v.y < leaf.first.y + leaf.edge; ++v.y) {
        for (v.x = leaf.first.x; v.x < leaf.first.x + leaf.edge; ++v.x) claims.cells[v] = state;
      }
    }
  });
  if (!summary) return forward_error(std::move(summary));
  claims.voxel_m = summary->voxel_m;
  return claims;
}

Expected<Claims> read_claims(const std::string& path) {
  if (path.ends_with(".bt") || path.ends_with(".ot")) return read_octomap_claims(path);
  auto map = read_whole_map(path);
  if (!map) return forward_error(std::move(map));
  Claims claims{map->voxel_m, {}};
  map->for_each_known_cell([&](const VoxelIndex& v, Occupancy state) { claims.cells[v] = state; });
  return claims;
}

/// Cells by what the first map claims (row) and the second (column). Cells unknown to both are not
/// counted.
using Confusion = std::array<std::array<std::size_t, 3>, 3>;

Confusion compare_claims(const Claims& a, const Claims& b) {
  Confusion counts{};
  const auto count = [&](Occupancy in_a, Occupancy in_b) {
    ++counts[static_cast<std::size_t>(in_a)][static_cast<std::size_t>(in_b)];
  };
  for (const auto& [voxel, state] : a.cells) count(state, b.at(voxel));
  for (const auto& [voxel, state] : b.cells) {
    if (!a.cells.contains(voxel)) count(Occupancy::kUnknown, state);
  }
  return counts;
}

constexpr std::array<const char*, 3> kStateNames{"free", "unknown", "occupied"};

void print_text(const Confusion& counts, std::size_t same, std::size_t all) {
  fmt::print("{:>22}{:>12}{:>12}{:>12}\n", "second:", kStateNames[0], kStateNames[1],
             kStateNames[2]);
  for (std::size_t row = 0; row < counts.size(); ++row) {
    fmt::print("{:>10}{:>12}{:>12}{:>12}{:>12}\n", row == 0 ? "first:" : "", kStateNames[row],
               counts[row][0], counts[row][1], counts[row][2]);
  }
  fmt::print("{} of {} cells are the same ({:.2f} %)\n", same, all,
             all == 0 ? 100.0 : 100.0 * static_cast<double>(same) / static_cast<double>(all));
}

Faults compare(const CompareOptions& options) {
  const auto a = read_claims(options.first);
  if (!a) return {a.error()};
  const auto b = read_claims(options.second);
  if (!b) return {b.error()};
  if (std::abs(a->voxel_m - b->voxel_m) > 1e-6 * a->voxel_m) {
    return {{ErrorCode::kUnsupported, options.second,
             fmt::format("its cells are {} m, those of {} are {} m", b->voxel_m, options.first,
                         a->voxel_m),
             "compare maps of one cell size"}};
  }
  const Confusion counts = compare_claims(*a, *b);
  std::size_t same = 0, all = 0;
  for (std::size_t row = 0; row < counts.size(); ++row) {
    same += counts[row][row];
    for (const std::size_t n : counts[row]) all += n;
  }
  if (options.as_json) {
    fmt::print(
        "{}\n",
        nlohmann::ordered_json{{"cells", all}, {"same", same}, {"first_by_second", counts}}.dump(
            2));
  } else {
    print_text(counts, same, all);
  }
  return {};
}

}  // namespace

Action declare_compare(CLI::App& parser) {
  auto o = std::make_shared<CompareOptions>();
  parser.add_option("FIRST", o->first, "map file: .swl, .bt or .ot")->type_name("")->required();
  parser.add_option("SECOND", o->second, "map file: .swl, .bt or .ot")->type_name("")->required();
  parser.add_flag("--json", o->as_json, "one JSON object, for machines");
  parser.footer(
      "Examples:\n"
      "  swiftlet compare flat.swl flat.bt      our map and its export: every cell the same\n"
      "  swiftlet compare monday.swl friday.swl\n"
      "Cells are compared by what they claim: free, unknown or occupied. Cells that are unknown "
      "in\n"
      "both are not counted.");
  return [o] { return compare(*o); };
}

}  // namespace swiftlet::app
