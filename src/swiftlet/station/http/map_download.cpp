// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <boost/asio/post.hpp>
#include <utility>

#include "swiftlet/station/http/map_download_private.hpp"
#include "swiftlet/station/station.hpp"

namespace swiftlet::station {
namespace {

constexpr std::chrono::seconds kFresh{1};

}  // namespace

void MapDownload::ask(Time now, Ready ready) {
  if (!saver_) {
    ready(fail(ErrorCode::kUnsupported, "map file", "this station has none to give"));
    return;
  }
  if (model_.world() == 0 || model_.map().digest().blocks == 0) {
    ready(fail(ErrorCode::kNotFound, "map file", "nothing has been mapped yet"));
    return;
  }
  if (last_ && now - last_at_ < kFresh) {
    ready(*last_);
    return;
  }
  if (waiting_.empty()) {
    last_.reset();
    // The next file is about as large as the one before; one may always be made.
    const std::size_t held = held_bytes();
    if (held > 0 && held + last_size_ > max_bytes_) {
      ready(fail(ErrorCode::kOutOfMemory, "map file", "others are still taking older ones"));
      return;
    }
  }
  waiting_.push_back(std::move(ready));
  if (waiting_.size() > 1) return;
  last_at_ = now;
  boost::asio::post(worker_, [this, copy = std::make_shared<const BlockMap>(model_.map().copy())] {
    run_with_low_priority();
    auto file = std::make_shared<Expected<std::vector<std::uint8_t>>>(saver_(*copy));
    boost::asio::post(io_, [this, file] { made(std::move(*file)); });
  });
}

void MapDownload::made(Expected<std::vector<std::uint8_t>>&& file) {
  last_ = std::move(file).map([](std::vector<std::uint8_t>&& bytes) -> SharedBytes {
    return std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
  });
  if (*last_) {
    std::erase_if(files_, [](const auto& old) { return old.expired(); });
    files_.push_back(**last_);
    last_size_ = (**last_)->size();
  }
  for (const Ready& ready : std::exchange(waiting_, {})) ready(*last_);
}

std::size_t MapDownload::held_bytes() const {
  std::size_t bytes = 0;
  for (const auto& file : files_) {
    if (const auto held = file.lock()) bytes += held->size();
  }
  return bytes;
}

void MapDownload::tidy(Time now) {
  if (waiting_.empty() && now - last_at_ >= kFresh) last_.reset();
}

}  // namespace swiftlet::station
