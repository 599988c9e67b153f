// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/session/flight_recovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <optional>
#include <string_view>
#include <system_error>

#include "swiftlet/file/file_names.hpp"
#include "swiftlet/session/flight_file.hpp"
#include "swiftlet/store/map_file/map_file.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

constexpr int kMostWorlds = 10'000;

bool has_log(const fs::path& path) {
  return is_there(path.string() + "-wal") || is_there(path.string() + "-journal");
}

/// Makes one file of a map and the log beside it, if a writer has left one.
Status fold(const fs::path& path) {
  if (!has_log(path)) return Done{};
  auto file = MapFile::open_to_write(path, 0);
  if (!file) return forward_error(std::move(file));
  return file->finish();
}

/// When the flight began, as its map tells; a line of the file, so it may say anything.
std::string start_of(const MapMeta& meta, const fs::path& path) {
  constexpr std::string_view kForm = "0000-00-00T00:00:00";
  const auto created = meta.find("created");
  std::string text = created == meta.end() ? "" : created->second.substr(0, kForm.size());
  const auto fits = [](char is, char form) {
    return form == '0' ? std::isdigit(static_cast<unsigned char>(is)) != 0 : is == form;
  };
  if (std::ranges::equal(text, kForm, fits)) {
    std::ranges::replace(text, ':', '-');
    return text;
  }
  std::error_code unreadable;
  const auto written = std::chrono::file_clock::to_sys(fs::last_write_time(path, unreadable));
  const auto written_s = std::chrono::floor<std::chrono::seconds>(written).time_since_epoch();
  return time_in_name(std::time_t{written_s.count()});
}

struct MapState {
  bool is_cut_off = false;
  bool is_empty = false;
  std::string start;
  std::string replaces;  // empty: nothing, or it was never saved whole
};

/// nullopt: there is no map that could be read.
std::optional<MapState> state_of(const fs::path& path, bool had_log) {
  auto file = MapFile::open_to_read(path);
  if (!file) return std::nullopt;
  const auto meta = file->meta();
  const auto checksum = file->checksum();
  if (!meta || !checksum) return std::nullopt;
  const auto flight = meta->find(std::string(kFlightKey));
  const auto replaces = meta->find(std::string(kReplacesKey));
  const bool is_told = flight != meta->end();
  MapState state;
  state.is_cut_off = is_told ? flight->second == kUnderWay : had_log;
  state.is_empty = checksum->blocks == 0;
  state.start = start_of(*meta, path);
  if (is_told && flight->second == kSavedWhole && replaces != meta->end())
    state.replaces = replaces->second;
  return state;
}

std::optional<MapState> folded_state(const fs::path& path, Status& status) {
  std::error_code unreadable;
  if (!is_map_file(path) || fs::is_symlink(path, unreadable)) return std::nullopt;
  const bool had_log = has_log(path);
  status = fold(path);
  if (!status && status.error().code == ErrorCode::kUsage) return std::nullopt;  // somebody writes
  // Else a reader has the log open, or there is no room to fold it in: then it goes along.
  status = Done{};
  return state_of(path, had_log);
}

/// Keeps what a flight had mapped until it was cut off, under a name of its own.
Status keep_cut_flight(const fs::path& path, std::vector<std::string>& notes) {
  Status status = Done{};
  const auto state = folded_state(path, status);
  if (!state || !state->is_cut_off) return status;
  if (state->is_empty) {  // nothing was mapped, and what it is to replace is elsewhere
    MapFile::remove(path);
    return Done{};
  }
  const fs::path kept = first_free_path(path, state->start + ".cut");
  auto renamed = has_log(path) ? MapFile::rename(path, kept) : rename_to_new(path, kept);
  if (!renamed) return renamed;
  notes.push_back(fmt::format("{}: a flight was cut off; what it had mapped is kept as {}",
                              path.string(), kept.string()));
  return Done{};
}

/// Names that set_map_aside() gives: "flight.<16 digits>.old.swl".
bool is_name_aside(const fs::path& path, std::string_view name) {
  const std::string begin = path.stem().string() + ".";
  const std::string end = ".old" + path.extension().string();
  constexpr std::size_t kDigits = 16;
  if (name.size() != begin.size() + kDigits + end.size()) return false;
  const auto is_digit = [](unsigned char c) { return std::isxdigit(c) != 0; };
  return name.starts_with(begin) && name.ends_with(end) &&
         std::ranges::all_of(name.substr(begin.size(), kDigits), is_digit);
}

std::vector<fs::path> maps_aside(const fs::path& path) {
  std::vector<fs::path> found;
  std::error_code unreadable;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  for (fs::directory_iterator entry(folder, unreadable), end; !unreadable && entry != end;
       entry.increment(unreadable)) {
    const std::string name = entry->path().filename();
    if (is_name_aside(path, name)) found.push_back(path.parent_path() / name);
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace

Expected<std::vector<std::string>> recover_cut_flights(const fs::path& path) {
  std::vector<std::string> notes;
  if (auto kept = keep_cut_flight(path, notes); !kept) return forward_error(std::move(kept));
  fs::path of_world = path_with_part(path, "world2");
  for (int n = 3; is_there(of_world) && n < kMostWorlds; ++n) {
    if (auto kept = keep_cut_flight(of_world, notes); !kept) return forward_error(std::move(kept));
    of_world = path_with_part(path, fmt::format("world{}", n));
  }
  const auto aside = maps_aside(path);
  const auto present = aside.empty() ? std::nullopt : state_of(path, false);
  for (const fs::path& old : aside) {
    const bool is_missing = !is_there(path);
    if (present && present->replaces == old.filename()) {  // saved, and cut off just then
      MapFile::remove(old);
    } else if (auto put = put_map_back(old, path); !put) {
      return forward_error(std::move(put));
    }
    if (is_missing) {
      notes.push_back(
          fmt::format("{}: the map that the flight was to replace is back", path.string()));
    }
  }
  return notes;
}

}  // namespace swiftlet
