// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <ctime>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/store/map_file/map_file.hpp"

namespace swiftlet {

/// Lines of `meta` that tell whether the flight that made a map has come to its end, and which file
/// it replaces (docs/formats/map_file.md).
inline constexpr std::string_view kFlightKey = "flight";
inline constexpr std::string_view kUnderWay = "under way";         ///< or it was cut off
inline constexpr std::string_view kSavedWhole = "saved";           ///< with all that was mapped
inline constexpr std::string_view kSavedInPart = "saved in part";  ///< the disk had no room
inline constexpr std::string_view kReplacesKey = "replaces";

/// "2026-11-28T13-24-05", UTC.
[[nodiscard]] std::string time_in_name(std::time_t time);
/// "flight-%t.swl" with the time of the start, UTC: "flight-2026-11-28T13-24-05.swl".
[[nodiscard]] std::string with_start_time(std::string name, std::time_t start);

/// Whether anything has this name, be it a link to nothing.
[[nodiscard]] bool is_there(const std::filesystem::path& path);
/// "flight.swl" with "cut": "flight.cut.swl".
[[nodiscard]] std::filesystem::path path_with_part(const std::filesystem::path& path,
                                                   std::string_view part);
/// The first of "flight.cut.swl", "flight.cut-2.swl", ... under which nothing lies, nor a log that
/// SQLite would take for its own.
[[nodiscard]] std::filesystem::path first_free_path(const std::filesystem::path& path,
                                                    const std::string& part);
/// The file of the n-th world of a flight, n > 1: "flight.world2.swl"; the first of these names
/// under which nothing lies, so that no file is ever replaced.
[[nodiscard]] std::filesystem::path free_path_of_world(const std::filesystem::path& path,
                                                       std::size_t world);

/// Whether a flight may write there. Errors: kUsage if it is one of the inputs or exists; with
/// `overwrite` if it is anything but a map.
[[nodiscard]] Status check_flight_file(const std::filesystem::path& path, bool overwrite,
                                       std::span<const std::filesystem::path> inputs);

/// Whether the disk takes a new map there by now, which a file tells that is gone again at once.
/// Errors: kIo if it has no room, or the folder cannot be written.
[[nodiscard]] Status check_room_for_flight(const std::filesystem::path& path);

/// Gives a map a second name, that of a file nobody else has, so that it outlives its first.
/// Errors: kIo.
[[nodiscard]] Expected<std::filesystem::path> set_map_aside(const std::filesystem::path& path);
/// What set_map_aside() did is undone, unless another map has the name by now.
[[nodiscard]] Status put_map_back(const std::filesystem::path& aside,
                                  const std::filesystem::path& path);

/// What is to be told of the file of a flight that was cut off, which may lack its log, too; empty
/// for all other maps. `meta` is that of the map at `path`.
[[nodiscard]] std::string cut_off_note(const std::filesystem::path& path, const MapMeta& meta);

/// Changes or adds lines of `meta` in a map that nobody has open. Errors: those of MapFile.
[[nodiscard]] Status mark_map(const std::filesystem::path& path, const MapMeta& lines);

}  // namespace swiftlet
