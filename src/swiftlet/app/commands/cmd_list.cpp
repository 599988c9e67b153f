// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/config/parameter_table.hpp"
#include "swiftlet/doctor/doctor_checks.hpp"
#include "swiftlet/eval/score/score.hpp"
#include "swiftlet/eval/thesis/experiment.hpp"
#include "swiftlet/integrate/integrator.hpp"
#include "swiftlet/integrate/measurement_models.hpp"
#include "swiftlet/integrate/rays/ray_method.hpp"
#include "swiftlet/preprocess/depth_step.hpp"
#include "swiftlet/render/projection.hpp"
#include "swiftlet/sim/built_in_scenes.hpp"
#include "swiftlet/sim/random/scene_kinds.hpp"
#include "swiftlet/source/sources.hpp"
#include "swiftlet/store/export/exporters.hpp"

namespace swiftlet::app {
namespace {

/// One line of `swiftlet list`.
struct Listed {
  std::string name;
  std::string summary;
  bool is_built = true;
  std::string needs{};
};

template <class Make>
std::vector<Listed> listed(std::span<const Registered<Make>> table) {
  std::vector<Listed> lines;
  for (const auto& e : table) {
    lines.push_back(
        {std::string(e.name), std::string(e.summary), e.make != nullptr, std::string(e.needs)});
  }
  return lines;
}

/// Scenes can be flown where the source that flies them is built.
std::vector<Listed> listed_scenes() {
  const auto simulator = find_registered(sources(), "sim", "source");
  const bool is_built = simulator && simulator->make != nullptr;
  const std::string needs(simulator ? simulator->needs : "");
  std::vector<Listed> lines;
  for (const sim::BuiltInScene& scene : sim::built_in_scenes()) {
    lines.push_back({std::string(scene.name), std::string(scene.about), is_built, needs});
  }
  return lines;
}

std::vector<Listed> listed_models() {
  std::vector<Listed> lines;
  for (const MeasurementModelEntry& model : measurement_models()) {
    lines.push_back({std::string(model.name), std::string(model.summary)});
  }
  return lines;
}

std::vector<Listed> listed_rays() {
  std::vector<Listed> lines;
  for (const RayMethod& ray : ray_methods()) {
    lines.push_back({std::string(ray.name), std::string(ray.summary)});
  }
  return lines;
}

std::vector<Listed> listed_parameters() {
  std::vector<Listed> lines;
  for (const ParameterRow& row : parameter_table()) {
    const std::string limits = row.limits.empty() ? "" : fmt::format(" ({})", row.limits);
    lines.push_back(
        {row.key, fmt::format("{}; default {}{}", row.meaning, row.default_value, limits)});
  }
  return lines;
}

/// A kind of thing there is a registry of, and the option that chooses one.
struct Kind {
  std::string_view name;
  std::string_view use;
  std::vector<Listed> (*lines)();
};
const std::array kKinds{
    Kind{"sources", "swiftlet map NAME:...", [] { return listed(sources()); }},
    Kind{"scenes", "swiftlet map sim:NAME", listed_scenes},
    Kind{"random", "swiftlet map sim:random:NAME?seed=7",
         [] { return listed(sim::scene_kinds()); }},
    Kind{"steps", "parameter depth.steps", [] { return listed(depth_steps()); }},
    Kind{"rays", "swiftlet map --rays", listed_rays},
    Kind{"models", "parameter integrate.model", listed_models},
    Kind{"integrators", "parameter integrate.integrator", [] { return listed(integrators()); }},
    Kind{"exporters", "swiftlet export --to", [] { return listed(exporters()); }},
    Kind{"projections", "swiftlet render --projection",
         [] { return listed(render::projections()); }},
    Kind{"scores", "swiftlet score", [] { return listed(eval::scores()); }},
    Kind{"checks", "swiftlet doctor", [] { return listed(doctor::doctor_checks()); }},
    Kind{"experiments", "swiftlet experiment", [] { return listed(eval::experiments()); }},
    Kind{"parameters", "swiftlet map --config, --set", listed_parameters},
};

void print_kind(const Kind& kind) {
  const auto lines = kind.lines();
  std::size_t width = 0;
  for (const Listed& line : lines) width = std::max(width, line.name.size());
  fmt::print("{} ({})\n", kind.name, kind.use);
  for (const Listed& line : lines) {
    const std::string missing =
        line.is_built
            ? ""
            : fmt::format(" [not built; configure with -DSWIFTLET_WITH_{}=ON]", line.needs);
    fmt::print("  {:{}}  {}{}\n", line.name, width, line.summary, missing);
  }
}

nlohmann::ordered_json json_of(const Kind& kind) {
  auto array = nlohmann::ordered_json::array();
  for (const Listed& line : kind.lines()) {
    array.push_back({{"name", line.name}, {"summary", line.summary}, {"is_built", line.is_built}});
  }
  return array;
}

struct ListOptions {
  std::string kind;
  bool as_json = false;
  bool as_markdown = false;
};

Faults list(const ListOptions& options) {
  if (options.as_markdown) {
    if (options.kind != "parameters") {
      return {{ErrorCode::kUsage, "list", "--markdown is for parameters only",
               "write 'swiftlet list parameters --markdown'"}};
    }
    fmt::print("{}", parameters_markdown());
    return {};
  }
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  for (const Kind& kind : kKinds) {
    if (!options.kind.empty() && options.kind != kind.name) continue;
    if (options.as_json) {
      all[std::string(kind.name)] = json_of(kind);
    } else {
      print_kind(kind);
    }
  }
  if (options.as_json) fmt::print("{}\n", json_text(all));
  return {};
}

}  // namespace

Action declare_list(CLI::App& parser) {
  auto options = std::make_shared<ListOptions>();
  std::vector<std::string> names;
  names.reserve(kKinds.size());
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  parser.add_option("KIND", options->kind, "only this kind of thing")
      ->check(CLI::IsMember(names))
      ->type_name("");
  parser.add_flag("--json", options->as_json, "one JSON object, for machines");
  parser.add_flag("--markdown", options->as_markdown, "parameters as a page of the documentation");
  parser.footer(
      "Examples:\n"
      "  swiftlet list                 everything\n"
      "  swiftlet list sources         where frames may come from\n"
      "  swiftlet list parameters      what --config and --set may say");
  return [options] { return list(*options); };
}

}  // namespace swiftlet::app
