// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "swiftlet/doctor/doctor_checks.hpp"

// What live devices tell of themselves.

namespace swiftlet::doctor {
namespace {

std::string title(const DeviceInfo& device) {
  return fmt::format("{} ({})", device.name.empty() ? "a device" : device.name, device.serial);
}

/// "5.12.7.100" as numbers; compares as versions do.
std::vector<int> version_of(const std::string& text) {
  std::vector<int> parts;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  while (at < end) {
    int part = 0;
    const auto [next, error] = std::from_chars(at, end, part);
    if (error != std::errc{}) break;
    parts.push_back(part);
    at = next < end ? next + 1 : next;
  }
  return parts;
}

}  // namespace

void check_sdk(const DoctorExam& exam, std::vector<Finding>& findings) {
  if (exam.no_system) {
    const bool is_absent = exam.no_system->code == ErrorCode::kUnsupported;
    findings.push_back({exam.subject.empty() ? Severity::kFault : Severity::kNote,
                        is_absent ? exam.no_system->what : exam.no_system->text(),
                        exam.no_system->remedy});
  }
  if (!exam.system) return;
  findings.push_back({Severity::kGood, fmt::format("SDK {} is built in", exam.system->sdk)});
  if (!exam.system->can_know_t265) {
    findings.push_back({Severity::kNote,
                        fmt::format("SDK {} cannot talk to a T265", exam.system->sdk),
                        "build with SDK 2.50.0 to 2.53.1, or feed poses with ?poses=udp:PORT"});
  }
}

void check_devices(const DoctorExam& exam, std::vector<Finding>& findings) {
  if (!exam.system) return;
  const auto& devices = exam.system->devices;
  for (const DeviceInfo& device : devices) {
    findings.push_back(
        {Severity::kGood,
         fmt::format("{}: firmware {}, USB {}{}{}", title(device), device.firmware,
                     device.usb.empty() ? "unknown" : device.usb,
                     device.has_depth() ? ", depth" : "", device.has_poses ? ", poses" : "")});
  }
  if (std::ranges::none_of(devices, &DeviceInfo::has_depth)) {
    findings.push_back({Severity::kFault, "no depth camera is connected",
                        "check the cable, the power of the port, and the udev rules of the SDK"});
  }
  if (std::ranges::none_of(devices, &DeviceInfo::has_poses)) {
    findings.push_back({Severity::kWarning, "no T265 is connected",
                        "give it a port of its own, or feed poses with ?poses=udp:PORT"});
  }
}

void check_firmware(const DoctorExam& exam, std::vector<Finding>& findings) {
  if (!exam.system) return;
  for (const DeviceInfo& device : exam.system->devices) {
    if (device.firmware.empty() || device.recommended_firmware.empty()) continue;
    if (version_of(device.firmware) >= version_of(device.recommended_firmware)) continue;
    findings.push_back({Severity::kWarning,
                        fmt::format("{} has firmware {}, the SDK recommends {}", title(device),
                                    device.firmware, device.recommended_firmware),
                        "update it with the SDK's rs-fw-update or realsense-viewer"});
  }
}

void check_usb(const DoctorExam& exam, std::vector<Finding>& findings) {
  if (!exam.system) return;
  for (const DeviceInfo& device : exam.system->devices) {
    if (!device.has_depth() || !device.usb.starts_with('2')) continue;
    findings.push_back(
        {Severity::kFault,
         fmt::format("{} is on USB {}, too slow for its depth", title(device), device.usb),
         "use a USB 3 port and a short USB 3 cable; turn the plug, wait, try again"});
  }
}

void check_profile(const DoctorExam& exam, std::vector<Finding>& findings) {
  if (!exam.system) return;
  constexpr std::string_view kDefault = "848x480@30";
  for (const DeviceInfo& device : exam.system->devices) {
    const auto& profiles = device.depth_profiles;
    if (!device.has_depth() || std::ranges::find(profiles, kDefault) != profiles.end()) continue;
    findings.push_back({Severity::kWarning,
                        fmt::format("{} has no depth of {}; it has {}", title(device), kDefault,
                                    fmt::join(profiles, ", ")),
                        "choose one with ?profile=WIDTHxHEIGHT@HZ; on USB 2 there are fewer"});
  }
}

}  // namespace swiftlet::doctor
