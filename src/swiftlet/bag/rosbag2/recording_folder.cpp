// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/rosbag2/recording_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "swiftlet/bag/open_recording.hpp"
#include "swiftlet/file/file_content.hpp"
#include "swiftlet/file/yaml_document_private.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 100'000;

/// "flight_12.db3.zstd" is number 12 of "flight"; a name without a number is the only one.
std::pair<std::string, std::uint64_t> place_in_recording(const fs::path& file) {
  std::string name = file.filename().string();
  for (const std::string_view tail : {".zstd", ".active", ".db3", ".mcap", ".bag"})
    if (name.ends_with(tail)) name.resize(name.size() - tail.size());
  const std::size_t digits = name.find_last_not_of("0123456789") + 1;
  std::uint64_t number = 0;
  std::from_chars(name.data() + digits, name.data() + name.size(), number);
  if (digits == 0 || digits == name.size() || name[digits - 1] != '_') return {name, 0};
  return {name.substr(0, digits - 1), number};
}

Expected<std::vector<fs::path>> files_by_name(const fs::path& folder) {
  std::map<std::string, std::vector<std::pair<std::uint64_t, fs::path>>> recordings;
  std::error_code unreadable;
  std::size_t seen = 0;
  for (fs::directory_iterator it(folder, unreadable), end; !unreadable && it != end;
       it.increment(unreadable)) {
    if (++seen > kMostFiles) break;
    if (!it->is_regular_file(unreadable) || !is_recording(it->path())) continue;
    auto [recording, number] = place_in_recording(it->path());
    recordings[recording].emplace_back(number, it->path());
  }
  if (unreadable) return fail(ErrorCode::kIo, folder.string(), unreadable.message());
  if (recordings.empty())
    return fail(ErrorCode::kNotFound, folder.string(), "the folder holds no recording",
                "give a folder with .mcap, .db3 or .bag files, or such a file");
  if (recordings.size() > 1) {
    std::vector<std::string> names;
    for (const auto& [name, files] : recordings)
      names.push_back(files.front().second.filename().string());
    return fail(ErrorCode::kUsage, folder.string(), "the folder holds several recordings",
                fmt::format("name one: {}", fmt::join(names, ", ")));
  }
  auto& numbered = recordings.begin()->second;
  std::ranges::sort(numbered);
  std::vector<fs::path> files;
  std::optional<std::uint64_t> last;
  for (auto& [number, path] : numbered) {
    // Of a file and its packed form, which sorts behind it, the first.
    if (last == number && path == files.back().string() + ".zstd") continue;
    if (last == number) {
      return fail(ErrorCode::kUsage, folder.string(),
                  fmt::format("{} and {} have the same number", path.filename().string(),
                              files.back().filename().string()),
                  "name one of them, or the folder of one recording with all its files");
    }
    last = number;
    files.push_back(std::move(path));
  }
  return files;
}

fs::path unpacked(const fs::path& name) { return name.extension() == ".zstd" ? name.stem() : name; }

/// Older recorders wrote the folder's own name before that of the file, and forgot the ".zstd"; and
/// users unpack.
Expected<fs::path> listed_file(const fs::path& folder, const std::string& listed) {
  const fs::path name = fs::path(listed).filename();
  std::error_code none;
  for (const fs::path& file : {name, fs::path(name.string() + ".zstd"), unpacked(name)}) {
    if (!file.empty() && fs::is_regular_file(folder / file, none)) return folder / file;
  }
  return fail(ErrorCode::kNotFound, (folder / name).string(),
              "metadata.yaml lists the file, but it is not there",
              "copy all files of the recording, or remove metadata.yaml to read those that are");
}

}  // namespace

Expected<std::vector<std::string>> files_in_metadata(std::string_view text,
                                                     const std::string& place) {
  const auto document = parse_yaml(text, place);
  if (!document) return tl::make_unexpected(document.error());
  std::vector<std::string> files;
  try {
    const YAML::Node list = (*document)["rosbag2_bagfile_information"]["relative_file_paths"];
    if (!list.IsSequence())
      return fail(ErrorCode::kCorruptInput, place, "it does not list the files of the recording",
                  "remove it to read those that are there");
    for (const YAML::Node& file : list) files.push_back(file.as<std::string>());
  } catch (const YAML::Exception& fault) {
    return fail(ErrorCode::kCorruptInput, place, fault.msg,
                "remove it to read the files that are there");
  }
  return files;
}

Expected<std::vector<fs::path>> files_of_recording(const fs::path& folder) {
  const fs::path metadata = folder / "metadata.yaml";
  std::error_code none;
  if (!fs::exists(metadata, none)) return files_by_name(folder);
  const auto text = read_text_file(metadata, kMostSettingsBytes);
  if (!text) return tl::make_unexpected(text.error());
  const auto listed = files_in_metadata(*text, metadata.string());
  if (!listed) return tl::make_unexpected(listed.error());
  std::vector<fs::path> files;
  for (const std::string& name : *listed) {
    auto file = listed_file(folder, name);
    if (!file) return forward_error(std::move(file));
    files.push_back(std::move(*file));
  }
  return files;
}

}  // namespace swiftlet
