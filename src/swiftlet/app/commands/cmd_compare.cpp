// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/commands/shared_flags.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/eval/score/cube_claims.hpp"
#include "swiftlet/file/file_kind.hpp"
#include "swiftlet/query/known_voxels.hpp"
#include "swiftlet/store/export/octomap_import.hpp"

namespace swiftlet::app {
namespace {

struct CompareOptions {
  std::string first;
  std::string second;
  bool as_json = false;
  bool is_salvaged = false;
};

Expected<eval::CubeClaims> read_octomap_claims(const std::string& path) {
  eval::CubeClaims claims(0.0);
  auto summary = read_octomap(path, [&](const OctomapLeaf& leaf) {
    claims.add(leaf.first, leaf.edge, leaf.is_occupied ? Occupancy::kOccupied : Occupancy::kFree);
  });
  if (!summary) return forward_error(std::move(summary));
  claims.set_voxel_m(summary->voxel_m);
  return claims;
}

Expected<eval::CubeClaims> read_claims(const std::string& path, bool is_salvaged) {
  auto facts = look_at_file(path);
  if (!facts) return forward_error(std::move(facts));
  if (facts->kind == FileKind::kOctomap) return read_octomap_claims(path);
  auto map = read_and_tell(path, is_salvaged);
  if (!map) return forward_error(std::move(map));
  eval::CubeClaims claims(map->voxel_m());
  for_each_known_voxel(*map, [&](const VoxelIndex& v, QuantizedLogOdds, Occupancy state) {
    claims.add(v, 1, state);
  });
  return claims;
}

constexpr std::array<const char*, 3> kStateNames{"free", "unknown", "occupied"};

void print_text(const eval::CubeClaims::Confusion& counts, std::uint64_t same, std::uint64_t all) {
  fmt::print("{:>22}{:>12}{:>12}{:>12}\n", "second:", kStateNames[0], kStateNames[1],
             kStateNames[2]);
  for (std::size_t row = 0; row < counts.size(); ++row) {
    fmt::print("{:>10}{:>12}{:>12}{:>12}{:>12}\n", row == 0 ? "first:" : "", kStateNames[row],
               counts[row][0], counts[row][1], counts[row][2]);
  }
  fmt::print("{} of {} voxels are the same ({:.2f} %)\n", same, all,
             all == 0 ? 100.0 : 100.0 * static_cast<double>(same) / static_cast<double>(all));
}

Faults compare(const CompareOptions& options) {
  const auto a = read_claims(options.first, options.is_salvaged);
  if (!a) return {a.error()};
  const auto b = read_claims(options.second, options.is_salvaged);
  if (!b) return {b.error()};
  if (std::abs(a->voxel_m() - b->voxel_m()) > 1e-6 * a->voxel_m()) {
    return {{ErrorCode::kUnsupported, options.second,
             fmt::format("its voxels are {} m, those of {} are {} m", b->voxel_m(), options.first,
                         a->voxel_m()),
             "compare maps of one voxel size"}};
  }
  const eval::CubeClaims::Confusion counts = eval::compare_claims(*a, *b);
  std::uint64_t same = 0, all = 0;
  for (std::size_t row = 0; row < counts.size(); ++row) {
    same += counts[row][row];
    for (const std::uint64_t n : counts[row]) all += n;
  }
  if (options.as_json) {
    fmt::print("{}\n", json_text({{"voxels", all}, {"same", same}, {"first_by_second", counts}}));
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
  declare_salvage(parser, o->is_salvaged);
  parser.footer(
      "Examples:\n"
      "  swiftlet compare flat.swl flat.bt      our map and its export: every voxel the same\n"
      "  swiftlet compare monday.swl friday.swl\n"
      "Voxels are compared by what they claim: free, unknown or occupied. Voxels that are unknown "
      "in\n"
      "both are not counted.");
  return [o] { return compare(*o); };
}

}  // namespace swiftlet::app
