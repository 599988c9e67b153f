// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/visible_text.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace swiftlet::app {
namespace {

constexpr std::string_view kNoCharacter = "\xEF\xBF\xBD";  // U+FFFD

/// The first character of a text. Length 0: the text ends within it.
struct Character {
  std::size_t length = 0;
  std::uint32_t code = 0;
  bool is_good = false;
};

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {1, lead, true};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4) return {1, 0, false};
  std::uint32_t code = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if (i == text.size()) return {};
    if ((byte(i) & 0xC0U) != 0x80U) return {i, 0, false};
    code = code << 6U | (byte(i) & 0x3FU);
  }
  constexpr std::uint32_t kShortest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xD800 && code < 0xE000;
  return {length, code, code >= kShortest[length] && code <= 0x10FFFF && !is_surrogate};
}

/// Control characters of ASCII and Latin-1, line and paragraph ends, and what turns the direction.
bool is_unseen(std::uint32_t code) {
  const auto lies_in = [code](std::uint32_t low, std::uint32_t high) {
    return code >= low && code <= high;
  };
  return code < 0x20 || lies_in(0x7F, 0x9F) || lies_in(0x200E, 0x200F) || lies_in(0x2028, 0x202E) ||
         lies_in(0x2066, 0x2069);
}

/// Appends what can be seen of a text; gives back how much of it was used.
std::size_t append_visible(std::string_view text, bool is_one_line, std::string& out) {
  std::size_t at = 0;
  while (at < text.size()) {
    const Character next = first_character(text.substr(at));
    if (next.length == 0) break;
    const bool stays = !is_one_line && (next.code == '\n' || next.code == '\t');
    if (!next.is_good) {
      out += kNoCharacter;
    } else if (is_unseen(next.code) && !stays) {
      out += fmt::format("\\u{:04x}", next.code);
    } else {
      out += text.substr(at, next.length);
    }
    at += next.length;
  }
  return at;
}

/// The write of the stream behind VisibleStdout: 0 tells that it failed, and errno why.
ssize_t write_visible(void* lines, const char* data, std::size_t size) {
  const std::string text = (*static_cast<VisibleLines*>(lines))({data, size});
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(STDOUT_FILENO, text.data() + done, text.size() - done);
    if (written < 0 && errno != EINTR) return 0;
    done += static_cast<std::size_t>(std::max<ssize_t>(written, 0));
  }
  return static_cast<ssize_t>(size);
}

}  // namespace

std::string visible(std::string_view text) {
  std::string out;
  if (append_visible(text, true, out) < text.size()) out += kNoCharacter;
  return out;
}

std::string VisibleLines::operator()(std::string_view piece) {
  std::string out;
  cut_ += piece;
  cut_.erase(0, append_visible(cut_, false, out));
  return out;
}

std::string VisibleLines::finish() {
  if (cut_.empty()) return {};
  cut_.clear();
  return std::string(kNoCharacter);
}

std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

VisibleStdout::VisibleStdout() {
  cookie_io_functions_t functions{};
  functions.write = write_visible;
  std::FILE* const stream = fopencookie(&lines_, "w", functions);
  if (stream == nullptr) return;
  std::setvbuf(stream, nullptr, isatty(STDOUT_FILENO) == 1 ? _IOLBF : _IOFBF, BUFSIZ);
  std::fflush(stdout);
  before_ = stdout;
  stdout = stream;
}

VisibleStdout::~VisibleStdout() {
  if (before_ == nullptr) return;
  std::fclose(stdout);
  stdout = static_cast<std::FILE*>(before_);
  std::fputs(lines_.finish().c_str(), stdout);
}

}  // namespace swiftlet::app
