// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/distance/distance_field_thread.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace swiftlet {

/// The fields of one thread and who holds them; as SnapshotStore, with one writer that fills a slot
/// that nobody holds.
class DistanceFieldStore : public std::enable_shared_from_this<DistanceFieldStore> {
 public:
  static constexpr int kNone = -1;

  explicit DistanceFieldStore(std::vector<DistanceField> fields) : fields_(std::move(fields)) {}

  /// Of the slots that are free, the one that has the newest field: it has least to catch up with.
  [[nodiscard]] int take_for_writing() {
    int best = kNone;
    for (int i = 0; i < DistanceFieldThread::kFields; ++i) {
      if (i == latest_.load()) continue;
      if (best != kNone && frame_of(i) <= frame_of(best)) continue;
      std::int32_t nobody = 0;
      if (!holders_[at(i)].compare_exchange_strong(nobody, kBusy)) continue;
      if (best != kNone) holders_[at(best)].fetch_sub(kBusy);
      best = i;
    }
    return best;
  }
  [[nodiscard]] DistanceField& field(int slot) { return fields_[at(slot)]; }
  void publish(int slot) {
    holders_[at(slot)].fetch_sub(kBusy);
    latest_.store(slot);
  }

  [[nodiscard]] std::optional<HeldDistanceField> latest() {
    for (;;) {
      const int slot = latest_.load();
      if (slot == kNone) return std::nullopt;
      // Sequentially consistent with take_for_writing(): who finds the slot busy, or no longer the
      // latest, lets go without looking at it.
      const std::int32_t before = holders_[at(slot)].fetch_add(1);
      if (before < kBusy && latest_.load() == slot)
        return HeldDistanceField(shared_from_this(), slot, &fields_[at(slot)]);
      release(slot);
    }
  }
  void hold(int slot) { holders_[at(slot)].fetch_add(1); }
  void release(int slot) { holders_[at(slot)].fetch_sub(1); }

 private:
  static constexpr std::int32_t kBusy = 1 << 30;  // set while the writer fills a slot
  static std::size_t at(int slot) { return static_cast<std::size_t>(slot); }
  [[nodiscard]] std::uint64_t frame_of(int slot) const { return fields_[at(slot)].frame_count(); }

  std::vector<DistanceField> fields_;
  std::array<std::atomic<std::int32_t>, DistanceFieldThread::kFields> holders_{};
  std::atomic<int> latest_{kNone};
};

HeldDistanceField::HeldDistanceField(std::shared_ptr<DistanceFieldStore> store, int slot,
                                     const DistanceField* field)
    : store_(std::move(store)), slot_(slot), field_(field) {}

HeldDistanceField::HeldDistanceField(const HeldDistanceField& other)
    : store_(other.store_), slot_(other.slot_), field_(other.field_) {
  if (store_) store_->hold(slot_);
}

HeldDistanceField::HeldDistanceField(HeldDistanceField&& other) noexcept
    : store_(std::move(other.store_)), slot_(other.slot_), field_(other.field_) {
  other.store_ = nullptr;
}

HeldDistanceField& HeldDistanceField::operator=(HeldDistanceField other) noexcept {
  std::swap(store_, other.store_);
  std::swap(slot_, other.slot_);
  std::swap(field_, other.field_);
  return *this;
}

HeldDistanceField::~HeldDistanceField() {
  if (store_) store_->release(slot_);
}

/// The thread itself.
class DistanceFieldThread::Worker {
 public:
  Worker(MapReader reader, std::vector<DistanceField> fields)
      : reader_(std::move(reader)),
        store_(std::make_shared<DistanceFieldStore>(std::move(fields))),
        thread_([this] { follow(); }) {}
  ~Worker() {
    is_closing_ = true;
    thread_.join();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  [[nodiscard]] DistanceFieldStore& store() { return *store_; }
  [[nodiscard]] Tally tally() const { return {published_, skipped_}; }

 private:
  void follow() {
    while (!is_closing_) {
      if (!publish_newest()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  /// false if there is nothing to do now. Lets go of the map before it returns.
  bool publish_newest() {
    const std::optional<MapSnapshot> map = reader_.latest();
    if (!map || map->frame_count() == last_frame_) return false;
    const int slot = store_->take_for_writing();
    if (slot == DistanceFieldStore::kNone) {
      if (map->frame_count() != last_skipped_) ++skipped_;
      last_skipped_ = map->frame_count();
      return false;
    }
    store_->field(slot).update(*map);
    last_frame_ = map->frame_count();
    store_->publish(slot);
    ++published_;
    return true;
  }

  MapReader reader_;
  std::shared_ptr<DistanceFieldStore> store_;
  std::optional<std::uint64_t> last_frame_, last_skipped_;
  std::atomic<std::uint64_t> published_{0}, skipped_{0};
  std::atomic<bool> is_closing_{false};
  std::thread thread_;  // last: it uses all the others
};

Expected<DistanceFieldThread> DistanceFieldThread::start(MapReader reader, double voxel_m,
                                                         const BlockIndex& window_size,
                                                         const DistanceFieldOptions& options) {
  std::vector<DistanceField> fields;
  for (int i = 0; i < kFields; ++i) {
    auto field = DistanceField::create(voxel_m, window_size, options);
    if (!field) return forward_error(std::move(field));
    fields.push_back(std::move(*field));
  }
  return DistanceFieldThread(std::make_unique<Worker>(std::move(reader), std::move(fields)));
}

DistanceFieldThread::DistanceFieldThread(std::unique_ptr<Worker> worker)
    : worker_(std::move(worker)) {}
DistanceFieldThread::DistanceFieldThread(DistanceFieldThread&& other) noexcept = default;
DistanceFieldThread& DistanceFieldThread::operator=(DistanceFieldThread&& other) noexcept = default;
DistanceFieldThread::~DistanceFieldThread() = default;

std::optional<HeldDistanceField> DistanceFieldThread::latest() const {
  return worker_->store().latest();
}

DistanceFieldThread::Tally DistanceFieldThread::tally() const { return worker_->tally(); }

}  // namespace swiftlet
