// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/stream/batch_writer.hpp"

#include <algorithm>
#include <string>

namespace swiftlet {
namespace {

/// Pages kept free before each block. One row of at most 0.7 kB can split a path of the two
/// B-trees, at most five levels each for any file below 1 TB.
constexpr std::int64_t kReservePages = 12;
constexpr std::int64_t kOldestAtOnce = 64;

bool is_wanted(const BatchWriter::Content& content, std::size_t number) {
  return !content.part || (number >= content.part->first && number < content.part->last);
}

}  // namespace

Expected<BatchWriter> BatchWriter::open(const std::filesystem::path& path, StorePolicy policy,
                                        std::uint64_t max_bytes, MapLock lock) {
  auto file = MapFile::open_to_write(path, max_bytes, std::move(lock));
  if (!file) return forward_error(std::move(file));
  auto meta = file->meta();
  if (!meta) return forward_error(std::move(meta));
  auto checksum = file->checksum();
  if (!checksum) return forward_error(std::move(checksum));
  BatchWriter writer(std::move(*file), policy, max_bytes);
  writer.meta_ = std::move(*meta);
  writer.checksum_ = *checksum;
  return writer;
}

bool BatchWriter::holds(const BlockIndex& index) const {
  const auto known = known_.find(index);
  return known != known_.end() && known->second.is_stored;
}

std::size_t BatchWriter::unwritten(const MapSnapshot& window) const {
  std::size_t count = 0;
  window.for_each_known_block([&](const BlockIndex& index, const VoxelBlock&) {
    const auto known = known_.find(index);
    count += known == known_.end() || known->second.order < 2 * window.version(index) ? 1 : 0;
  });
  return count;
}

Expected<BatchWriter::Report> BatchWriter::write(const Content& content) {
  const MapChecksum before = checksum_;
  const MapMeta meta = meta_;
  const std::uint64_t frames = frames_;
  const auto window = window_;
  undo_.clear();
  Report report;
  Status status = file_.begin();
  if (!status) return forward_error(std::move(status));
  status = write_all(content, report);
  if (status) status = file_.commit();
  if (status) return report;
  file_.rollback();
  undo();
  checksum_ = before;
  meta_ = meta;
  frames_ = frames;
  window_ = window;
  return forward_error(std::move(status));
}

Status BatchWriter::write_all(const Content& content, Report& report) {
  if (content.window != nullptr) {
    if (auto done = write_window(content, report); !done) return done;
  }
  if (content.evicted != nullptr && policy_ == StorePolicy::kKeep) {
    if (auto done = write_evicted(content, report); !done) return done;
  }
  if (content.window != nullptr && !content.part && policy_ == StorePolicy::kDrop) {
    if (auto done = erase_outside(*content.window, report); !done) return done;
  }
  MapMeta meta = content.meta == nullptr ? MapMeta{} : *content.meta;
  meta["frames"] = std::to_string(frames_);
  if (auto done = write_meta(meta); !done) return done;
  if (auto done = file_.put_checksum(checksum_); !done) return done;
  auto pages = file_.pages_in_use();
  if (!pages) return forward_error(std::move(pages));
  pages_ = *pages;
  return Done{};
}

Status BatchWriter::write_window(const Content& content, Report& report) {
  const MapSnapshot& window = *content.window;
  if (!content.part) frames_ = std::max(frames_, window.frame_count());
  window_ = window.window();
  Status status = Done{};
  std::size_t number = 0;
  window.for_each_known_block([&](const BlockIndex& index, const VoxelBlock& block) {
    if (!status || !is_wanted(content, number++)) return;
    status = put(index, block, 2 * window.version(index) + 1, report);
  });
  return status;
}

Status BatchWriter::write_evicted(const Content& content, Report& report) {
  Status status = Done{};
  std::size_t number = 0;
  content.evicted->for_each(
      [&](const BlockIndex& index, const VoxelBlock& block, std::uint64_t version) {
        if (!status || !is_wanted(content, number++)) return;
        status = put(index, block, 2 * version, report);
      });
  return status;
}

Status BatchWriter::put(const BlockIndex& index, const VoxelBlock& block, std::uint64_t order,
                        Report& report) {
  const auto found = known_.find(index);
  const Known old = found == known_.end() ? Known{} : found->second;
  const bool is_snapshot = order % 2 == 1;
  const bool is_newer = is_snapshot ? order > old.order : order >= old.order;
  // A block that the cap dropped while it was in the window is offered once more when it leaves.
  const bool leaves_unstored = !is_snapshot && !old.is_stored && order + 1 >= old.order;
  if (!is_newer && !leaves_unstored) return Done{};

  if (auto room = make_room(report); !room) return room;
  BlockRow row{index, static_cast<std::int64_t>(frames_), 0, codec_.compress(block)};
  row.checksum = block_checksum(row.index, row.touched, row.data);
  if (auto done = file_.put(row); !done) return done;
  // make_room() may have dropped the older state of this very block.
  const auto present = known_.find(index);
  if (present != known_.end() && present->second.is_stored) {
    checksum_.block_digest -= present->second.checksum;
  } else {
    ++checksum_.blocks;
  }
  checksum_.block_digest += row.checksum;
  set_known(index, Known{order, row.checksum, true});
  report.written.push_back(index);
  return Done{};
}

Status BatchWriter::erase(const BlockIndex& index, bool forget, Report& report) {
  if (auto done = file_.erase(index); !done) return done;
  const auto found = known_.find(index);
  if (found == known_.end() || !found->second.is_stored) {
    return fail(ErrorCode::kCorruptInput, "map", "another program has changed the map file");
  }
  Known known = found->second;
  --checksum_.blocks;
  checksum_.block_digest -= known.checksum;
  known.is_stored = false;
  set_known(index, forget ? std::nullopt : std::optional(known));
  report.erased.push_back(index);
  return Done{};
}

Status BatchWriter::erase_outside(const MapSnapshot& window, Report& report) {
  std::vector<BlockIndex> gone;
  for (const auto& [index, known] : known_) {
    if (window.find(index) == nullptr) gone.push_back(index);
  }
  for (const BlockIndex& index : gone) {
    if (holds(index)) {
      if (auto done = erase(index, true, report); !done) return done;
    }
    set_known(index, std::nullopt);
  }
  return Done{};
}

/// Drops the blocks touched longest ago until the next row fits, whatever pages it splits.
Status BatchWriter::make_room(Report& report) {
  if (max_bytes_ == 0) return Done{};
  const auto limit = static_cast<std::int64_t>(max_bytes_) / MapFile::kPageBytes - kReservePages;
  for (;;) {
    auto pages = file_.pages_in_use();
    if (!pages) return forward_error(std::move(pages));
    if (*pages <= limit || checksum_.blocks == 0) return Done{};
    std::vector<BlockIndex> oldest;
    auto listed = file_.oldest(kOldestAtOnce, [&](const BlockRow& row) -> Status {
      oldest.push_back(row.index);
      return Done{};
    });
    if (!listed) return listed;
    for (const BlockIndex& index : oldest) {
      // In the window its version must be remembered, or the next batch would write it again.
      const bool is_in_window = window_ && window_->contains(index);
      if (auto done = erase(index, !is_in_window, report); !done) return done;
      ++report.dropped_by_cap;
      pages = file_.pages_in_use();
      if (!pages) return forward_error(std::move(pages));
      if (*pages <= limit) break;
    }
  }
}

Status BatchWriter::write_meta(const MapMeta& meta) {
  for (const auto& [key, value] : meta) {
    const auto old = meta_.find(key);
    if (old != meta_.end() && old->second == value) continue;
    if (old != meta_.end()) checksum_.meta_digest -= meta_checksum(key, old->second);
    if (auto done = file_.put_meta(key, value); !done) return done;
    checksum_.meta_digest += meta_checksum(key, value);
    meta_[key] = value;
  }
  return Done{};
}

void BatchWriter::set_known(const BlockIndex& index, const std::optional<Known>& known) {
  const auto old = known_.find(index);
  undo_.emplace_back(index, old == known_.end() ? std::nullopt : std::optional(old->second));
  if (known) {
    known_[index] = *known;
  } else if (old != known_.end()) {
    known_.erase(old);
  }
}

void BatchWriter::undo() {
  std::for_each(undo_.rbegin(), undo_.rend(), [this](const auto& change) {
    const auto& [index, before] = change;
    if (before) {
      known_[index] = *before;
    } else {
      known_.erase(index);
    }
  });
  undo_.clear();
}

}  // namespace swiftlet
