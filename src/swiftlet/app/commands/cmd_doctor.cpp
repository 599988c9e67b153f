// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/commands/rig_flags.hpp"
#include "swiftlet/app/interrupt.hpp"
#include "swiftlet/app/progress.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/doctor/doctor_exam.hpp"

namespace swiftlet::app {
namespace {

struct DoctorOptions {
  std::string source;
  RigFlags rig;
  double seconds = 10.0;
  bool as_json = false;
};

struct Diagnosis {
  std::string_view check;
  doctor::Finding finding;
};

std::vector<Diagnosis> diagnose(const doctor::DoctorExam& exam) {
  std::vector<Diagnosis> all;
  for (const auto& check : doctor::doctor_checks()) {
    std::vector<doctor::Finding> findings;
    check.make(exam, findings);
    for (doctor::Finding& finding : findings) all.push_back({check.name, std::move(finding)});
  }
  return all;
}

std::size_t how_many(const std::vector<Diagnosis>& all, doctor::Severity severity) {
  return static_cast<std::size_t>(
      std::ranges::count(all, severity, [](const Diagnosis& d) { return d.finding.severity; }));
}

void print_text(const doctor::DoctorExam& exam, const std::vector<Diagnosis>& all) {
  fmt::print("{}\n", exam.subject.empty() ? "live devices" : exam.subject);
  for (const auto& [check, finding] : all) {
    fmt::print("  {:<8} {:<12} {}\n",
               doctor::kSeverityNames[static_cast<std::size_t>(finding.severity)], check,
               finding.what);
    if (!finding.remedy.empty()) fmt::print("  {:<21} -> {}\n", "", finding.remedy);
  }
  const std::size_t faults = how_many(all, doctor::Severity::kFault);
  const std::size_t warnings = how_many(all, doctor::Severity::kWarning);
  fmt::print("{} fault{}, {} warning{}\n", faults, faults == 1 ? "" : "s", warnings,
             warnings == 1 ? "" : "s");
}

nlohmann::ordered_json stream_json(const StreamStatistics& stream) {
  nlohmann::ordered_json json{{"samples", stream.samples},
                              {"rate_hz", stream.rate_hz()},
                              {"longest_gap_ms", seconds(stream.longest_gap) * 1e3}};
  if (stream.first) json["first_ns"] = stream.first->ns;
  if (stream.last) json["last_ns"] = stream.last->ns;
  for (std::size_t i = 0; i < stream.clocks.size(); ++i) {
    if (stream.clocks[i] > 0) json["clocks"][std::string(kClockDomainNames[i])] = stream.clocks[i];
  }
  return json;
}

nlohmann::ordered_json devices_json(const RealsenseSystem& system) {
  auto devices = nlohmann::ordered_json::array();
  for (const DeviceInfo& device : system.devices) {
    devices.push_back({{"name", device.name},
                       {"serial", device.serial},
                       {"firmware", device.firmware},
                       {"recommended_firmware", device.recommended_firmware},
                       {"usb", device.usb},
                       {"depth_profiles", device.depth_profiles},
                       {"has_poses", device.has_poses}});
  }
  return {{"sdk", system.sdk}, {"devices", std::move(devices)}};
}

void print_json(const doctor::DoctorExam& exam, const std::vector<Diagnosis>& all) {
  nlohmann::ordered_json json{{"subject", exam.subject},
                              {"faults", how_many(all, doctor::Severity::kFault)},
                              {"warnings", how_many(all, doctor::Severity::kWarning)},
                              {"findings", nlohmann::ordered_json::array()}};
  for (const auto& [check, finding] : all) {
    json["findings"].push_back(
        {{"check", check},
         {"severity", doctor::kSeverityNames[static_cast<std::size_t>(finding.severity)]},
         {"what", finding.what},
         {"remedy", finding.remedy}});
  }
  if (exam.system) json["realsense"] = devices_json(*exam.system);
  if (exam.facts) {
    json["poses"] = stream_json(exam.facts->poses);
    for (const CameraStatistics& camera : exam.facts->cameras)
      json["cameras"].push_back(stream_json(camera));
  }
  // A serial number or a file name may be no text at all.
  fmt::print("{}\n", json_text(json));
}

Faults doctor(const DoctorOptions& options) {
  std::string address = realsense_address(options.source);
  if (!address.empty()) address = options.rig.added_to(address);
  const InterruptGuard interrupt;
  const auto exam = doctor::examine(
      address, Nanoseconds(std::llround(options.seconds * 1e9)),
      [&] { return interrupt.is_interrupted(); }, shown_progress());
  if (!exam) return {exam.error()};
  const std::vector<Diagnosis> all = diagnose(*exam);
  options.as_json ? print_json(*exam, all) : print_text(*exam, all);
  const std::size_t faults = how_many(all, doctor::Severity::kFault);
  if (faults == 0) return {};
  return {{ErrorCode::kCorruptInput, "doctor",
           fmt::format("{} fault{} found", faults, faults == 1 ? "" : "s"),
           "what to do stands behind each arrow"}};
}

}  // namespace

Action declare_doctor(CLI::App& parser) {
  auto o = std::make_shared<DoctorOptions>();
  parser
      .add_option("SOURCE", o->source,
                  "what to examine, as KIND:PLACE; without it the RealSense devices")
      ->type_name("");
  CLI::Range range(0.0, 1e6);
  range.description("");
  parser.add_option("--seconds", o->seconds, "of it, in its own time; 0 for all")
      ->check(range)
      ->type_name("S")
      ->capture_default_str();
  parser.add_flag("--json", o->as_json, "one JSON object, for machines");
  declare_rig_flags(parser, o->rig);
  parser.footer(
      "Examples:\n"
      "  swiftlet doctor                                devices, firmware, USB, clocks, rates\n"
      "  swiftlet doctor 'realsense:?poses=udp:5605' --rig my_rig.yaml\n"
      "  swiftlet doctor bag:d435.bag,t265.bag --seconds 0\n"
      "  swiftlet doctor 'sim:apartment?fault=dead'     what a dead tracker looks like\n"
      "Each finding is good, a note, a warning or a fault, and says what to do.\n"
      "Exit code 0 without faults, 1 with any; 'swiftlet list checks' tells every check.");
  return [o] { return doctor(*o); };
}

}  // namespace swiftlet::app
