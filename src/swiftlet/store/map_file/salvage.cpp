// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_file/salvage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "swiftlet/store/map_file/map_pages.hpp"
#include "swiftlet/store/map_file/recovered_map.hpp"
#include "swiftlet/store/map_file/salvaged_description.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;
using Kind = MapPages::Column::Kind;

/// Where a block lies in the file.
struct Place {
  std::int64_t touched = 0;
  std::uint64_t checksum = 0;
  std::uint64_t at = 0;
  std::size_t size = 0;
};

auto by_z_y_x(const BlockIndex& b) { return std::tuple(b.z, b.y, b.x); }

std::optional<BlockRow> block_in(std::span<const MapPages::Column> c) {
  if (c.size() != 6 || c[5].kind != Kind::kBlob) return std::nullopt;
  for (std::size_t i = 0; i < 5; ++i) {
    if (c[i].kind != Kind::kInteger) return std::nullopt;
  }
  const auto coordinate = [&](std::size_t i) { return static_cast<std::int32_t>(c[i].integer); };
  return BlockRow{{coordinate(2), coordinate(1), coordinate(0)},
                  c[3].integer,
                  static_cast<std::uint64_t>(c[4].integer),
                  c[5].bytes};
}

/// Goes through the pages of a map and notes what is good and what is not.
class Finder {
 public:
  explicit Finder(const MapPages& pages) : pages_(pages) {}

  Status run() {
    auto passed = pages_.for_each([this](const auto& record) { look_at(record); },
                                  [this](const auto& page) { end_page(page); });
    for (const auto& [page, gap] : ranges_) {
      if (page > pages_.count() || damaged_pages_.contains(page)) gaps_.push_back(gap);
    }
    return passed;
  }

  /// What tells of the map, beside its blocks.
  [[nodiscard]] DescriptionRemains remains() const {
    DescriptionRemains remains{meta_, checksum_, good_.size(), 0};
    for (const auto& [index, place] : good_)
      remains.newest_frame = std::max(remains.newest_frame, place.touched);
    return remains;
  }

  std::unordered_map<BlockIndex, Place, BlockHash> good_;
  std::unordered_set<BlockIndex, BlockHash> damaged_;
  std::vector<SalvageReport::Gap> gaps_;
  MapMeta meta_;
  std::optional<MapChecksum> checksum_;

 private:
  void look_at(const MapPages::Record& record) {
    const auto c = record.columns;
    if (const auto row = block_in(c)) {
      if (record.left_page != 0) note_child(record.left_page, row->index);
      look_at(*row, record.at + c[5].at, record.is_whole_here);
    } else if (c.size() == 2 && c[0].kind == Kind::kText && c[1].kind == Kind::kText) {
      meta_.insert_or_assign(std::string(c[0].text()), std::string(c[1].text()));
    } else if (c.size() == 4 && c[0].kind == Kind::kNull && c[1].kind == Kind::kInteger &&
               c[2].kind == Kind::kInteger && c[3].kind == Kind::kInteger) {
      checksum_ = MapChecksum{c[1].integer, static_cast<std::uint64_t>(c[2].integer),
                              static_cast<std::uint64_t>(c[3].integer)};
    }
  }

  void look_at(const BlockRow& row, std::uint64_t at, bool is_whole_here) {
    if (!is_whole_here || fault_of(row, codec_, block_)) {
      damaged_.insert(row.index);
      return;
    }
    const auto [found, is_new] = good_.try_emplace(row.index);
    // Only where the list of free pages is damaged, too, a block is there twice.
    if (!is_new && found->second.touched >= row.touched) return;
    found->second = {row.touched, row.checksum, at, row.data.size()};
  }

  /// A page of blocks lies between two blocks of the page above it.
  void note_child(std::uint32_t child, const BlockIndex& before) {
    ranges_.push_back({child, {last_, before}});
    last_ = before;
  }

  void end_page(const MapPages::Page& page) {
    if (page.is_damaged) damaged_pages_.insert(page.number);
    if (page.is_inner && last_) ranges_.push_back({page.last_child, {last_, std::nullopt}});
    last_.reset();
  }

  const MapPages& pages_;
  BlockCodec codec_;
  VoxelBlock block_;
  std::optional<BlockIndex> last_;
  std::vector<std::pair<std::uint32_t, SalvageReport::Gap>> ranges_;
  std::unordered_set<std::uint32_t> damaged_pages_;
};

/// Writes the good blocks, by z, y, x; in transactions whose logs stay small.
Status write_good(const Finder& found, const MapPages& pages, MapFile& file) {
  constexpr std::uint64_t kBatch = 4096;
  std::vector<BlockIndex> order;
  order.reserve(found.good_.size());
  for (const auto& [index, place] : found.good_) order.push_back(index);
  std::ranges::sort(order, {}, by_z_y_x);
  auto checksum = file.checksum();
  if (!checksum) return forward_error(std::move(checksum));
  std::vector<std::uint8_t> data;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i % kBatch == 0) {
      if (auto begun = file.begin(); !begun) return begun;
    }
    const Place& place = found.good_.at(order[i]);
    data.resize(place.size);
    const bool is_there = pages.read(place.at, data);
    const BlockRow row{order[i], place.touched, place.checksum, data};
    if (is_there && row.is_intact()) {  // else the disk gives what it did not give before
      if (auto put = file.put(row); !put) return put;
      ++checksum->blocks;
      checksum->block_digest += row.checksum;
    }
    if ((i + 1) % kBatch != 0 && i + 1 != order.size()) continue;
    if (auto written = file.put_checksum(*checksum); !written) return written;
    if (auto done = file.commit(); !done) return done;
  }
  return Done{};
}

