// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <CLI/CLI.hpp>
#include <memory>

#include "swiftlet/app/commands/characterize.hpp"

namespace swiftlet::app {

Action declare_characterize(CLI::App& parser) {
  auto o = std::make_shared<CharacterizeOptions>();
  parser.add_option("WHAT", o->what, "noise or fill")
      ->type_name("")
      ->required()
      ->check(CLI::IsMember({"noise", "fill"}));
  parser.add_option("SOURCES", o->sources, "recordings of a flat wall; bags need no poses")
      ->type_name("")
      ->required();
  parser
      .add_option("-o,--out", o->out, "folder for figures and numbers; noise: and for sensor.yaml")
      ->type_name("FOLDER");
  parser.add_flag("--json", o->as_json, "one JSON object, for machines");
  parser.footer(
      "Examples:\n"
      "  swiftlet characterize noise bag:wall_1m.bag bag:wall_4m.bag -o d435\n"
      "  swiftlet map bag:flight.bag --config d435/sensor.yaml\n"
      "  swiftlet characterize fill bag:exposure_sweep.bag bag:laser_sweep.bag -o d435\n"
      "  swiftlet characterize fill sim:tilt\n"
      "noise: fits a plane to the middle third of every image and the disparity error s to how "
      "the\n"
      "readings scatter about it: RMS = z^2 s / (f B).\n"
      "fill: counts the pixels that have a reading, against the tilt of the wall and, where the\n"
      "recording tells them, against exposure and laser power.");
  return [o] { return o->what == "fill" ? characterize_fill(*o) : characterize_noise(*o); };
}

}  // namespace swiftlet::app
