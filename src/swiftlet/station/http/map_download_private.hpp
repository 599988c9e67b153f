// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/thread_pool.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "swiftlet/station/map_model.hpp"
#include "swiftlet/station/state/map_saver.hpp"

namespace swiftlet::station {

/// Hands out the map as a file. One is made at a time, in a thread of its own with low priority;
/// whoever asks meanwhile, or within a second, gets the same. So any number of clients costs one
/// copy of the map and one file a second at most. Files that somebody is still taking are counted:
/// where they would need more than their share of memory, no other is made until they are gone.
/// Thread safety: the station's thread alone.
class MapDownload {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Ready = std::function<void(const Expected<SharedBytes>&)>;

  /// All must outlive it. `saver` may be empty: then there is nothing to hand out.
  MapDownload(boost::asio::io_context& io, const MapModel& model, const MapSaver& saver,
              std::size_t max_bytes)
      : io_(io), model_(model), saver_(saver), max_bytes_(max_bytes) {}
  ~MapDownload() { worker_.join(); }
  MapDownload(const MapDownload&) = delete;
  MapDownload& operator=(const MapDownload&) = delete;

  /// Calls back from the station's thread, at once or later. Errors: kUnsupported without a saver,
  /// kNotFound before the first frame, kOutOfMemory while others take too many files, those of the
  /// saver.
  void ask(Time now, Ready ready);
  /// Once in a while: lets go of a file that nobody wants any more.
  void tidy(Time now);
  /// Of files that somebody takes or may get.
  [[nodiscard]] std::size_t held_bytes() const;

 private:
  void made(Expected<std::vector<std::uint8_t>>&& file);

  boost::asio::io_context& io_;
  const MapModel& model_;
  const MapSaver& saver_;
  std::size_t max_bytes_;
  std::vector<Ready> waiting_;  // not empty: a file is being made
  std::optional<Expected<SharedBytes>> last_;
  std::vector<std::weak_ptr<const std::vector<std::uint8_t>>> files_;  // that have been made
  std::size_t last_size_ = 0;
  Time last_at_{};
  boost::asio::thread_pool worker_{1};  // last: its task calls the saver
};

}  // namespace swiftlet::station
