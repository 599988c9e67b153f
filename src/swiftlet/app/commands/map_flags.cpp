// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/commands/map_flags.hpp"

#include <cstdio>
#include <utility>

#include "swiftlet/app/visible_text.hpp"

namespace swiftlet::app {

void declare_salvage(CLI::App& parser, bool& is_salvaged) {
  parser.add_flag("--salvage", is_salvaged, "read what is sound of a damaged map, tell the rest");
}

Expected<OpenedMap> open_and_tell(const std::string& path, bool is_salvaged) {
  auto opened = open_map(path, is_salvaged);
  if (!opened || !opened->salvage || opened->salvage->is_whole()) return opened;
  for (const std::string& line : opened->salvage->lines())
    std::fputs((visible("swiftlet: " + path + ": " + line) + "\n").c_str(), stderr);
  return opened;
}

Expected<BlockMap> read_and_tell(const std::string& path, bool is_salvaged) {
  auto opened = open_and_tell(path, is_salvaged);
  if (!opened) return forward_error(std::move(opened));
  return read_whole_map(opened->file);
}

}  // namespace swiftlet::app
