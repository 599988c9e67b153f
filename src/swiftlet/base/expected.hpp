// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace swiftlet {

/// What kind of thing went wrong; the program turns kUsage and kInvalidConfig into exit code 2, the
/// rest into 1.
enum class ErrorCode : std::uint8_t {
  kUsage,          ///< the command line or an argument cannot be meant
  kInvalidConfig,  ///< a parameter has an impossible value
  kNotFound,       ///< a file, folder, topic or name does not exist
  kCorruptInput,   ///< it exists but its content is wrong, truncated or inconsistent
  kUnsupported,    ///< well-formed, but of a kind or version that this build does not read
  kIo,             ///< the operating system refused: permission, disk full, socket
  kOutOfMemory,    ///< a start-up allocation would not fit
};

/// An error as a value: where it is, what is wrong, and what the user can do about it.
/// Printed by the program as `swiftlet: <where>: <what>; <remedy>`.
struct Error {
  ErrorCode code;      ///< what kind of thing went wrong
  std::string where;   ///< file, line, option or part; may be empty
  std::string what;    ///< one sentence, no capital, no full stop
  std::string remedy;  ///< what to do; may be empty

  /// For people, in one line: `where: what; remedy`.
  [[nodiscard]] std::string text() const {
    std::string line = where.empty() ? what : where + ": " + what;
    if (!remedy.empty()) line += "; " + remedy;
    return line;
  }
};

/// A value, or why there is none. `if (result) use(*result); else tell(result.error().text());`
template <class T>
using Expected = tl::expected<T, Error>;

/// The value of an operation that has none.
struct Done {};
/// Done, or why not.
using Status = Expected<Done>;

/// An error, for `return fail(...)`.
[[nodiscard]] inline tl::unexpected<Error> fail(ErrorCode code, std::string where, std::string what,
                                                std::string remedy = {}) {
  return tl::make_unexpected(Error{code, std::move(where), std::move(what), std::move(remedy)});
}

/// Passes an error on to the caller, whatever the caller's own value type is.
template <class T>
[[nodiscard]] tl::unexpected<Error> forward_error(Expected<T>&& failed) {
  return tl::make_unexpected(std::move(failed).error());
}

}  // namespace swiftlet
