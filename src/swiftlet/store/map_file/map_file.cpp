// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_file/map_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <system_error>
#include <tuple>
#include <utility>

#include "swiftlet/store/map_file/block_codec.hpp"

namespace swiftlet {
namespace {

using sqlite::Statement;

/// A config is some kilobytes.
constexpr std::size_t kMostMetaBytes = std::size_t{1} << 20U;

/// Blocks whose voxels have an int32 index.
constexpr std::int32_t kMaxBlock = (1 << 28) - 1;

std::int64_t as_signed(std::uint64_t v) { return std::bit_cast<std::int64_t>(v); }
std::uint64_t as_unsigned(std::int64_t v) { return std::bit_cast<std::uint64_t>(v); }

BlockRow row_of(const Statement& s) {
  // A damaged coordinate may be any number; the checksum finds the ones that wrapped around here.
  const auto coordinate = [](std::int64_t v) { return static_cast<std::int32_t>(v); };
  return {{coordinate(s.integer(2)), coordinate(s.integer(1)), coordinate(s.integer(0))},
          s.integer(3),
          as_unsigned(s.integer(4)),
          s.bytes(5)};
}

Status visit_rows(Statement& statement, const MapFile::VisitRow& visit) {
  Status status = Done{};
  for (;;) {
    auto has_row = statement.step();
    if (!has_row) {
      status = forward_error(std::move(has_row));
      break;
    }
    if (!*has_row) break;
    status = visit(row_of(statement));
    if (!status) break;
  }
  statement.reset();
  return status;
}

}  // namespace

bool BlockRow::is_intact() const { return checksum == block_checksum(index, touched, data); }

std::optional<std::string> fault_of(const BlockRow& row, BlockCodec& codec, VoxelBlock& out) {
  const auto is_sane = [](std::int32_t v) { return v >= -kMaxBlock && v <= kMaxBlock; };
  const BlockIndex& b = row.index;
  const auto of_block = [&](const char* fault) {
    return fmt::format("block {} {} {} {}", b.x, b.y, b.z, fault);
  };
  if (!row.is_intact()) return of_block("is damaged: its checksum differs");
  if (!is_sane(b.x) || !is_sane(b.y) || !is_sane(b.z)) return of_block("lies outside the world");
  if (!codec.decompress(row.data, out)) return of_block("does not decompress to 512 voxels");
  return std::nullopt;
}

Status decode_row(const BlockRow& row, BlockCodec& codec, VoxelBlock& out) {
  if (row.is_intact() && codec.decompress(row.data, out)) return Done{};
  return fail(
      ErrorCode::kCorruptInput, "map",
      fmt::format("the stored block {} {} {} is damaged", row.index.x, row.index.y, row.index.z));
}

Expected<MapMeta> MapFile::meta() {
  auto lines = database_.prepare("SELECT key, value FROM meta");
  if (!lines) return forward_error(std::move(lines));
  auto sums = checksum();
  if (!sums) return forward_error(std::move(sums));
  MapMeta meta;
  std::uint64_t digest = 0;
  std::size_t bytes = 0;
  for (;;) {
    auto has_row = lines->step();
    if (!has_row) return forward_error(std::move(has_row));
    if (!*has_row) break;
    bytes += lines->text(0).size() + lines->text(1).size() + 1;
    if (bytes > kMostMetaBytes) break;
    digest += meta_checksum(lines->text(0), lines->text(1));
    meta.insert_or_assign(std::string(lines->text(0)), std::string(lines->text(1)));
  }
  if (digest == sums->meta_digest && bytes <= kMostMetaBytes) return meta;
  return fail(ErrorCode::kCorruptInput, path_.string(),
              "the description of the map (table 'meta') is damaged");
}

Expected<MapChecksum> MapFile::checksum() {
  auto line = database_.prepare("SELECT blocks, block_digest, meta_digest FROM seal WHERE id = 0");
  if (!line) return forward_error(std::move(line));
  auto has_row = line->step();
  if (!has_row) return forward_error(std::move(has_row));
  if (!*has_row)
    return fail(ErrorCode::kCorruptInput, path_.string(), "the map has no checksum (table 'seal')");
  return MapChecksum{line->integer(0), as_unsigned(line->integer(1)),
                     as_unsigned(line->integer(2))};
}

Expected<bool> MapFile::read(const BlockIndex& index, const VisitRow& visit) {
  read_.bind(1, std::int64_t{index.z})
      .bind(2, std::int64_t{index.y})
      .bind(3, std::int64_t{index.x});
  bool was_found = false;
  Status status = visit_rows(read_, [&](const BlockRow& row) {
    was_found = true;
    return visit(row);
  });
  if (!status) return forward_error(std::move(status));
  return was_found;
}

Status MapFile::for_each(const VisitRow& visit) {
  std::optional<BlockIndex> last;
  return visit_rows(all_, [&](const BlockRow& row) -> Status {
    const auto order = [](const BlockIndex& b) { return std::tuple(b.z, b.y, b.x); };
    if (last && order(row.index) <= order(*last)) {
      return fail(ErrorCode::kCorruptInput, path_.string(),
                  "the blocks of the map are out of order", "--salvage reads what is sound");
    }
    last = row.index;
    return visit(row);
  });
}

Expected<std::vector<std::string>> MapFile::integrity_faults() {
  auto check = database_.prepare("PRAGMA integrity_check(20)");
  if (!check) return forward_error(std::move(check));
  std::vector<std::string> faults;
  for (;;) {
    auto has_row = check->step();
    if (!has_row) return forward_error(std::move(has_row));
    if (!*has_row) return faults;
    if (check->text(0) != "ok") faults.emplace_back(check->text(0));
  }
}

Status MapFile::hold_view() { return database_.run("BEGIN"); }
Status MapFile::begin() { return database_.run("BEGIN IMMEDIATE"); }
Status MapFile::commit() { return database_.run("COMMIT"); }
// SQLite may have rolled back by itself (disk full); then this one fails, and that is fine.
void MapFile::rollback() { static_cast<void>(database_.run("ROLLBACK")); }

Status MapFile::put(const BlockRow& row) {
  return put_.bind(1, std::int64_t{row.index.z})
      .bind(2, std::int64_t{row.index.y})
      .bind(3, std::int64_t{row.index.x})
      .bind(4, row.touched)
      .bind(5, as_signed(row.checksum))
      .bind(6, row.data)
      .run();
}

Status MapFile::erase(const BlockIndex& index) {
  return erase_.bind(1, std::int64_t{index.z})
      .bind(2, std::int64_t{index.y})
      .bind(3, std::int64_t{index.x})
      .run();
}

Status MapFile::put_meta(const std::string& key, const std::string& value) {
  return put_meta_.bind(1, key).bind(2, value).run();
}

Status MapFile::put_checksum(const MapChecksum& checksum) {
  return put_checksum_.bind(1, checksum.blocks)
      .bind(2, as_signed(checksum.block_digest))
      .bind(3, as_signed(checksum.meta_digest))
      .run();
}

Status MapFile::oldest(std::int64_t count, const VisitRow& visit) {
  return visit_rows(oldest_.bind(1, count), visit);
}

Expected<std::int64_t> MapFile::pages_in_use() {
  auto total = page_count_.step();
  if (!total) return forward_error(std::move(total));
  const std::int64_t pages = page_count_.integer(0);
  page_count_.reset();
  auto unused = free_pages_.step();
  if (!unused) return forward_error(std::move(unused));
  const std::int64_t free_pages = free_pages_.integer(0);
  free_pages_.reset();
  return pages - free_pages;
}

}  // namespace swiftlet
