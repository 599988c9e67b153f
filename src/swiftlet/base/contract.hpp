// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

namespace swiftlet {

/// Called when a caller breaks a contract (a bug, not bad input). Must not return; the default
/// writes the place to standard error and aborts.
using ContractHandler = void (*)(const char* condition, const char* message, const char* file,
                                 int line);

/// Replaces the handler and returns the old one. Not thread-safe: call it at start-up.
ContractHandler set_contract_handler(ContractHandler replacement);

/// What SWIFTLET_REQUIRE calls.
[[noreturn]] void contract_broken(const char* condition, const char* message, const char* file,
                                  int line);

}  // namespace swiftlet

/// Checks a precondition in every build type. For bugs of the caller only; bad input is an
/// Expected<T>.
#define SWIFTLET_REQUIRE(condition, message) \
  (static_cast<bool>(condition)              \
       ? void(0)                             \
       : ::swiftlet::contract_broken(#condition, message, __FILE__, __LINE__))
