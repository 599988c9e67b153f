// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <vector>

namespace swiftlet {

/// One parameter of the mapper, as text.
struct ParameterRow {
  std::string key;
  std::string default_value;
  std::string limits;  ///< "0.005 .. 10", both ends allowed; empty for names
  std::string meaning;
};

/// All parameters in the order of visit_config().
[[nodiscard]] std::vector<ParameterRow> parameter_table();

/// docs/parameters.md, whole; a test compares the two.
[[nodiscard]] std::string parameters_markdown();

}  // namespace swiftlet