SalvageReport report_of(const Finder& found, std::int64_t most_blocks) {
  SalvageReport report;
  report.kept = found.good_.size();
  std::uint64_t digest = 0;
  for (const auto& [index, place] : found.good_) digest += place.checksum;
  if (found.checksum_ && digest == found.checksum_->block_digest) {
    report.missing = 0;  // every one is there, whatever the checksum counts
  } else if (found.checksum_ && found.checksum_->blocks > static_cast<std::int64_t>(report.kept) &&
             found.checksum_->blocks <= most_blocks) {
    report.missing = static_cast<std::uint64_t>(found.checksum_->blocks) - report.kept;
  }
  std::vector<BlockIndex> damaged;
  for (const BlockIndex& index : found.damaged_) {
    if (!found.good_.contains(index)) damaged.push_back(index);
  }
  std::ranges::sort(damaged, {}, by_z_y_x);
  if (damaged.size() > SalvageReport::kMostNamed) damaged.resize(SalvageReport::kMostNamed);
  report.damaged = std::move(damaged);
  report.gaps = found.gaps_;
  if (report.gaps.size() > SalvageReport::kMostNamed) {
    report.gaps.resize(SalvageReport::kMostNamed);
  }
  return report;
}

/// `source`: one file without logs, which is the map `path`.
Expected<SalvageReport> salvage_pages(const fs::path& source, const fs::path& path,
                                      const fs::path& out) {
  auto pages = MapPages::open(source);
  if (!pages) return forward_error(std::move(pages));
  Finder found(*pages);
  if (auto ran = found.run(); !ran) return forward_error(std::move(ran));
  constexpr std::int64_t kMostInAPage = 4096 / 20;
  SalvageReport report = report_of(found, pages->count() * kMostInAPage);
  auto meta = salvaged_description(found.remains(), path, report.notes);
  if (!meta) return forward_error(std::move(meta));
  auto lock = MapFile::create(out, false, *meta);
  if (!lock) return forward_error(std::move(lock));
  auto file = MapFile::open_to_write(out, 0, std::move(*lock));
  Status written =
      file ? write_good(found, *pages, *file) : Status(tl::make_unexpected(file.error()));
  if (written) written = file->finish();
  if (written) return report;
  if (file) file->close();
  MapFile::remove(out);
  return forward_error(std::move(written));
}

std::string name_of(const BlockIndex& b) { return fmt::format("{} {} {}", b.x, b.y, b.z); }

}  // namespace

std::vector<std::string> SalvageReport::lines() const {
  std::vector<std::string> lines;
  lines.push_back(missing ? fmt::format("{} of {} blocks are kept", kept, kept + *missing)
                          : fmt::format("{} blocks are kept; how many there were is lost", kept));
  for (const BlockIndex& block : damaged) {
    lines.push_back(fmt::format("block {} is damaged", name_of(block)));
  }
  for (const Gap& gap : gaps) {
    lines.push_back(fmt::format("a page with blocks from {} to {} (by z, y, x) cannot be read",
                                gap.after ? name_of(*gap.after) : "the first",
                                gap.before ? name_of(*gap.before) : "the last"));
  }
  if (std::max(damaged.size(), gaps.size()) == kMostNamed) lines.emplace_back("and so on");
  lines.insert(lines.end(), notes.begin(), notes.end());
  return lines;
}

Expected<SalvageReport> salvage_map(const fs::path& path, const fs::path& out) {
  std::error_code none;
  if (!fs::exists(path, none)) {
    return fail(ErrorCode::kNotFound, path.string(), "there is no such map");
  }
  if (!has_logs(path)) return salvage_pages(path, path, out);
  auto folder = PrivateFolder::create();
  if (!folder) return forward_error(std::move(folder));
  auto copy = copy_recovered(path, *folder);
  if (copy) return salvage_pages(*copy, path, out);
  auto report = salvage_pages(path, path, out);
  if (report) report->notes.emplace_back("its log cannot be read: newer blocks may be missing");
  return report;
}

Expected<std::pair<SavedMap, SalvageReport>> load_salvaged(const fs::path& path) {
  auto folder = PrivateFolder::create();
  if (!folder) return forward_error(std::move(folder));
  const fs::path clean = folder->path() / "salvaged.swl";
  auto report = salvage_map(path, clean);
  if (!report) return forward_error(std::move(report));
  auto map = SavedMap::of(path, MapFile::open_to_read(clean, path));
  if (!map) return forward_error(std::move(map));
  return std::pair(std::move(*map), std::move(*report));
}

}  // namespace swiftlet
