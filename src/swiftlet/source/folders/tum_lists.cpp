// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/folders/tum_lists.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "swiftlet/file/file_content.hpp"
#include "swiftlet/source/text_file.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;
using Words = std::span<const std::string_view>;

tl::unexpected<Error> malformed(std::string what) {
  return fail(ErrorCode::kCorruptInput, {}, std::move(what));
}

Expected<TumImage> parse_image(Words words) {
  if (words.size() != 2)
    return malformed(
        fmt::format("a line has 2 columns (timestamp file), this one {}", words.size()));
  auto stamp = parse_stamp(words[0]);
  if (!stamp) return forward_error(std::move(stamp));
  return TumImage{*stamp, words[1]};
}

Expected<TumPose> parse_pose(Words words) {
  if (words.size() != 8) {
    return malformed(fmt::format(
        "a line has 8 columns (timestamp tx ty tz qx qy qz qw), this one {}", words.size()));
  }
  auto stamp = parse_stamp(words[0]);
  if (!stamp) return forward_error(std::move(stamp));

  std::array<double, 7> value{};
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto number = parse_number(words[i + 1]);
    if (!number) return malformed(fmt::format("'{}' is not a number", words[i + 1]));
    value[i] = *number;
  }
  const auto [tx, ty, tz, qx, qy, qz, qw] = value;
  return TumPose{*stamp, Eigen::Quaterniond(qw, qx, qy, qz), {tx, ty, tz}};
}

template <class Row>
Expected<std::vector<Row>> read_list(const fs::path& list, Expected<Row> (*parse)(Words)) {
  auto text = read_text_file(list, kMostListBytes);
  if (!text) {
    text.error().remedy = "a TUM RGB-D folder holds depth.txt, groundtruth.txt and the images";
    return forward_error(std::move(text));
  }
  std::vector<Row> rows;
  for (const TextRow& line : rows_of(*text)) {
    auto row = parse(line.words);
    if (!row) {
      return fail(row.error().code, fmt::format("{}:{}", list.string(), line.line),
                  row.error().what, "correct the line, or start it with #");
    }
    rows.push_back(std::move(*row));
  }
  if (rows.empty()) return fail(ErrorCode::kCorruptInput, list.string(), "it lists nothing");
  std::ranges::stable_sort(rows, {}, &Row::stamp);
  return rows;
}

}  // namespace

Expected<std::vector<TumImage>> read_tum_images(const fs::path& list) {
  return read_list<TumImage>(list, parse_image);
}

Expected<std::vector<TumPose>> read_tum_poses(const fs::path& list) {
  return read_list<TumPose>(list, parse_pose);
}

void shift_times(std::vector<TumImage>& images, Nanoseconds offset) {
  constexpr auto kFirst = std::numeric_limits<std::int64_t>::min();
  constexpr auto kLast = std::numeric_limits<std::int64_t>::max();
  const std::int64_t by_ns = offset.count();
  for (TumImage& image : images) {
    const bool is_beyond =
        by_ns > 0 ? image.stamp.ns > kLast - by_ns : image.stamp.ns < kFirst - by_ns;
    image.stamp.ns = is_beyond ? (by_ns > 0 ? kLast : kFirst) : image.stamp.ns + by_ns;
  }
}

std::string tum_origin(const fs::path& list) {
  auto text = read_text_file(list, kMostListBytes);
  if (!text) return {};
  std::string_view rest = *text;
  while (rest.starts_with('#')) {  // the head of the file
    const std::string_view line = rest.substr(0, rest.find('\n'));
    const auto words = words_of(line.substr(1));
    if (words.size() == 2 && words[0] == "file:") return std::string(words[1]);
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
  }
  return {};
}

}  // namespace swiftlet
