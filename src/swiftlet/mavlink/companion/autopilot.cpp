// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/companion/autopilot.hpp"

#include <fmt/format.h>

#include <mutex>
#include <utility>

namespace swiftlet::mavlink {
namespace {

class RunningAutopilot final : public Autopilot, private LinkUser {
 public:
  explicit RunningAutopilot(const AutopilotOptions& options)
      : addresses_(options.links.links), companion_(options.companion, news_) {}

  Status open(const LinkOptions& options) {
    auto links = LinkThread::start(options, *this);
    if (!links) return forward_error(std::move(links));
    links_ = std::move(*links);
    return Done{};
  }

  FlightNews& news() override { return news_; }
  CompanionReport report() const override {
    const std::scoped_lock lock(mutex_);
    return report_;
  }
  LinkTally tally(std::size_t link) const override { return links_->tally(link); }
  std::vector<std::string> take_notes() override {
    const std::scoped_lock lock(mutex_);
    return std::exchange(notes_, {});
  }

 private:
  void received(std::size_t link, const Packet& packet, FrameOutlet& out) override {
    companion_.received(link, packet, HostTime::clock::now(), out);
  }

  void link_changed(std::size_t link, bool is_open, const std::string& what) override {
    note(fmt::format("{} {}", addresses_[link].text(),
                     is_open ? "is open" : "cannot be used: " + what));
  }

  void tick(FrameOutlet& out) override {
    companion_.tick(HostTime::clock::now(), out);
    const CompanionReport& now = companion_.report();
    if (now.vehicle && (!told_ || told_->address != now.vehicle->address ||
                        told_->is_armed != now.vehicle->is_armed)) {
      told_ = now.vehicle;
      note(text_of(*now.vehicle));
    }
    const std::scoped_lock lock(mutex_);
    report_ = now;
  }

  void note(std::string what) {
    constexpr std::size_t kMost = 100;
    const std::scoped_lock lock(mutex_);
    if (notes_.size() < kMost) notes_.push_back(std::move(what));
  }

  std::vector<LinkAddress> addresses_;
  FlightNews news_;
  Companion companion_;               // the thread's
  std::optional<VehicleState> told_;  // the thread's
  mutable std::mutex mutex_;
  CompanionReport report_;             // guarded by mutex_
  std::vector<std::string> notes_;     // guarded by mutex_
  std::unique_ptr<LinkThread> links_;  // last: its thread uses all the others
};

}  // namespace

Expected<std::unique_ptr<Autopilot>> Autopilot::start(AutopilotOptions options) {
  options.companion.links = options.links.links.size();
  options.companion.key = options.links.key;
  auto autopilot = std::make_unique<RunningAutopilot>(options);
  if (auto open = autopilot->open(options.links); !open) return forward_error(std::move(open));
  return autopilot;
}

std::string text_of(const VehicleState& vehicle) {
  const std::string_view name = vehicle.is_px4()         ? "PX4"
                                : vehicle.is_ardupilot() ? "ArduPilot"
                                                         : "an autopilot of another kind";
  return fmt::format("{}, system {}, {}, mode {}", name, vehicle.address.system,
                     vehicle.is_armed ? "armed" : "disarmed", vehicle.custom_mode);
}

}  // namespace swiftlet::mavlink
