// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/report/salvage_report.hpp"

#include <nlohmann/json.hpp>

namespace swiftlet::app {

nlohmann::ordered_json salvage_json(const SalvageReport& report) {
  nlohmann::ordered_json json{{"kept", report.kept},
                              {"missing", nullptr},
                              {"is_whole", report.is_whole()},
                              {"lines", report.lines()}};
  if (report.missing) json["missing"] = *report.missing;
  return json;
}

}  // namespace swiftlet::app
