// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace swiftlet::app {

// File names, topics and what files say of themselves come from strangers: printed as they are,
// they could move the cursor, colour or rename the terminal, or turn lines around. These functions
// stand between such text and whoever reads it.

/// A text of one line: what is no UTF-8 becomes U+FFFD; control characters, line ends among them,
/// and marks that turn the direction of writing are spelled out as \u001b.
[[nodiscard]] std::string visible(std::string_view text);

/// The same for a text that comes in pieces, which may cut a character; line ends and tabs stay.
class VisibleLines {
 public:
  [[nodiscard]] std::string operator()(std::string_view piece);
  /// What is left of a character that never came to its end.
  [[nodiscard]] std::string finish();

 private:
  std::string cut_;
};

/// A JSON document for standard output or a file; what is no UTF-8 becomes U+FFFD.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& json);

/// While it lives, all that is printed to `stdout` passes through VisibleLines on its way. The
/// escapes are those of JSON, so that --json stays JSON.
class VisibleStdout {
 public:
  VisibleStdout();
  VisibleStdout(const VisibleStdout&) = delete;
  VisibleStdout& operator=(const VisibleStdout&) = delete;
  ~VisibleStdout();

 private:
  VisibleLines lines_;
  void* before_ = nullptr;  // a FILE*; null if the system has no such streams
};

}  // namespace swiftlet::app
