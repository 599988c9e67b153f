// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Any bytes are a bag: they are read as `swiftlet info` and `bag:` do, from the records to the
// images, poses and mounts. No input may crash, hang, or take more memory than the limits of
// BagReader.

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "swiftlet/bag/bag_reader.hpp"
#include "swiftlet/source/bag/bag_streams.hpp"

namespace {

using namespace swiftlet;

/// A file without a name that holds the input: the streams open files, and each opens its own.
class InputFile {
 public:
  InputFile(const std::uint8_t* data, std::size_t size) : file_(memfd_create("input.bag", 0)) {
    if (file_ < 0 || write(file_, data, size) != static_cast<ssize_t>(size)) std::abort();
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile() { close(file_); }
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

void read_messages(const std::string& path) {
  auto reader = BagReader::open(*open_file_bytes(path));
  if (!reader) return;
  while (true) {
    const auto message = reader->next();
    if (!message || !*message) return;
  }
}

template <class Stream>
void read_stream(Stream& stream) {
  while (true) {
    const auto sample = stream.next();
    if (!sample || !*sample) return;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const InputFile file(data, size);
  read_messages(file.path());
  if (auto depth = open_bag_depth(file.path(), {})) read_stream(*depth->stream);
  if (auto poses = open_bag_poses(file.path(), {})) read_stream(*poses->stream);
  BagTopics topics;
  topics.pose = "/tf";
  topics.body_frame = "base_link";
  if (auto poses = open_bag_poses(file.path(), topics)) read_stream(*poses->stream);
  (void)mount_from_tf(file.path(), "base_link", "depth_optical");
  return 0;
}
