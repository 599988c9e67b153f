// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/source/live/live_sink.hpp"

namespace swiftlet {

/// An instrument that delivers into a LiveSink until this object goes away.
class LiveStream {
 public:
  virtual ~LiveStream() = default;
};
using LiveStreamPtr = std::unique_ptr<LiveStream>;

/// One that the keeper starts, and starts again.
struct LiveInstrument {
  std::string name;  ///< for events, as in "camera 'front'"
  /// Called by the keeper's thread. Errors: kNotFound while it is not there, others with reason.
  std::function<Expected<LiveStreamPtr>()> connect;
  /// When it last delivered; see LiveRig::last_image() and last_pose().
  std::function<std::optional<HostTime>()> last_sample;
  /// Whether starting it again may cure its silence: a device, but no socket.
  bool can_restart = true;
};

/// Keeps instruments alive from a thread of its own: starts each, starts it again when it has been
/// unplugged or says nothing any more, and tells the sink of all that as events.
///
/// Thread safety: note_unplugged() from any thread. The destructor stops the instruments.
class DeviceSupervisor {
 public:
  struct Options {
    Nanoseconds poll_period = std::chrono::milliseconds(500);  ///< between two looks
    Nanoseconds first_sample = std::chrono::seconds(5);        ///< a T265 takes two to start
    Nanoseconds stalled_after = std::chrono::seconds(1);
  };
  /// Errors: kOutOfMemory if the system starts no thread. REQUIRES: the sink outlives the keeper.
  [[nodiscard]] static Expected<std::unique_ptr<DeviceSupervisor>> start(
      LiveSink& sink, std::vector<LiveInstrument> instruments, const Options& options);
  DeviceSupervisor(const DeviceSupervisor&) = delete;
  DeviceSupervisor& operator=(const DeviceSupervisor&) = delete;
  ~DeviceSupervisor();

  /// An instrument is gone; by its place in the list.
  void note_unplugged(std::size_t instrument);

 private:
  struct Kept {
    LiveInstrument instrument;
    LiveStreamPtr stream{};
    HostTime started{};
    bool is_stalled = false;  // told, and not yet over
    bool has_run = false;
    std::string complaint{};  // the last reason why it did not start, told once
  };
  DeviceSupervisor(LiveSink& sink, std::vector<LiveInstrument> instruments, const Options& options);
  void keep();
  void look_after(Kept& kept, bool is_unplugged);
  void connect(Kept& kept);
  void watch(Kept& kept);
  void tell(const Kept& kept, RigEventKind kind, std::string what = {});

  LiveSink& sink_;
  const Options options_;
  std::vector<Kept> kept_;  // the thread's

  std::mutex mutex_;  // of all that follows
  std::condition_variable changed_;
  std::vector<bool> unplugged_;
  bool is_stopped_ = false;

  std::thread thread_;
};

}  // namespace swiftlet
