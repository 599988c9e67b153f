// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/live/device_supervisor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/base/start_thread.hpp"

namespace swiftlet {

DeviceSupervisor::DeviceSupervisor(LiveSink& sink, std::vector<LiveInstrument> instruments,
                                   const Options& options)
    : sink_(sink), options_(options), unplugged_(instruments.size(), false) {
  for (LiveInstrument& instrument : instruments) kept_.push_back({std::move(instrument)});
}

Expected<std::unique_ptr<DeviceSupervisor>> DeviceSupervisor::start(
    LiveSink& sink, std::vector<LiveInstrument> instruments, const Options& options) {
  std::unique_ptr<DeviceSupervisor> keeper(
      new DeviceSupervisor(sink, std::move(instruments), options));
  auto thread = start_thread("live rig", [&own = *keeper] { own.keep(); });
  if (!thread) return forward_error(std::move(thread));
  keeper->thread_ = std::move(*thread);
  return keeper;
}

DeviceSupervisor::~DeviceSupervisor() {
  {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void DeviceSupervisor::note_unplugged(std::size_t instrument) {
  {
    const std::lock_guard lock(mutex_);
    SWIFTLET_REQUIRE(instrument < unplugged_.size(), "the keeper has no such instrument");
    unplugged_[instrument] = true;
  }
  changed_.notify_all();
}

void DeviceSupervisor::keep() {
  std::unique_lock lock(mutex_);
  while (!is_stopped_) {
    std::vector<bool> unplugged(unplugged_.size(), false);
    std::swap(unplugged, unplugged_);
    lock.unlock();  // a driver may call back while it starts and stops
    for (std::size_t i = 0; i < kept_.size(); ++i) look_after(kept_[i], unplugged[i]);
    lock.lock();
    changed_.wait_for(lock, options_.poll_period, [this] {
      return is_stopped_ || std::ranges::find(unplugged_, true) != unplugged_.end();
    });
  }
}

void DeviceSupervisor::tell(const Kept& kept, RigEventKind kind, std::string what) {
  sink_.note({kind, kept.instrument.name, std::move(what)});
}

void DeviceSupervisor::look_after(Kept& kept, bool is_unplugged) {
  if (is_unplugged && kept.stream != nullptr) {
    kept.stream.reset();
    tell(kept, RigEventKind::kUnplugged, "plug it in again: the flight goes on");
  }
  if (kept.stream != nullptr) watch(kept);
  if (kept.stream == nullptr) connect(kept);
}

void DeviceSupervisor::connect(Kept& kept) {
  auto stream = kept.instrument.connect();
  if (!stream) {
    std::string complaint = stream.error().text();
    if (complaint != kept.complaint) tell(kept, RigEventKind::kNotStarted, complaint);
    kept.complaint = std::move(complaint);
    return;
  }
  kept.stream = std::move(*stream);
  kept.started = HostTime::clock::now();
  kept.complaint.clear();
  const bool has_run = std::exchange(kept.has_run, true);
  tell(kept, has_run ? RigEventKind::kRestarted : RigEventKind::kStarted);
}

void DeviceSupervisor::watch(Kept& kept) {
  const auto last = kept.instrument.last_sample();
  const bool has_begun = last && *last >= kept.started;
  const auto silence = HostTime::clock::now() - (has_begun ? *last : kept.started);
  if (silence <= (has_begun ? options_.stalled_after : options_.first_sample)) {
    if (has_begun && std::exchange(kept.is_stalled, false) && !kept.instrument.can_restart)
      tell(kept, RigEventKind::kRestarted);
    return;
  }
  const bool was_stalled = std::exchange(kept.is_stalled, true);
  if (!was_stalled || kept.instrument.can_restart)
    tell(kept, RigEventKind::kStalled, fmt::format("silent for {:.1f} s", seconds(silence)));
  if (kept.instrument.can_restart) kept.stream.reset();
}

}  // namespace swiftlet
