// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/real_time_source.hpp"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "swiftlet/base/contract.hpp"

namespace swiftlet {
namespace {

class RealTimeSource final : public FrameSource {
 public:
  RealTimeSource(FrameSourcePtr source, const QueuePolicy& policy)
      : source_(std::move(source)), info_(source_->info()), policy_(policy) {
    if (source_->statistics() != nullptr) facts_ = source_facts_ = *source_->statistics();
    source_->stop_when([this] {  // asked by the player
      const std::lock_guard lock(mutex_);
      ask_source();
      return is_stopped_;
    });
    player_ = std::thread([this] { play(); });
  }
  RealTimeSource(const RealTimeSource&) = delete;
  RealTimeSource& operator=(const RealTimeSource&) = delete;
  ~RealTimeSource() override {
    {
      const std::lock_guard lock(mutex_);
      is_stopped_ = true;
    }
    changed_.notify_all();
    player_.join();
  }

  /// Waits for the next frame.
  Expected<std::optional<Frame>> next() override {
    std::unique_lock lock(mutex_);
    bool is_unwanted = false;
    while (!is_unwanted && !changed_.wait_for(lock, kPollPeriod,
                                              [this] { return !queue_.empty() || is_played_; })) {
      take_stock();
      lock.unlock();  // it is somebody else's function
      is_unwanted = is_unwanted_ && is_unwanted_();
      lock.lock();
    }
    take_stock();
    if (!queue_.empty()) {
      Frame frame = std::move(queue_.front());
      queue_.pop_front();
      tally_.delivered = ++delivered_;
      return frame;
    }
    if (fault_) return tl::make_unexpected(*std::exchange(fault_, std::nullopt));
    return std::nullopt;
  }

  const SourceInfo& info() const override { return info_; }
  const FrameTally& tally() const override { return tally_; }
  const RigStatistics* statistics() const override { return facts_ ? &*facts_ : nullptr; }
  const RigOptions* rig() const override { return source_->rig(); }  // never changes
  void stop_when(const std::function<bool()>& is_unwanted) override { is_unwanted_ = is_unwanted; }
  std::vector<RigEvent> take_events() override {
    const std::lock_guard lock(mutex_);
    return events_.take();
  }

 private:
  using Clock = HostTime::clock;
  static constexpr Nanoseconds kLongestWait = std::chrono::minutes(1);
  static constexpr Nanoseconds kPollPeriod = std::chrono::milliseconds(100);  // at whether to go on

  /// REQUIRES: the lock.
  void take_stock() {
    tally_ = source_tally_;
    facts_ = source_facts_;
    tally_.of(FrameLoss::kOverload) += overloaded_;
    tally_.delivered = delivered_;
  }

  /// By the player. REQUIRES: the lock.
  void ask_source() {
    source_tally_ = source_->tally();
    if (source_facts_) source_facts_ = *source_->statistics();
    for (RigEvent& event : source_->take_events()) events_.add(std::move(event));
  }

  void play() {
    std::optional<Stamp> first;
    Clock::time_point start;
    Stamp previous;
    while (true) {
      auto frame = source_->next();
      if (!frame || !*frame) return finish(std::move(frame));
      const Nanoseconds step = first ? (*frame)->stamp - previous : Nanoseconds(0);
      previous = (*frame)->stamp;
      if (!first || step < Nanoseconds(0) || step > kLongestWait) {  // or the clock was set
        first = (*frame)->stamp;
        start = Clock::now();
      }
      const double due_s = seconds((*frame)->stamp - *first) / policy_.speed;
      const auto due =
          start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due_s));
      if (!deliver(std::move(**frame), due)) return;
    }
  }

  /// false if nobody wants it any more.
  bool deliver(Frame frame, Clock::time_point due) {
    frame.seen_at = due;
    std::unique_lock lock(mutex_);
    if (changed_.wait_until(lock, due, [this] { return is_stopped_; })) return false;
    if (queue_.size() == policy_.capacity) {
      queue_.pop_front();
      ++overloaded_;
    }
    queue_.push_back(std::move(frame));
    ask_source();
    changed_.notify_all();
    return true;
  }

  void finish(Expected<std::optional<Frame>>&& end) {
    const std::lock_guard lock(mutex_);
    if (!end) fault_ = std::move(end).error();
    ask_source();
    is_played_ = true;
    changed_.notify_all();
  }

  FrameSourcePtr source_;  // the player's
  const SourceInfo info_;
  const QueuePolicy policy_;
  FrameTally tally_;  // the reader's, as are these
  std::optional<RigStatistics> facts_;
  std::size_t delivered_ = 0;
  std::function<bool()> is_unwanted_;

  std::mutex mutex_;  // of all that follows
  std::condition_variable changed_;
  std::deque<Frame> queue_;
  FrameTally source_tally_;
  std::optional<RigStatistics> source_facts_;  // nullopt: it is no rig
  RigEventList events_;
  std::size_t overloaded_ = 0;
  std::optional<Error> fault_;
  bool is_played_ = false;
  bool is_stopped_ = false;

  std::thread player_;
};

}  // namespace

FrameSourcePtr play_in_real_time(FrameSourcePtr source, const QueuePolicy& policy) {
  SWIFTLET_REQUIRE(source != nullptr && policy.capacity >= 1 && policy.speed > 0.0,
                   "a queue holds a frame, and time goes on");
  return std::make_unique<RealTimeSource>(std::move(source), policy);
}

}  // namespace swiftlet
