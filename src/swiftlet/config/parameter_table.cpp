// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/config/parameter_table.hpp"

#include <fmt/format.h>

#include "swiftlet/config/config_value_private.hpp"
#include "swiftlet/pipeline/mapper_config.hpp"

namespace swiftlet {

std::vector<ParameterRow> parameter_table() {
  std::vector<ParameterRow> rows;
  const MapperConfig defaults;
  visit_config(defaults, [&](const ConfigField& field, const auto& value) {
    const bool is_number = field.min < field.max;
    rows.push_back({std::string(field.key), value_text(value),
                    is_number ? fmt::format("{} .. {}", field.min, field.max) : std::string{},
                    std::string(field.meaning)});
  });
  return rows;
}

std::string parameters_markdown() {
  std::string page =
      "# Parameters\n\n"
      "<!-- Written by `swiftlet list parameters --markdown`; do not edit by hand. -->\n\n"
      "Give them in a file (`swiftlet map SOURCE --config flight.yaml`) or one by one\n"
      "(`--set map.voxel_m=0.1`). The unit is part of the name: `_m` metres, `_px` pixels. A "
      "value\n"
      "with a unit behind it (`20cm`), a name that is not in this table and a value outside its\n"
      "limits are errors that name the line. What a file does not say keeps its default. Of "
      "several\n"
      "`--config` a later one wins over an earlier, and `--set` over all.\n\n"
      "```yaml\nmap:\n  voxel_m: 0.1\n  size_m: [20, 20, 6]\ndepth:\n  max_range_m: 8\n```\n\n"
      "| parameter | default | limits | meaning |\n|---|---|---|---|\n";
  for (const ParameterRow& row : parameter_table()) {
    page += fmt::format("| `{}` | `{}` | {} | {} |\n", row.key, row.default_value, row.limits,
                        row.meaning);
  }
  return page;
}

}  // namespace swiftlet
