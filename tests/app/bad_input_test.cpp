// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// Bad input to the built program: each has its own clear message and exit code 1 or 2, and leaves
// nothing half-written.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <functional>

#include "app/support/run_program.hpp"
#include "support/recordings.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"

namespace swiftlet::test {
namespace {

using ::testing::HasSubstr;

struct BadInput {
  std::string name;
  std::function<void(const std::filesystem::path& rec)> spoil;
  std::string complaint;
  std::vector<std::string> options{};
  int exit_code = 1;

  friend std::ostream& operator<<(std::ostream& out, const BadInput& b) { return out << b.name; }
};

void for_all_frames(const std::filesystem::path& rec, std::uint16_t depth, std::string_view pose) {
  for (const int number : {0, 1, 2}) write_seven_scenes_frame(rec, number, flat(depth), pose);
}

void all_images(const std::filesystem::path& rec, PngKind kind) {
  for (const int number : {0, 1, 2})
    write_png(rec / fmt::format("frame-{:06}.depth.png", number), flat(2000), kind);
}

void unspoilt(const std::filesystem::path&) {}

const std::vector<BadInput> kBadInputs{
    {"missing_folder", [](const auto& rec) { std::filesystem::remove_all(rec); }, "no such folder"},
    {"empty_folder",
     [](const auto& rec) {
       std::filesystem::remove_all(rec);
       std::filesystem::create_directory(rec);
     },
     "rec"},
    {"truncated_png",
     [](const auto& rec) {
       for (const int number : {0, 1, 2})
         std::filesystem::resize_file(rec / fmt::format("frame-{:06}.depth.png", number), 60);
     },
     "frame-000000.depth.png"},
    {"grey_8_bit_png", [](const auto& rec) { all_images(rec, PngKind::kGrey8); },
     "frame-000000.depth.png"},
    {"rgb_png", [](const auto& rec) { all_images(rec, PngKind::kRgb8); }, "frame-000000.depth.png"},
    {"pose_with_nan",
     [](const auto& rec) { for_all_frames(rec, 2000, "nan 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"); },
     "frame-000000.pose.txt: the pose matrix is not finite"},
    {"pose_not_orthonormal",
     [](const auto& rec) { for_all_frames(rec, 2000, "2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"); },
     "frame-000000.pose.txt: the rotation is not orthonormal"},
    {"no_intrinsics",
     [](const auto& rec) { std::filesystem::remove(rec / "camera-intrinsics.txt"); },
     "rec: nobody tells the intrinsics of its camera"},
    {"singular_intrinsics",
     [](const auto& rec) { write_file(rec / "camera-intrinsics.txt", "0 0 11\n0 20 7\n0 0 1\n"); },
     "camera-intrinsics.txt"},
    {"depth_all_zero", [](const auto& rec) { for_all_frames(rec, 0, kIdentityPose); },
     "3 no_readings"},
    {"depth_all_65535", [](const auto& rec) { for_all_frames(rec, 65535, kIdentityPose); },
     "3 no_readings"},
    {"unknown_key",
     unspoilt,
     "f.yaml:2: there is no parameter 'map.voxel_cm'",
     {"--config", "f.yaml"},
     2},
    {"negative_voxel", unspoilt, "map.voxel_m: -0.2", {"--set", "map.voxel_m=-0.2"}, 2},
    {"window_smaller_than_a_voxel", unspoilt, "map.size_m", {"--set", "map.size_m=0.1"}, 2},
    {"window_of_10_TB",
     unspoilt,
     "map.size_m",
     {"--set", "map.voxel_m=0.01", "--set", "map.size_m=215"},
     2},
    {"missing_config", unspoilt, "none.yaml", {"--config", "none.yaml"}},
    {"output_folder_missing", unspoilt, "no/such/map.swl", {"-o", "no/such/map.swl"}},
    {"output_below_a_file",
     unspoilt,
     "camera-intrinsics.txt",
     {"-o", "rec/camera-intrinsics.txt/map.swl"}},
    {"output_not_writable", unspoilt, "/proc/map.swl", {"-o", "/proc/map.swl"}},
    {"cap_too_small_to_hold_anything", unspoilt, "max_bytes", {"--max-bytes", "10"}, 2},
};

class Refuses : public ::testing::TestWithParam<BadInput> {};

TEST_P(Refuses, clearly_and_leaves_no_file) {
  const BadInput& bad = GetParam();
  const TempFolder folder;
  std::filesystem::create_directory(folder / "rec");
  write_seven_scenes(folder / "rec");
  write_file(folder / "f.yaml", "map:\n  voxel_cm: 20\n");
  bad.spoil(folder / "rec");
  std::vector<std::string> arguments{"map", "7scenes:rec"};
  arguments.insert(arguments.end(), bad.options.begin(), bad.options.end());
  const Ended ended = run(arguments, folder.path());
  EXPECT_EQ(ended.exit_code, bad.exit_code) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("swiftlet: "));
  EXPECT_THAT(ended.err, HasSubstr(bad.complaint));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("map.swl")));
  }
}

