// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// The pages of a map file, one by one, as they lie there: what of a database can still be read
/// when SQLite cannot follow it any more. Knows of SQLite's file format what a map needs: B-tree
/// pages of 4096 bytes, records, overflow chains, the list of free pages. Trusts no byte; work and
/// memory are bounded by the size of the file.
class MapPages {
 public:
  /// One column of a record.
  struct Column {
    enum class Kind : std::uint8_t { kNull, kInteger, kText, kBlob, kOther } kind = Kind::kNull;
    std::int64_t integer = 0;
    std::span<const std::uint8_t> bytes;
    std::size_t at = 0;  ///< of the bytes in the record

    [[nodiscard]] std::string_view text() const {
      return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
  };
  struct Record {
    std::span<const Column> columns;
    std::uint64_t at = 0;         ///< byte of the file where the record begins
    bool is_whole_here = true;    ///< false: the rest of it lies in other pages
    std::uint32_t left_page = 0;  ///< in an inner page: the page with what comes before it
  };
  struct Page {
    std::uint32_t number = 0;      ///< from 1
    std::uint32_t last_child = 0;  ///< in an inner page: the page with what comes after its records
    bool is_inner = false;
    bool is_damaged = false;  ///< no page of a B-tree, or some of its records cannot be read
  };

  /// Errors: kNotFound, kIo.
  [[nodiscard]] static Expected<MapPages> open(const std::filesystem::path& path);
  MapPages(MapPages&& other) noexcept;
  MapPages& operator=(MapPages&&) = delete;
  ~MapPages();

  [[nodiscard]] std::uint32_t count() const { return count_; }

  using VisitRecord = std::function<void(const Record&)>;
  using VisitPage = std::function<void(const Page&)>;
  /// Every record of every page in use, then the page itself.
  /// What a page holds that is neither a B-tree nor free (a part of an overflow chain) is damaged
  /// to this function, which cannot tell.
  [[nodiscard]] Status for_each(const VisitRecord& record, const VisitPage& page) const;

  /// Reads bytes of the file; false if they are not there.
  [[nodiscard]] bool read(std::uint64_t at, std::span<std::uint8_t> out) const;

 private:
  MapPages() = default;
  void find_free_pages();
  void visit_page(std::uint32_t number, std::span<const std::uint8_t> bytes, std::uint32_t& budget,
                  const VisitRecord& record, const VisitPage& page) const;
  [[nodiscard]] bool read_record(std::span<const std::uint8_t> page, bool is_index, std::size_t& at,
                                 std::uint32_t& budget, std::vector<std::uint8_t>& whole) const;
  /// The rest of a record whose first overflow page is `next`; false if the chain is broken.
  [[nodiscard]] bool append_overflow(std::uint32_t next, std::uint64_t size, std::uint32_t& budget,
                                     std::vector<std::uint8_t>& record) const;

  int file_ = -1;
  std::uint32_t count_ = 0;
  std::vector<bool> is_free_;  // by number
};

}  // namespace swiftlet
