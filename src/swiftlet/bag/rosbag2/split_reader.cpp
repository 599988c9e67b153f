// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/rosbag2/split_reader.hpp"

#include <algorithm>

#include "swiftlet/bag/open_recording.hpp"
#include "swiftlet/bag/rosbag2/recording_folder.hpp"

namespace swiftlet {

Expected<SplitReader> SplitReader::open(const std::filesystem::path& folder) {
  auto files = files_of_recording(folder);
  if (!files) return forward_error(std::move(files));
  SplitReader reader(folder.string(), std::move(*files));
  reader.before_ = {.format = "an empty recording", .files = 0};
  if (auto opened = reader.open_next(); !opened) return forward_error(std::move(opened));
  return reader;
}

void SplitReader::end() {
  if (part_) before_ = info();
  part_.reset();
  opened_ = files_.size();
}

Status SplitReader::open_next() {
  if (part_) before_ = info();
  part_.reset();
  own_number_.clear();
  if (opened_ == files_.size()) return Done{};
  auto part = open_recording(files_[opened_++]);
  if (!part) {
    end();
    return forward_error(std::move(part));
  }
  part_ = std::move(*part);
  adopt_connections();
  return Done{};
}

/// Topics that are known before their first message, as those of a database are.
void SplitReader::adopt_connections() {
  for (const auto& [number, connection] : part_->connections()) (void)own(connection);
}

const BagConnection& SplitReader::own(const BagConnection& theirs) {
  const auto known = own_number_.find(theirs.id);
  if (known != own_number_.end()) return connections_.at(known->second);
  auto same = std::ranges::find_if(connections_, [&](const auto& own) {
    return own.second.topic == theirs.topic && own.second.type == theirs.type &&
           own.second.encoding == theirs.encoding;
  });
  if (same == connections_.end()) {
    const auto number = static_cast<std::uint32_t>(connections_.size());
    same = connections_.emplace(number, theirs).first;
    same->second.id = number;
  }
  own_number_.emplace(theirs.id, same->first);
  return same->second;
}

std::string SplitReader::place_of(const BagMessage& message) const {
  return part_ ? part_->place_of(message) : RecordingReader::place_of(message);
}

RecordingInfo SplitReader::info() const {
  if (!part_) return before_;
  RecordingInfo all = part_->info();
  all.chunks += before_.chunks;
  all.compression.insert(before_.compression.begin(), before_.compression.end());
  all.files += before_.files;
  all.is_closed = all.is_closed && before_.is_closed;
  return all;
}

Expected<std::optional<BagMessage>> SplitReader::read_next() {
  while (part_) {
    auto message = part_->next();
    if (!message) end();
    if (!message) return message;
    if (*message) {
      (*message)->connection = &own(*(*message)->connection);
      return message;
    }
    if (auto opened = open_next(); !opened) return forward_error(std::move(opened));
  }
  return std::nullopt;
}

}  // namespace swiftlet
