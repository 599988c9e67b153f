// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <thread>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/commands/rig_flags.hpp"
#include "swiftlet/app/events.hpp"
#include "swiftlet/app/interrupt.hpp"
#include "swiftlet/app/progress.hpp"
#include "swiftlet/app/report/summary.hpp"
#include "swiftlet/session/flight_file.hpp"
#include "swiftlet/source/address_options.hpp"
#include "swiftlet/source/realsense/realsense.hpp"

namespace swiftlet::app {
namespace {

struct RecordOptions {
  std::string source = "realsense:";
  std::string out;
  RigFlags rig;
  double seconds = 0.0;
};

/// Until Ctrl-C or the end of the time. Ends with the files closed.
std::vector<LiveRecording::Stream> record_until(LiveRecordingPtr recording, double limit_s) {
  const InterruptGuard interrupt;
  Progress progress(std::nullopt);
  while (!interrupt.is_interrupted() && (limit_s <= 0.0 || progress.elapsed_s() < limit_s)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    tell_events(recording->take_events(), progress);
    progress.update(recording->streams().front().samples);
  }
  progress.finish();
  return recording->streams();
}

/// The address that maps the recording with the same rig.
std::string replay_address(std::string address, std::string_view recorded) {
  constexpr std::array<std::string_view, 5> kShared{"rig", "pose_axes", "pairing", "on_jump",
                                                    "pose_offset_ms"};
  const auto asked = parse_address(recorded, "realsense");
  if (!asked) return address;
  for (const auto& [key, value] : asked->options) {
    if (std::ranges::find(kShared, key) != kShared.end())
      address = with_option(std::move(address), key, value);
  }
  return address;
}

Faults report_recording(const std::vector<LiveRecording::Stream>& streams,
                        std::string_view recorded) {
  Faults faults;
  std::string files;
  for (const LiveRecording::Stream& stream : streams) {
    std::error_code unreadable;
    const auto bytes = std::filesystem::file_size(stream.file, unreadable);
    fmt::print("  {:<18} {:>7} samples  {} ({})\n", stream.name, stream.samples,
               stream.file.string(), unreadable ? "no file" : size_text(bytes));
    files += (files.empty() ? "" : ",") + stream.file.string();
    if (stream.samples == 0)
      faults.push_back(
          {ErrorCode::kIo, stream.name, "nothing was recorded", "try swiftlet doctor"});
  }
  fmt::print("replay: swiftlet map '{}'\n", replay_address("bag:" + files, recorded));
  return faults;
}

Faults record(const RecordOptions& options) {
  const std::string address = realsense_address(options.source);
  if (!address.starts_with(kRealsenseKind)) {
    return {{ErrorCode::kUsage, options.source, "only live RealSense cameras can be recorded",
             "write realsense, or realsense:SERIAL"}};
  }
  const std::string rest = options.rig.added_to(address).substr(kRealsenseKind.size());
  auto recording = record_realsense(rest, options.out);
  if (!recording) return fault_of(std::move(recording));
  return report_recording(record_until(std::move(*recording), options.seconds), rest);
}

}  // namespace

Action declare_record(CLI::App& parser) {
  auto o = std::make_shared<RecordOptions>();
  parser.add_option("SOURCE", o->source, "realsense, or realsense:SERIAL[,SERIAL...][?...]")
      ->type_name("")
      ->required();
  parser
      .add_option("-o,--out", o->out,
                  "folder for the recordings; nothing in it is replaced; %t as in map")
      ->type_name("DIR")
      ->required();
  CLI::Range range(0.0, 1e6);
  range.description("");
  parser.add_option("--seconds", o->seconds, "stop after this time; without it at Ctrl-C")
      ->check(range)
      ->type_name("S");
  declare_rig_flags(parser, o->rig);
  parser.footer(
      "Examples:\n"
      "  swiftlet record realsense -o flight1           until Ctrl-C\n"
      "  swiftlet record 'realsense:?poses=udp:5605' --rig my_rig.yaml -o flight2 --seconds 60\n"
      "  swiftlet map bag:flight1/depth_728612070259.bag,flight1/t265_908412110993.bag\n"
      "The SDK writes one bag a device; poses that come over UDP go to poses.txt as they came. A\n"
      "device that was unplugged goes on in a file of its own.");
  return [o] {
    o->out = with_start_time(std::move(o->out), std::time(nullptr));
    return record(*o);
  };
}

}  // namespace swiftlet::app
