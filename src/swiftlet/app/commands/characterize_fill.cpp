// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "swiftlet/app/commands/characterize.hpp"
#include "swiftlet/app/report/experiment_report.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/eval/camera/fill_sweep.hpp"
#include "swiftlet/file/text_output.hpp"

namespace swiftlet::app {
namespace {

using eval::FillSweep;
using eval::FillSweeps;

Status draw(const FillSweeps& sweeps, const std::string& folder) {
  if (auto made = make_folder(folder); !made) return made;
  for (const FillSweep* sweep : sweeps.known()) {
    if (auto drawn = draw_figure(eval::fill_figure(*sweep), folder); !drawn)
      return forward_error(std::move(drawn));
  }
  return Done{};
}

nlohmann::ordered_json fill_json(const FillSweeps& sweeps) {
  nlohmann::ordered_json json{{"frames", sweeps.frames}};
  for (const FillSweep* sweep : sweeps.known()) {
    auto rows = nlohmann::ordered_json::array();
    for (const auto& [value, fill] : sweep->by) {
      rows.push_back({{sweep->name, value},
                      {"frames", fill.frames},
                      {"valid_pixels", fill.mean(fill.valid)},
                      {"of_image", fill.mean(fill.of_image)},
                      {"of_middle", fill.mean(fill.of_middle)}});
    }
    json[fmt::format("by_{}", sweep->name)] = std::move(rows);
  }
  return json;
}

void print_fill(const FillSweeps& sweeps) {
  fmt::print("{} frames\n", sweeps.frames);
  for (const FillSweep* sweep : sweeps.known()) {
    fmt::print("\n{:>16}  {:>6}  {:>12}  {:>12}  {:>13}\n", sweep->title, "frames", "valid pixels",
               "of the image", "of its middle");
    for (const auto& [value, fill] : sweep->by) {
      fmt::print("{:>16g}  {:>6}  {:>12.0f}  {:>10.1f} %  {:>11.1f} %\n", value, fill.frames,
                 fill.mean(fill.valid), 100.0 * fill.mean(fill.of_image),
                 100.0 * fill.mean(fill.of_middle));
    }
  }
  if (sweeps.exposure.by.empty() && sweeps.laser.by.empty())
    fmt::print("\nthe recording does not tell exposure and laser power\n");
}

}  // namespace

Faults characterize_fill(const CharacterizeOptions& options) {
  const auto sweeps = eval::measure_fill_sweeps(options.sources);
  if (!sweeps) return {sweeps.error()};
  if (!options.out.empty()) {
    if (auto drawn = draw(*sweeps, options.out); !drawn) return fault_of(std::move(drawn));
  }
  if (options.as_json) {
    fmt::print("{}\n", json_text(fill_json(*sweeps)));
  } else {
    print_fill(*sweeps);
  }
  return {};
}

}  // namespace swiftlet::app
