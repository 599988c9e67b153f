// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Source: "Database File Format", sqlite.org/fileformat2.html, sections 1.3 to 1.6 and 2.1.

#include "swiftlet/store/map_file/map_pages.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace swiftlet {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kPage = 4096;
constexpr std::size_t kFileHeader = 100;
constexpr std::size_t kMaxColumns = 8;                         // our tables have up to six
constexpr std::uint64_t kMaxRecord = std::uint64_t{1} << 24U;  // a config is some kilobytes

constexpr std::uint8_t kInnerIndex = 2, kInnerTable = 5, kLeafIndex = 10, kLeafTable = 13;

std::uint32_t number_at(Bytes bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value = value << 8U | bytes[at + i];
  return value;
}

/// A number of one to nine bytes; moves `at` behind it.
std::optional<std::uint64_t> variable_number(Bytes bytes, std::size_t& at) {
  std::uint64_t value = 0;
  for (int i = 0; i < 9; ++i) {
    if (at >= bytes.size()) return std::nullopt;
    const std::uint8_t byte = bytes[at++];
    if (i == 8) return value << 8U | byte;
    value = value << 7U | (byte & 0x7fU);
    if (byte < 0x80) return value;
  }
  return value;
}

std::int64_t signed_number(Bytes bytes) {
  std::uint64_t value = !bytes.empty() && bytes[0] >= 0x80 ? ~std::uint64_t{0} : 0;
  for (const std::uint8_t byte : bytes) value = value << 8U | byte;
  return static_cast<std::int64_t>(value);
}

std::optional<MapPages::Column> column_of(std::uint64_t type, Bytes record, std::size_t at) {
  using Kind = MapPages::Column::Kind;
  constexpr std::array<std::size_t, 7> kIntegerSizes{0, 1, 2, 3, 4, 6, 8};
  MapPages::Column column;
  column.at = at;
  if (type == 0) return column;
  if (type == 8 || type == 9) {
    column.kind = Kind::kInteger;
    column.integer = static_cast<std::int64_t>(type - 8);
    return column;
  }
  if (type == 10 || type == 11) return std::nullopt;  // never in a file
  const std::uint64_t size = type < 7 ? kIntegerSizes[type] : type == 7 ? 8 : (type - 12) / 2;
  if (at > record.size() || size > record.size() - at) return std::nullopt;
  column.bytes = record.subspan(at, static_cast<std::size_t>(size));
  column.kind = type < 7        ? Kind::kInteger
                : type == 7     ? Kind::kOther
                : type % 2 == 0 ? Kind::kBlob
                                : Kind::kText;
  if (type < 7) column.integer = signed_number(column.bytes);
  return column;
}

/// The columns of a record; none if it is no record.
std::vector<MapPages::Column> columns_of(Bytes record) {
  std::vector<MapPages::Column> columns;
  std::size_t at = 0;
  const auto header = variable_number(record, at);
  if (!header || *header > record.size()) return {};
  auto value_at = static_cast<std::size_t>(*header);
  while (at < *header) {
    const auto type = variable_number(record.first(static_cast<std::size_t>(*header)), at);
    if (!type || columns.size() == kMaxColumns) return {};
    const auto column = column_of(*type, record, value_at);
    if (!column) return {};
    value_at += column->bytes.size();
    columns.push_back(*column);
  }
  return columns;
}

/// How many bytes of a record lie in its page (section 1.6).
std::uint64_t bytes_here(std::uint64_t size, bool is_index) {
  const std::uint64_t most = is_index ? (kPage - 12) * 64 / 255 - 23 : kPage - 35;
  if (size <= most) return size;
  const std::uint64_t least = (kPage - 12) * 32 / 255 - 23;
  const std::uint64_t wanted = least + (size - least) % (kPage - 4);
  return wanted <= most ? wanted : least;
}

}  // namespace

Expected<MapPages> MapPages::open(const std::filesystem::path& path) {
  MapPages pages;
  pages.file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  struct stat file {};
  if (pages.file_ < 0 || fstat(pages.file_, &file) != 0 || !S_ISREG(file.st_mode)) {
    const int reason = pages.file_ < 0 ? errno : S_ISDIR(file.st_mode) ? EISDIR : EINVAL;
    return fail(reason == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo, path.string(),
                "the map cannot be read (" + std::generic_category().message(reason) + ")");
  }
  // A last page that is cut off counts: some of its records may be whole.
  const auto count = (static_cast<std::uint64_t>(file.st_size) + kPage - 1) / kPage;
  pages.count_ = static_cast<std::uint32_t>(std::min<std::uint64_t>(count, 0xfffffffeU));
  pages.find_free_pages();
  return pages;
}

