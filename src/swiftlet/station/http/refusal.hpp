// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>

#include "swiftlet/station/http/access.hpp"

namespace swiftlet::station {

/// Why a request is refused and what to do, in one line for people: the body of the answer and the
/// line for the operator. Holds nothing of the request but letters and digits of what it named.
/// REQUIRES: verdict != kAllowed
[[nodiscard]] std::string refusal_reason(Verdict verdict, const Credentials& who);

/// 401, 403 or 429.
[[nodiscard]] int refusal_status(Verdict verdict);

}  // namespace swiftlet::station
