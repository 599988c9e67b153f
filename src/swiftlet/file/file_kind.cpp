// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/file/file_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "swiftlet/file/file_content.hpp"

namespace swiftlet {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kHead = 4096;
constexpr const char* kTexts =
    "'swiftlet check' reads configs, rigs and scenes; 'swiftlet map' takes lists of poses";
constexpr const char* kMapBag =
    "map it with 'swiftlet map bag:FILE', look at it with 'swiftlet info'";
constexpr const char* kUnpack = "unpack it and give what is inside";

struct Signature {
  std::string_view bytes;
  FileKind kind;
  const char* what;
  const char* remedy;
};
constexpr std::array kSignatures{
    Signature{"# Octomap OcTree binary file"sv, FileKind::kOctomap, "an OctoMap (.bt)", ""},
    Signature{"# Octomap OcTree file"sv, FileKind::kOctomap, "an OctoMap (.ot)", ""},
    Signature{"#ROSBAG V2.0"sv, FileKind::kBag, "a ROS bag", kMapBag},
    Signature{"#ROSRECORD V1"sv, FileKind::kOther, "a ROS bag of an old version",
              "turn it into version 2.0 with 'rosbag fix'"},
    Signature{"\x89MCAP0\r\n"sv, FileKind::kBag, "an MCAP recording", kMapBag},
    Signature{"\x89PNG\r\n\x1a\n"sv, FileKind::kOther, "a PNG picture", ""},
    Signature{"\xff\xd8\xff"sv, FileKind::kOther, "a JPEG picture", ""},
    Signature{"%PDF"sv, FileKind::kOther, "a PDF", ""},
    Signature{"\x1f\x8b"sv, FileKind::kOther, "packed with gzip", kUnpack},
    Signature{"BZh"sv, FileKind::kOther, "packed with bzip2", kUnpack},
    Signature{"\x28\xb5\x2f\xfd"sv, FileKind::kOther, "packed with zstd", kUnpack},
    Signature{"\xfd\x37zXZ\0"sv, FileKind::kOther, "packed with xz", kUnpack},
    Signature{"\x04\x22\x4d\x18"sv, FileKind::kOther, "packed with lz4", kUnpack},
    Signature{"PK\x03\x04"sv, FileKind::kOther, "a ZIP archive", kUnpack},
    Signature{"\x7f\x45LF"sv, FileKind::kOther, "a program", ""},
    Signature{"ply\n"sv, FileKind::kOther, "a PLY file of points or triangles",
              "a scene may use it as a mesh"},
    Signature{"ply\r\n"sv, FileKind::kOther, "a PLY file of points or triangles",
              "a scene may use it as a mesh"},
    Signature{"\xff\xfe"sv, FileKind::kText, "a text in UTF-16", kTexts},
    Signature{"\xfe\xff"sv, FileKind::kText, "a text in UTF-16", kTexts},
    Signature{"# .PCD"sv, FileKind::kOther, "a PCD file of points", ""},
};

FileFacts unknown_data() {
  return {FileKind::kOther, "no kind of file that is known here", "is it damaged or cut off?"};
}

/// An SQLite database; its number of the application, which tells whose it is, stands at byte 68.
FileFacts database_facts(std::string_view head, bool has_log) {
  constexpr std::size_t kPlace = 68;
  if (head.size() < kPlace + 4) return unknown_data();
  const std::string_view owner = head.substr(kPlace, 4);
  // A writer that was killed early left the number in its log.
  if (owner == "SWLT"sv || (owner == "\0\0\0\0"sv && has_log))
    return {FileKind::kMap, "a Swiftlet map", ""};
  return {FileKind::kOther, "an SQLite database of another program", ""};
}

bool is_text(std::string_view head) {
  return std::ranges::none_of(head, [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte == 0x7F || (byte < 0x20 && c != '\n' && c != '\r' && c != '\t' && c != '\f');
  });
}

FileFacts facts_of(std::string_view head, bool has_log) {
  if (head.empty() && has_log) return {FileKind::kMap, "a Swiftlet map", ""};
  if (head.empty()) {
    return {FileKind::kOther, "empty",
            "what was to write it failed or was killed before its first byte"};
  }
  if (head.starts_with("SQLite format 3\0"sv)) return database_facts(head, has_log);
  for (const Signature& known : kSignatures) {
    if (head.starts_with(known.bytes)) return {known.kind, known.what, known.remedy};
  }
  if (!is_text(head)) return unknown_data();
  return {FileKind::kText, "a text", kTexts};
}

}  // namespace

Expected<FileFacts> look_at_file(const std::filesystem::path& path) {
  auto head = read_head(path, kHead);
  if (!head) {
    std::error_code none;
    if (std::filesystem::is_directory(path, none))
      head.error().remedy = "give a file; 'swiftlet map tum:FOLDER' maps a recording in a folder";
    return forward_error(std::move(head));
  }
  std::error_code none;
  return facts_of(*head, std::filesystem::exists(path.string() + "-wal", none) ||
                             std::filesystem::exists(path.string() + "-journal", none));
}

Error wrong_kind(const std::filesystem::path& path, const FileFacts& facts,
                 std::string_view wanted) {
  return {ErrorCode::kCorruptInput, path.string(),
          fmt::format("it is {}, not {}", facts.what, wanted), facts.remedy};
}

}  // namespace swiftlet
