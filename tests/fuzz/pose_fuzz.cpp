// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Any bytes are a pose line, as they come over UDP. What is read can be written, and read as the
// same.

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "swiftlet/source/rig/pose_line.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  const std::string_view line(reinterpret_cast<const char*>(data), size);
  const auto pose = parse_pose_line(line);
  if (!pose) return 0;
  const auto again = parse_pose_line(pose_line(*pose));
  if (!again || again->stamp != pose->stamp || again->confidence != pose->confidence) std::abort();
  const auto same = [](double a, double b) { return a == b || (a != a && b != b); };
  for (int i = 0; i < 4; ++i) {
    if (!same(again->R_world_body.coeffs()[i], pose->R_world_body.coeffs()[i])) std::abort();
    if (i < 3 && !same(again->t_world_body_m[i], pose->t_world_body_m[i])) std::abort();
  }
  return 0;
}
