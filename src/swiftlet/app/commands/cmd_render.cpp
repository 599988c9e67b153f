// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/commands/shared_flags.hpp"
#include "swiftlet/file/output_file.hpp"
#include "swiftlet/render/projection.hpp"

namespace swiftlet::app {
namespace {

struct RenderOptions {
  std::string map;
  std::string out;
  std::string projection = "top";
  render::ProjectionOptions how;
  bool is_salvaged = false;
};

Faults render(const RenderOptions& options) {
  auto known = find_registered(render::projections(), options.projection, "projection");
  if (!known) return fault_of(std::move(known));
  if (auto allowed = check_output(options.out, std::array{std::filesystem::path(options.map)});
      !allowed) {
    return fault_of(std::move(allowed));
  }
  auto map = read_and_tell(options.map, options.is_salvaged);
  if (!map) return fault_of(std::move(map));
  auto picture = render::draw_projection(options.projection, *map, options.how);
  if (!picture) {
    if (picture.error().where.empty()) picture.error().where = options.map;
    return fault_of(std::move(picture));
  }
  if (auto written = render::write_png(*picture, options.out); !written) {
    return fault_of(std::move(written));
  }
  const int joined = render::joined_voxels(*map, options.how);
  const std::string scale =
      joined > 1 ? fmt::format("; {0} x {0} x {0} voxels drawn as one, --scale forbids it", joined)
                 : "";
  fmt::print("{} ({} x {} pixels{})\n", options.out, picture->width(), picture->height(), scale);
  return {};
}

}  // namespace

Action declare_render(CLI::App& parser) {
  auto o = std::make_shared<RenderOptions>();
  parser.add_option("MAP", o->map, "map file: .swl, .bt or .ot")->type_name("")->required();
  parser.add_option("-o,--out", o->out, "PNG picture to write")->type_name("FILE")->required();
  parser.add_option("--projection", o->projection, "see 'swiftlet list projections'")
      ->type_name("NAME")
      ->capture_default_str();
  parser
      .add_option("--z", o->how.z_m,
                  "slice: its height (default: the start's); else: cut away what lies above")
      ->type_name("METRES");
  CLI::Range scales(1, 256);
  scales.description("");
  parser
      .add_option("--scale", o->how.voxel_px,
                  "pixels per voxel, 1 to 256 (default: what fits 1600)")
      ->check(scales)
      ->type_name("PX");
  declare_salvage(parser, o->is_salvaged);
  parser.footer(
      "Examples:\n"
      "  swiftlet render flat.swl -o plan.png                          from above\n"
      "  swiftlet render flat.swl -o slice.png --projection slice --z 0.5    one layer\n"
      "  swiftlet render flat.swl -o flat.png --projection iso --z 1.2       in 3-D, ceiling cut "
      "away\n"
      "In pictures from above x (forward) is up and y is left; ticks stand a metre apart (in\n"
      "large maps 2, 5, 10 ..) and the cross marks where the flight began.");
  return [o] { return render(*o); };
}

}  // namespace swiftlet::app