INSTANTIATE_TEST_SUITE_P(, Refuses, ::testing::ValuesIn(kBadInputs),
                         [](const auto& bad) { return bad.param.name; });

/// A folder with a good map of three frames.
class BadMap : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_ / "rec");
    write_seven_scenes(folder_ / "rec");
    ASSERT_EQ(run({"map", "7scenes:rec", "-o", "a.swl"}, folder_.path()).exit_code, 0);
    good_ = content_of(folder_ / "a.swl");
  }
  void expect_refused_by_all(const std::string& complaint) const {
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"check", "a.swl"},
          {"info", "a.swl"},
          {"render", "a.swl", "-o", "x.png"},
          {"export", "a.swl", "--to", "ply", "-o", "x.ply"}}) {
      const Ended ended = run(command, folder_.path());
      EXPECT_EQ(ended.exit_code, 1) << command.front() << ended.err;
      EXPECT_THAT(ended.err, AllOf(HasSubstr("swiftlet: "), HasSubstr(complaint)))
          << command.front();
    }
    EXPECT_FALSE(std::filesystem::exists(folder_ / "x.png"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "x.ply"));
  }

  TempFolder folder_;
  std::string good_;
};

TEST_F(BadMap, of_a_newer_version_is_refused_by_name) {
  std::string newer = good_;
  newer[63] = 99;  // the header's user version: bytes 60 to 63, big endian
  write_file(folder_ / "a.swl", newer);
  expect_refused_by_all("99");
}

TEST_F(BadMap, cut_off_anywhere_is_refused) {
  for (std::size_t part = 0; part < 16; ++part) {
    write_file(folder_ / "a.swl", good_.substr(0, good_.size() * part / 16));
    expect_refused_by_all("a.swl");
  }
}

TEST_F(BadMap, with_a_flipped_bit_is_found_by_check_or_the_bit_was_in_unused_space) {
  const std::string list_before = run({"info", "a.swl"}, folder_.path()).out;
  std::size_t found = 0;
  for (std::size_t at = 40; at < good_.size(); at += good_.size() / 40) {
    std::string flipped = good_;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
    write_file(folder_ / "a.swl", flipped);
    const Ended check = run({"check", "a.swl"}, folder_.path());
    ASSERT_LE(check.exit_code, 1) << "byte " << at << ": " << check.err;
    found += check.exit_code == 1 ? 1 : 0;
    if (check.exit_code == 0) {
      EXPECT_EQ(run({"info", "a.swl"}, folder_.path()).out, list_before) << "byte " << at;
    }
  }
  EXPECT_GT(found, 0U);
}

TEST_F(BadMap, that_is_something_else_is_refused) {
  write_file(folder_ / "a.swl", "solid cube\nfacet normal 0 0 1\n");
  expect_refused_by_all("a.swl");
}

// ---- a flight that ends badly

TEST_F(BadMap, a_bad_image_or_pose_is_named_and_the_rest_is_mapped) {
  std::filesystem::resize_file(folder_ / "rec/frame-000001.depth.png", 60);
  write_seven_scenes_frame(folder_ / "rec", 3, flat(2000),
                           "inf 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  const Ended ended = run({"map", "7scenes:rec", "-o", "b.swl"}, folder_.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, AllOf(HasSubstr("frame-000001.depth.png skipped: damaged PNG"),
                               HasSubstr("frame-000003.pose.txt skipped: the pose matrix is not")));
  EXPECT_THAT(ended.out, HasSubstr("dropped    2 (1 image_unreadable, 1 pose_refused)"));
  EXPECT_EQ(run({"check", "b.swl"}, folder_.path()).exit_code, 0);
  EXPECT_EQ(load_map(folder_ / "b.swl")->frames(), 2U);
}

TEST_F(BadMap, a_full_disk_is_told_and_leaves_a_consistent_file_or_none) {
  for (const std::uint64_t limit : {1U, 4096U, 8192U, 12288U, 16384U, 24576U, 32768U}) {
    const Ended ended =
        run({"map", "7scenes:rec", "-o", "b.swl", "--overwrite"}, folder_.path(), limit);
    ASSERT_LE(ended.exit_code, 1) << ended.err;
    if (ended.exit_code == 1) {
      EXPECT_THAT(ended.err, HasSubstr("b.swl")) << limit;
    }
    if (std::filesystem::exists(folder_ / "b.swl")) {
      EXPECT_EQ(run({"check", "b.swl"}, folder_.path()).exit_code, 0) << limit;
    }
    for (const char* name : {"b.swl", "b.swl-wal", "b.swl-shm"}) {
      std::filesystem::remove(folder_ / name);
    }
  }
}

}  // namespace
}  // namespace swiftlet::test
