// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <functional>
#include <string>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/progress.hpp"
#include "swiftlet/base/time.hpp"
#include "swiftlet/doctor/doctor_checks.hpp"

namespace swiftlet::doctor {

/// Examines a source for `duration` of its own time, 0 for all of it, or until stop(); an empty
/// address means the live devices, and the rig that they make if there is one. That a source cannot
/// be opened is a finding, too.
/// Errors: kUsage and kInvalidConfig for an address or a rig file that cannot be meant.
[[nodiscard]] Expected<DoctorExam> examine(const std::string& address, Nanoseconds duration,
                                           const std::function<bool()>& stop,
                                           const ProgressFunction& progress = {});

}  // namespace swiftlet::doctor
