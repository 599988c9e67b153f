// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/commands/shared_flags.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/file/output_file.hpp"
#include "swiftlet/map/map_window.hpp"
#include "swiftlet/plan/plan_path.hpp"
#include "swiftlet/render/projection.hpp"

namespace swiftlet::app {
namespace {

struct PlanCommand {
  std::string map;
  std::optional<Eigen::Vector3d> from, to;
  double radius_m = 0.25;
  PlanOptions how;
  std::string unknown = "stops";
  bool is_best = false;
  std::string out;
  std::string projection = "slice";
  bool as_json = false;
  bool is_salvaged = false;
};

std::array<double, 3> numbers(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

void print_json(const PlannedPath& path) {
  std::vector<std::array<double, 3>> points;
  for (const Eigen::Vector3d& p : path.points) points.push_back(numbers(p));
  fmt::print("{}\n", json_text({{"length_m", path.length_m},
                                {"clearance_m", path.tightest.at_least_m},
                                {"clearance_at_m", path.tightest.path_m},
                                {"points", points}}));
}

void print_text(const PlannedPath& path, double voxel_m) {
  fmt::print("{:.2f} m in {} points\n", path.length_m, path.points.size());
  if (const auto& nearest = path.tightest.voxel) {
    const Eigen::Vector3d at = centre_of(*nearest, voxel_m);
    fmt::print("tightest after {:.2f} m: {:.2f} m to the voxel at {:.2f},{:.2f},{:.2f}\n",
               path.tightest.path_m, path.tightest.at_least_m, at.x(), at.y(), at.z());
  } else {
    fmt::print("nowhere nearer than {:.2f} m to anything\n", path.tightest.at_least_m);
  }
}

/// At the height of the goal, where a slice tells what is in the way.
Status draw(const PlanCommand& command, const BlockMap& map, const PlannedPath& path) {
  render::ProjectionOptions how;
  how.path = path.points;
  if (command.projection == "slice") how.z_m = command.to->z();
  auto picture = render::draw_projection(command.projection, map, how);
  if (!picture) return forward_error(std::move(picture));
  return render::write_png(*picture, command.out);
}

Faults plan(PlanCommand command) {
  if (!command.out.empty()) {
    auto allowed = check_output(command.out, std::array{std::filesystem::path(command.map)});
    if (!allowed) return fault_of(std::move(allowed));
  }
  auto map = read_and_tell(command.map, command.is_salvaged);
  if (!map) return fault_of(std::move(map));
  const auto body = BodyShape::sphere(command.radius_m);
  if (!body) return {body.error()};
  auto window = window_of(*map);
  if (!window) {
    if (window.error().where.empty()) window.error().where = command.map;
    return fault_of(std::move(window));
  }
  const auto snapshot = window->snapshot({.frame_count = 1});
  command.how.sweep.thresholds = map->scale().thresholds;
  if (command.unknown == "passes") command.how.sweep.unknown = UnknownSpace::kPasses;
  if (command.is_best) command.how.search = PathSearch::kBest;
  const auto path = plan_path(*snapshot, *body, *command.from, *command.to, command.how);
  if (!path) return {path.error()};
  if (!command.out.empty()) {
    if (auto drawn = draw(command, *map, *path); !drawn) return fault_of(std::move(drawn));
  }
  command.as_json ? print_json(*path) : print_text(*path, map->voxel_m());
  return {};
}

void declare_how(CLI::App& parser, PlanCommand& command) {
  const auto metres = [&](const char* name, double& value, const char* what) {
    parser.add_option(name, value, what)->type_name("METRES")->capture_default_str();
  };
  metres("--radius", command.radius_m, "of the ball that holds the vehicle");
  metres("--margin", command.how.sweep.margin_m, "keep so much farther away, everywhere");
  metres("--comfort", command.how.comfort_m, "and so much more where it costs little");
  parser.add_option("--unknown", command.unknown, "unknown space: stops or passes")
      ->check(CLI::IsMember({"stops", "passes"}).description(""))
      ->type_name("RULE")
      ->capture_default_str();
  parser.add_flag("--best", command.is_best, "use all iterations to look for a better path (RRT*)");
  CLI::Range iterations(1, 10'000'000);
  iterations.description("");
  parser.add_option("--iterations", command.how.max_iterations, "of the search, at most")
      ->check(iterations)
      ->type_name("N")
      ->capture_default_str();
  parser.add_option("--seed", command.how.seed, "the same seed gives the same path")
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace

Action declare_plan(CLI::App& parser) {
  auto o = std::make_shared<PlanCommand>();
  parser.add_option("MAP", o->map, "map file: .swl, .bt or .ot")->type_name("")->required();
  declare_place(parser, "--from", o->from, "where the path begins [m]")->required();
  declare_place(parser, "--to", o->to, "where it ends [m]")->required();
  declare_how(parser, *o);
  parser.add_option("-o,--out", o->out, "PNG picture of the path on the map")->type_name("FILE");
  parser
      .add_option("--projection", o->projection,
                  "of the picture: slice (at the goal's height), top, height")
      ->check(CLI::IsMember({"slice", "top", "height"}).description(""))
      ->type_name("NAME")
      ->capture_default_str();
  parser.add_flag("--json", o->as_json, "one JSON object, for machines");
  declare_salvage(parser, o->is_salvaged);
  parser.footer(
      "Examples:\n"
      "  swiftlet plan flat.swl --from 2.8,3,1.3 --to 8.4,1.7,1.3 -o path.png\n"
      "  swiftlet plan flat.swl --from 2.8,3,1.3 --to 8,5.8,1.3 --radius 0.3 --json\n"
      "The path is clear: no voxel that the ball touches is occupied, or unknown unless --unknown\n"
      "passes. Searched by OMPL, smoothed in the distance field; see docs/planning.md.");
  return [o] { return plan(*o); };
}

}  // namespace swiftlet::app
