// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/session/flight_file.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "swiftlet/file/file_names.hpp"
#include "swiftlet/file/fresh_file.hpp"
#include "swiftlet/store/map_file/map_file.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

constexpr int kMostNames = 10'000;  // tried, until one is free

/// Nothing lies under the name, nor a log that SQLite would take for its own.
bool is_unused(const fs::path& path) {
  return std::ranges::none_of(std::initializer_list<const char*>{"", "-wal", "-shm", "-journal"},
                              [&](const char* log) { return is_there(path.string() + log); });
}

}  // namespace

bool is_there(const fs::path& path) {
  std::error_code unreadable;
  return fs::exists(fs::symlink_status(path, unreadable));
}

fs::path path_with_part(const fs::path& path, std::string_view part) {
  return path.parent_path() /
         fmt::format("{}.{}{}", path.stem().string(), part, path.extension().string());
}

fs::path first_free_path(const fs::path& path, const std::string& part) {
  fs::path name = path_with_part(path, part);
  for (int n = 2; !is_unused(name) && n < kMostNames; ++n) {
    name = path_with_part(path, fmt::format("{}-{}", part, n));
  }
  return name;
}

std::string time_in_name(std::time_t time) {
  return fmt::format("{:%Y-%m-%dT%H-%M-%S}", fmt::gmtime(time));
}

std::string with_start_time(std::string name, std::time_t start) {
  const std::string time = time_in_name(start);
  for (std::size_t at = 0; (at = name.find("%t", at)) != std::string::npos; at += time.size()) {
    name.replace(at, 2, time);
  }
  return name;
}

fs::path free_path_of_world(const fs::path& path, std::size_t world) {
  return first_free_path(path, fmt::format("world{}", world));
}

Expected<fs::path> set_map_aside(const fs::path& path) {
  const fs::path aside = path_with_part(path, unguessable_digits() + ".old");
  std::error_code refused;
  // A second name, not another: so there is at no moment no map under the first.
  fs::create_hard_link(path, aside, refused);
  if (!refused) return aside;
  auto renamed = rename_to_new(path, aside);  // FAT has no links
  if (!renamed) return forward_error(std::move(renamed));
  return aside;
}

Status put_map_back(const fs::path& aside, const fs::path& path) {
  if (!is_there(path)) return rename_to_new(aside, path);
  std::error_code ignored;
  if (is_same_file(aside, path)) fs::remove(aside, ignored);
  return Done{};
}

Status check_flight_file(const fs::path& path, bool overwrite, std::span<const fs::path> inputs) {
  for (const fs::path& input : inputs) {
    if (!is_same_file(path, input)) continue;
    return fail(ErrorCode::kUsage, path.string(),
                fmt::format("this is the input {}; it would be lost", input.string()),
                "choose another name with -o");
  }
  std::error_code unreadable;
  if (!is_there(path)) return Done{};
  if (!fs::is_regular_file(path, unreadable)) {
    return fail(ErrorCode::kUsage, path.string(), "it exists and is not a file",
                "choose another name with -o");
  }
  if (!overwrite) {
    return fail(ErrorCode::kUsage, path.string(), "the file exists",
                "add --overwrite or choose another name with -o");
  }
  if (is_map_file(path) || fs::is_empty(path, unreadable)) return Done{};
  return fail(ErrorCode::kUsage, path.string(),
              "the file is no Swiftlet map, so --overwrite does not replace it",
              "choose another name with -o");
}

std::string cut_off_note(const fs::path& path, const MapMeta& meta) {
  const auto flight = meta.find(std::string(kFlightKey));
  if (flight == meta.end() || flight->second != kUnderWay || MapFile::writer_of(path)) return {};
  const fs::path log = path.string() + "-wal";
  std::string note = "the flight was cut off; this is what had been written by then";
  if (!is_there(log)) note += fmt::format("; if there was a log, {}, it is not here", log.string());
  return note;
}

Status check_room_for_flight(const fs::path& path) {
  constexpr std::uintmax_t kLeastBytes = 96U << 10U;  // a map of no blocks, its log and their index
  constexpr std::array<unsigned char, 4096> kPage{};
  auto probe = make_fresh_file(path, kPage);
  if (!probe) return forward_error(std::move(probe));
  std::error_code unknown;
  const auto space = fs::space(*probe, unknown);
  std::error_code ignored;
  fs::remove(*probe, ignored);
  if (unknown || space.available + kPage.size() >= kLeastBytes) return Done{};
  return fail(
      ErrorCode::kIo, path.string(),
      fmt::format("the disk has {} kB left, too little to begin a map", space.available / 1000),
      "free some space");
}

Status mark_map(const fs::path& path, const MapMeta& lines) {
  auto file = MapFile::open_to_write(path, 0);
  if (!file) return forward_error(std::move(file));
  auto meta = file->meta();
  if (!meta) return forward_error(std::move(meta));
  auto checksum = file->checksum();
  if (!checksum) return forward_error(std::move(checksum));
  if (auto begun = file->begin(); !begun) return begun;
  for (const auto& [key, value] : lines) {
    if (const auto old = meta->find(key); old != meta->end())
      checksum->meta_digest -= meta_checksum(key, old->second);
    checksum->meta_digest += meta_checksum(key, value);
    if (auto put = file->put_meta(key, value); !put) return put;
  }
  if (auto put = file->put_checksum(*checksum); !put) return put;
  if (auto done = file->commit(); !done) return done;
  return file->finish();
}

}  // namespace swiftlet