MapPages::MapPages(MapPages&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      count_(other.count_),
      is_free_(std::move(other.is_free_)) {}

MapPages::~MapPages() {
  if (file_ >= 0) close(file_);
}

bool MapPages::read(std::uint64_t at, std::span<std::uint8_t> out) const {
  while (!out.empty()) {
    const ssize_t size = pread(file_, out.data(), out.size(), static_cast<off_t>(at));
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return false;
    at += static_cast<std::uint64_t>(size);
    out = out.subspan(static_cast<std::size_t>(size));
  }
  return true;
}

/// What lies in free pages was true once and is no more. A list that is damaged ends where it is.
void MapPages::find_free_pages() {
  is_free_.assign(std::size_t{count_} + 1, false);
  std::array<std::uint8_t, kPage> page{};
  if (!read(0, std::span(page).first(kFileHeader))) return;
  std::uint32_t trunk = number_at(page, 32, 4);
  while (trunk > 1 && trunk <= count_ && !is_free_[trunk]) {
    if (!read((trunk - std::uint64_t{1}) * kPage, page)) return;
    const std::uint32_t leaves = number_at(page, 4, 4);
    if (leaves > kPage / 4 - 2) return;  // no page of the list
    is_free_[trunk] = true;
    for (std::uint32_t i = 0; i < leaves; ++i) {
      const std::uint32_t leaf = number_at(page, 8 + 4 * std::size_t{i}, 4);
      if (leaf > 1 && leaf <= count_) is_free_[leaf] = true;
    }
    trunk = number_at(page, 0, 4);
  }
}

Status MapPages::for_each(const VisitRecord& record, const VisitPage& page) const {
  std::array<std::uint8_t, kPage> bytes{};
  std::uint32_t budget = count_;  // a page belongs to one chain: more are a loop
  for (std::uint32_t number = 1; number <= count_; ++number) {
    if (is_free_[number]) continue;
    const std::uint64_t at = (number - std::uint64_t{1}) * kPage;
    bytes.fill(0);
    if (!read(at, bytes)) {  // cut off, or the disk refuses: piece by piece
      constexpr std::size_t kSector = 512;
      for (std::size_t i = 0; i < kPage; i += kSector) {
        (void)read(at + i, std::span(bytes).subspan(i, kSector));
      }
    }
    visit_page(number, bytes, budget, record, page);
  }
  return Done{};
}

bool MapPages::append_overflow(std::uint32_t next, std::uint64_t size, std::uint32_t& budget,
                               std::vector<std::uint8_t>& record) const {
  std::array<std::uint8_t, kPage> page{};
  while (record.size() < size) {
    if (next < 2 || next > count_ || budget-- == 0) return false;
    if (!read((next - std::uint64_t{1}) * kPage, page)) return false;
    const auto more = std::min<std::uint64_t>(size - record.size(), kPage - 4);
    const Bytes part = Bytes(page).subspan(4, static_cast<std::size_t>(more));
    record.insert(record.end(), part.begin(), part.end());
    next = number_at(page, 0, 4);
  }
  return true;
}

/// Fills `whole` with the record whose voxel begins at `at`, which moves to where its bytes begin.
bool MapPages::read_record(Bytes page, bool is_index, std::size_t& at, std::uint32_t& budget,
                           std::vector<std::uint8_t>& whole) const {
  const auto size = variable_number(page, at);
  if (size && !is_index) (void)variable_number(page, at);  // the number of the row
  if (!size || *size > kMaxRecord) return false;
  const auto here = static_cast<std::size_t>(bytes_here(*size, is_index));
  if (at + here > kPage) return false;
  const Bytes local = page.subspan(at, here);
  whole.assign(local.begin(), local.end());
  if (here == *size) return true;
  return at + here + 4 <= kPage &&
         append_overflow(number_at(page, at + here, 4), *size, budget, whole);
}

void MapPages::visit_page(std::uint32_t number, Bytes bytes, std::uint32_t& budget,
                          const VisitRecord& visit, const VisitPage& visit_whole) const {
  const std::size_t start = number == 1 ? kFileHeader : 0;
  const std::uint8_t type = bytes[start];
  const bool is_inner = type == kInnerIndex || type == kInnerTable;
  const bool is_index = type == kInnerIndex || type == kLeafIndex;
  Page page{number, 0, is_inner, !is_inner && !is_index && type != kLeafTable};
  const std::size_t pointers = start + (is_inner ? 12 : 8);
  const std::size_t voxels = page.is_damaged ? 0 : number_at(bytes, start + 3, 2);
  if (is_inner) page.last_child = number_at(bytes, start + 8, 4);
  std::vector<std::uint8_t> whole;
  for (std::size_t i = 0; i < voxels && type != kInnerTable; ++i) {
    if (pointers + 2 * i + 2 > kPage) {
      page.is_damaged = true;
      break;
    }
    std::size_t at = number_at(bytes, pointers + 2 * i, 2);
    std::uint32_t left = 0;
    if (is_inner && at + 4 <= kPage) {
      left = number_at(bytes, at, 4);
      at += 4;
    }
    const bool is_good = read_record(bytes, is_index, at, budget, whole);
    const auto columns = is_good ? columns_of(whole) : std::vector<Column>{};
    page.is_damaged = page.is_damaged || columns.empty();
    if (columns.empty()) continue;
    const bool is_whole_here = bytes_here(whole.size(), is_index) == whole.size();
    visit({columns, (number - std::uint64_t{1}) * kPage + at, is_whole_here, left});
  }
  visit_whole(page);
}

}  // namespace swiftlet
