// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "swiftlet/app/visible_text.hpp"

namespace swiftlet::app {
namespace {

using namespace std::chrono_literals;
constexpr std::chrono::milliseconds kRedraw = 100ms;
constexpr std::chrono::milliseconds kLine = 3s;
constexpr int kBarWidth = 30;
constexpr const char* kClearLine = "\r\033[K";

/// A flight goes on where its progress cannot be shown; fmt's print would throw.
void show(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

std::string progress_text(const ProgressState& s) {
  const double rate = s.elapsed_s > 0.0 ? static_cast<double>(s.done) / s.elapsed_s : 0.0;
  std::string text =
      s.total ? fmt::format("{}/{} frames", s.done, *s.total) : fmt::format("{} frames", s.done);
  text += fmt::format(", {:.1f} fps", rate);
  if (s.total && rate > 0.0 && *s.total > s.done) {
    const double left_s = static_cast<double>(*s.total - s.done) / rate;
    const auto whole_s = static_cast<long>(std::ceil(left_s));
    text += whole_s < 60 ? fmt::format(", {} s left", whole_s)
                         : fmt::format(", {}:{:02} min left", whole_s / 60, whole_s % 60);
  }
  return text;
}

std::string progress_bar(const ProgressState& s, int width) {
  if (!s.total || *s.total == 0) return {};
  const double share = std::min(1.0, static_cast<double>(s.done) / static_cast<double>(*s.total));
  const auto filled = static_cast<std::size_t>(share * width);
  std::string bar(filled, '=');
  if (filled < static_cast<std::size_t>(width)) bar += '>';
  bar.resize(static_cast<std::size_t>(width), ' ');
  return fmt::format("[{}] {:3.0f} % ", bar, std::floor(share * 100.0));
}

Progress::Progress(std::optional<std::size_t> total)
    : is_terminal_(isatty(STDERR_FILENO) == 1), total_(total) {
  if (!is_terminal_) next_ += kLine;
}

double Progress::elapsed_s() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void Progress::update(std::size_t done) {
  done_ = done;
  const auto now = Clock::now();
  if (now < next_) return;
  const ProgressState state{done, total_, elapsed_s()};
  if (is_terminal_) {
    show(kClearLine + progress_bar(state, kBarWidth) + progress_text(state));
    next_ = now + kRedraw;
  } else {
    show(progress_text(state) + "\n");
    next_ = now + kLine;
  }
}

void Progress::tell(const std::string& text) const {
  show((is_terminal_ ? kClearLine : "") + visible(text) + "\n");
}

void Progress::finish() {
  const ProgressState state{done_, total_, elapsed_s()};
  if (is_terminal_) show(kClearLine);
  if (!is_terminal_) show(progress_text(state) + "\n");
}

ProgressFunction shown_progress() {
  struct Line {
    std::optional<Progress> work{};
    ~Line() {
      if (work) work->finish();
    }
  };
  return [line = std::make_shared<Line>()](std::size_t done, std::optional<std::size_t> total) {
    if (done == 0 && line->work) line->work->finish();
    if (done == 0 || !line->work) line->work.emplace(total);
    line->work->update(done);
  };
}

}  // namespace swiftlet::app
