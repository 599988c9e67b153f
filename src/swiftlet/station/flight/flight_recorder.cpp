// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/flight/flight_recorder.hpp"

#include <fmt/format.h>

namespace swiftlet::station {

Expected<std::unique_ptr<FlightRecorder>> FlightRecorder::start(const std::filesystem::path& path,
                                                                std::string source,
                                                                const McapWriter::Metadata& meta) {
  std::unique_ptr<FlightRecorder> recorder(new FlightRecorder(path, std::move(source)));
  auto recording = FlightRecording::start(path, recorder->feed(), meta);
  if (!recording) return forward_error(std::move(recording));
  recorder->recording_ = std::move(*recording);
  return recorder;
}

void FlightRecorder::frame_done(const Frame& frame, const MapUpdate& update, const Mapper& mapper) {
  FlightFeed::frame_done(frame, update, mapper);
  recording_->add(frame);
}

Faults FlightRecorder::close() {
  Faults faults;
  if (auto closed = recording_->close(); !closed) faults.push_back(std::move(closed).error());
  if (recording_->missed() > 0) {
    faults.push_back({ErrorCode::kIo, path_.string(),
                      fmt::format("{} frames of the flight are not in it", recording_->missed()),
                      "the disk or the processor was late"});
  }
  return faults;
}

}  // namespace swiftlet::station
