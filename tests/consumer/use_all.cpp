// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Asks for a source that does not exist: the answer names all that do, so the registry and
// everything behind it came through the linker.

#include <iostream>

#include "swiftlet/source/sources.hpp"

int main() {
  const auto missing = swiftlet::find_registered(swiftlet::sources(), "nowhere", "source");
  if (missing) return 1;
  std::cout << missing.error().text() << '\n';
  for (const auto& kind : swiftlet::sources()) {
    if (missing.error().text().find(kind.name) == std::string::npos) return 1;
  }
  return missing.error().code == swiftlet::ErrorCode::kUsage ? 0 : 1;
}
