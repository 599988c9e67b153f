// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "swiftlet/base/faults.hpp"
#include "swiftlet/station/flight/flight_feed.hpp"
#include "swiftlet/station/flight/flight_recording.hpp"

namespace swiftlet::station {

/// Writes a flight into an MCAP file while it goes on. Where frames come from a recording, it may
/// hold up the mapping thread until they are written.
class FlightRecorder final : public FlightFeed {
 public:
  /// `meta` as in the map file. Errors: those of FlightRecording::start().
  [[nodiscard]] static Expected<std::unique_ptr<FlightRecorder>> start(
      const std::filesystem::path& path, std::string source, const McapWriter::Metadata& meta);

  void frame_done(const Frame& frame, const MapUpdate& update, const Mapper& mapper) override;

  /// Waits until all is written. Tells what could not be, and how many frames are missing.
  [[nodiscard]] Faults close();

 private:
  FlightRecorder(std::filesystem::path path, std::string source)
      : FlightFeed(std::move(source)), path_(std::move(path)) {}

  std::filesystem::path path_;
  std::unique_ptr<FlightRecording> recording_;  // goes before the feed, which it reads
};

}  // namespace swiftlet::station
