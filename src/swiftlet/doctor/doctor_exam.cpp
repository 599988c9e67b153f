// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/doctor/doctor_exam.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "swiftlet/base/progress.hpp"
#include "swiftlet/session/depth_doubt.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet::doctor {
namespace {

void note_readings(const Frame& frame, DepthStatistics& facts) {
  std::vector<std::uint16_t> raw;
  for (int v = 0; v < frame.depth.raw.height(); ++v) {
    const auto row = frame.depth.raw.row(v);
    std::ranges::copy_if(row, std::back_inserter(raw), [](std::uint16_t z) { return z != 0; });
    facts.pixels += row.size();
  }
  facts.readings += raw.size();
  if (raw.empty()) return;
  const auto middle = raw.begin() + static_cast<std::ptrdiff_t>(raw.size() / 2);
  std::ranges::nth_element(raw, middle);
  facts.medians_m.push_back(static_cast<float>(*middle) * frame.depth.unit_m);
}

/// Runs a source for a while, in its own time.
void examine_source(FrameSource& source, Nanoseconds duration, const std::function<bool()>& stop,
                    const ProgressFunction& progress, DoctorExam& exam) {
  HostTime alive_at = HostTime::clock::now();
  const bool is_timed = duration > Nanoseconds(0);
  source.stop_when(
      [&] { return stop() || (is_timed && HostTime::clock::now() - alive_at > duration); });
  if (source.rig() != nullptr) exam.rig = *source.rig();
  exam.choices = source.info().choices;
  exam.intrinsics = source.info().intrinsics;
  DepthDoubt doubt(source.info().assumed_depth_unit_m);
  exam.is_t265 = source.info().native_up_axis == "+y";
  exam.readings.resize(exam.rig.cameras.size());
  const ProgressTeller shown(progress, std::nullopt);
  std::optional<Stamp> first;
  for (std::size_t done = 0; !stop();) {
    auto frame = source.next();
    if (!frame) exam.fault = frame.error();
    if (!frame || !*frame) break;
    first = first.value_or((*frame)->stamp);
    alive_at = HostTime::clock::now();
    note_readings(**frame, exam.readings[(*frame)->camera]);
    doubt.note((*frame)->depth);
    shown.update(++done);
    if (is_timed && (*frame)->stamp - *first >= duration) break;
  }
  if (source.statistics() != nullptr) exam.facts = *source.statistics();
  exam.tally = source.tally();
  exam.depth_doubt = doubt.text();
}

void examine_system(DoctorExam& exam) {
  auto system = examine_realsense();
  if (system) exam.system = std::move(*system);
  if (!system) exam.no_system = std::move(system).error();
}

/// Whether there is a whole rig to be run.
bool has_rig(const RealsenseSystem& system) {
  return std::ranges::any_of(system.devices, &DeviceInfo::has_depth) &&
         std::ranges::any_of(system.devices, &DeviceInfo::has_poses);
}

}  // namespace

Expected<DoctorExam> examine(const std::string& address, Nanoseconds duration,
                             const std::function<bool()>& stop, const ProgressFunction& progress) {
  DoctorExam exam{.subject = address};
  if (address.empty() || address.starts_with(kRealsenseKind)) examine_system(exam);
  if (address.empty() && exam.system && has_rig(*exam.system)) exam.subject = kRealsenseKind;
  if (exam.subject.empty()) return exam;
  auto source = open_source(exam.subject);
  if (source) {
    examine_source(**source, duration, stop, progress, exam);
    return exam;
  }
  if (source.error().code == ErrorCode::kUsage || source.error().code == ErrorCode::kInvalidConfig)
    return forward_error(std::move(source));
  exam.fault = std::move(source).error();
  return exam;
}

}  // namespace swiftlet::doctor
