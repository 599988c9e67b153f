// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <deque>
#include <utility>

#include "swiftlet/station/client_protocol.hpp"
#include "swiftlet/station/page/client_message.hpp"
#include "swiftlet/station/state/token_bucket.hpp"

namespace swiftlet::station {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kFramesKept = 512;  // for a slow client; older ones are left out
constexpr std::size_t kFramesPerMessage = 64;
constexpr auto kStatusEvery = 200ms;
constexpr double kCourseShare = 0.1;        // of a capped link, at most
constexpr std::uint32_t kLeastRate = 2000;  // [bytes/s]: less than that shows nothing

class PageProtocol final : public ClientProtocol {
 public:
  explicit PageProtocol(const MapModel& model) : model_(model) { queue_.start_again(model.map()); }

  void saw(const MapModel::Update& update) override {
    if (update.is_new_world) {
      needs_hello_ = true;
      frames_.clear();
      queue_.start_again(model_.map());
    } else {
      queue_.mark(update.changed, model_.map());
    }
    has_course_ = has_course_ || update.has_course;
    is_confirmed_ = is_confirmed_ && update.changed.empty() && !update.is_new_world;
    for (const FrameReport& frame : update.frames) frames_.push_back(frame);
    while (frames_.size() > kFramesKept) frames_.pop_front();
  }

  void count(std::uint32_t clients) override { clients_ = clients; }

  std::optional<Outgoing> next(Time now) override {
    if (needs_hello_ && model_.world() > 0) {
      needs_hello_ = false;
      has_course_ = model_.course().has_value();
      const std::string text = hello_text(model_.info(), model_.world());
      return Outgoing{true, Bytes(text.begin(), text.end())};
    }
    if (model_.world() == 0 || pace_ == Pace::kHold || !bucket_.is_open(now)) return std::nullopt;
    Bytes message = next_message(now);
    if (message.empty()) return std::nullopt;
    bucket_.spend(static_cast<double>(message.size()));
    return Outgoing{false, std::move(message)};
  }

  Status received(bool is_text, std::span<const std::uint8_t> bytes, Time now) override {
    if (is_text) return fail(ErrorCode::kCorruptInput, "client message", "a text");
    auto message = parse_client_message(bytes);
    if (!message) return forward_error(std::move(message));
    if (const auto* resend = std::get_if<Resend>(&*message)) {
      queue_.resend(resend->first, resend->last, model_.map());
      is_confirmed_ = false;
    } else if (std::holds_alternative<SendAll>(*message)) {
      queue_.start_again(model_.map());
      is_confirmed_ = false;
    } else if (const auto* pace = std::get_if<SetPace>(&*message)) {
      pace_ = pace->pace;
      is_confirmed_ = is_confirmed_ && pace_ != Pace::kStep;  // a step ends with a checksum
    } else if (const auto* rate = std::get_if<SetRate>(&*message)) {
      limit(rate->bytes_per_s, now);
    }
    return Done{};
  }

 private:
  void limit(std::uint32_t bytes_per_s, Time now) {
    rate_ = bytes_per_s == 0 ? 0 : std::max(bytes_per_s, kLeastRate);
    // A tenth of a second at once: what waits in the socket is old before it arrives.
    bucket_ = rate_ == 0 ? TokenBucket() : TokenBucket(rate_, rate_ * 0.1, now);
  }

  /// Status, frames and blocks in turn, so that none starves another on a slow link.
  Bytes next_message(Time now) {
    if (now - last_status_ >= kStatusEvery) {
      last_status_ = now;
      return status_message(header(), status());
    }
    if (has_course_ && now >= next_course_) return next_course(now);
    const bool is_frames_turn = std::exchange(was_blocks_turn_, !was_blocks_turn_);
    if (!frames_.empty() && (is_frames_turn || queue_.is_up_to_date())) return next_frames();
    if (!queue_.is_up_to_date()) return next_blocks();
    if (!frames_.empty()) return next_frames();
    if (is_confirmed_) return {};
    is_confirmed_ = true;
    if (pace_ == Pace::kStep) pace_ = Pace::kHold;
    return checksum_message(header(), model_.map().frame_count(), model_.map().digest());
  }

  Bytes next_frames() {
    const auto count = static_cast<std::ptrdiff_t>(std::min(frames_.size(), kFramesPerMessage));
    const std::vector<FrameReport> some(frames_.begin(), frames_.begin() + count);
    frames_.erase(frames_.begin(), frames_.begin() + count);
    return frames_message(header(), some);
  }

  Bytes next_course(Time now) {
    has_course_ = false;
    Bytes message = course_message(header(), *model_.course());
    const double seconds =
        rate_ == 0 ? 0.0 : static_cast<double>(message.size()) / (rate_ * kCourseShare);
    next_course_ =
        now + std::max<Time::duration>(kStatusEvery, std::chrono::duration_cast<Time::duration>(
                                                         std::chrono::duration<double>(seconds)));
    return message;
  }

  Bytes next_blocks() {
    ClientQueue::Batch batch = queue_.next(model_.centre());
    const MessageHeader head = header();
    Bytes message = packer_.blocks_message(head, batch, model_.map());
    queue_.sent(head.sequence, std::move(batch));
    return message;
  }

  MessageHeader header() { return {sequence_++, model_.world()}; }

  StatusReport status() const {
    StatusReport status = model_.status();
    status.pending = static_cast<std::uint32_t>(queue_.pending());
    status.clients = clients_;
    status.rate_limit = rate_;
    return status;
  }

  const MapModel& model_;
  ClientQueue queue_;
  BlockPacker packer_;
  TokenBucket bucket_;
  std::deque<FrameReport> frames_;
  std::uint32_t sequence_ = 0;
  std::uint32_t clients_ = 0;
  std::uint32_t rate_ = 0;
  Time last_status_{};
  Time next_course_{};
  Pace pace_ = Pace::kFlow;
  bool needs_hello_ = true;
  bool has_course_ = false;
  bool is_confirmed_ = false;
  bool was_blocks_turn_ = false;
};

}  // namespace

std::unique_ptr<ClientProtocol> make_page_protocol(const MapModel& model) {
  return std::make_unique<PageProtocol>(model);
}

}  // namespace swiftlet::station
