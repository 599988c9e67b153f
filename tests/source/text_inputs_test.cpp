// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>

#include "support/recordings.hpp"
#include "swiftlet/bag/open_recording.hpp"
#include "swiftlet/sim/ply_reader.hpp"
#include "swiftlet/sim/scene_file.hpp"
#include "swiftlet/source/bag/bag_scan.hpp"
#include "swiftlet/source/folders/matrix_file.hpp"
#include "swiftlet/source/folders/tum_lists.hpp"
#include "swiftlet/source/rig/rig_file.hpp"
#include "swiftlet/store/export/octomap_import.hpp"

namespace swiftlet {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::string_view kMark = "\xEF\xBB\xBF";
std::string error_of(const auto& read) { return read ? "" : read.error().text(); }

/// A reader of a file by its path: what is wrong, or nothing.
struct TextReader {
  const char* name;
  std::string content;
  std::function<std::string(const std::filesystem::path&)> read;
};

std::vector<TextReader> text_readers() {
  return {
      {"images", "1.5 a.png\n", [](const auto& path) { return error_of(read_tum_images(path)); }},
      {"trajectory", "1.5 0 0 0 0 0 0 1\n",
       [](const auto& path) { return error_of(read_tum_poses(path)); }},
      {"poses", "1.5 0 0 0 0 0 0 1\n",
       [](const auto& path) { return error_of(open_text_poses(path, {})); }},
      {"matrix", std::string(test::kIdentityPose),
       [](const auto& path) { return error_of(read_matrix4(path)); }},
      {"camera", std::string(test::kSmallCamera),
       [](const auto& path) { return error_of(read_matrix3(path)); }},
      {"rig", "cameras:\n  - at_m: [0, 0, 0]\n    looks: forward\n",
       [](const auto& path) { return error_of(load_rig(path)); }},
  };
}

TEST(EveryTextReader, skips_a_byte_order_mark) {
  const test::TempFolder folder;
  for (const TextReader& reader : text_readers()) {
    for (const std::string_view mark : {std::string_view(), kMark}) {
      test::write_file(folder / "text", std::string(mark) + reader.content);
      EXPECT_EQ(reader.read(folder / "text"), "") << reader.name << (mark.empty() ? "" : " marked");
    }
  }
}

TEST(EveryTextReader, refuses_pipes_devices_and_folders_at_once) {
  const test::TempFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::vector<TextReader> readers = text_readers();
  readers.push_back(
      {"octomap", "", [](const auto& path) { return error_of(read_octomap(path, {})); }});
#if SWIFTLET_HAS_EMBREE
  readers.push_back(
      {"mesh", "", [](const auto& path) { return error_of(sim::read_ply(path.string())); }});
#endif
  for (const TextReader& reader : readers) {
    EXPECT_THAT(reader.read(folder / "pipe"), AllOf(HasSubstr("pipe: "), HasSubstr("is a pipe")))
        << reader.name;
    EXPECT_THAT(reader.read("/dev/zero"), HasSubstr("is a device")) << reader.name;
    EXPECT_THAT(reader.read(folder.path()), HasSubstr("is a folder")) << reader.name;
  }
}

#if SWIFTLET_HAS_EMBREE
TEST(SceneFile, that_is_a_pipe_or_has_no_end_is_refused_at_once) {
  const test::TempFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe.yaml").c_str(), 0600), 0);
  EXPECT_THAT(error_of(sim::load_scene((folder / "pipe.yaml").string())), HasSubstr("is a pipe"));
  EXPECT_THAT(error_of(sim::load_scene("/dev/zero")), HasSubstr("is a device"));
}
#endif

TEST(EveryBag, that_is_a_pipe_is_refused_at_once) {
  const test::TempFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(error_of(open_recording(folder / "pipe")), HasSubstr("it is not a file"));
}

}  // namespace
}  // namespace swiftlet
