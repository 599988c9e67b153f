// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source/tum_folder.hpp"
#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using test::expect_true_poses;
using test::kEpoch_s;
using test::pose_line;
using test::read_all;
using test::Tum;
using test::write_file;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST_F(Tum, gives_every_image_the_pose_of_its_own_time) {
  const auto reading = read_all(address());
  EXPECT_EQ(reading.error, "");
  ASSERT_EQ(reading.frames.size(), 13U);
  EXPECT_EQ(lost(reading.tally, FrameLoss::kNoPose), 3U) << "three images before the first pose";
  EXPECT_EQ(reading.frames.front().stamp.ns, kEpoch_s * 1'000'000'000 + 100'000'000);
  expect_true_poses(reading.frames);
}

TEST_F(Tum, counts_5000_steps_to_the_metre) {
  const auto reading = read_all(address());
  ASSERT_FALSE(reading.frames.empty());
  EXPECT_FLOAT_EQ(reading.frames[0].depth.depth_m(0, 0), 2.0F);
  const auto source = open_source(address());
  EXPECT_EQ((*source)->info().frame_count, 16U);
  EXPECT_EQ((*source)->info().native_up_axis, "+z");
}

TEST_F(Tum, does_not_care_for_the_order_of_its_lists) {
  test::for_each_seed(3, [&](test::Random& random) {
    const auto shuffled = [&](const std::string& text) {
      std::vector<std::string> lines;
      for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin) + 1;
        lines.push_back(text.substr(begin, end - begin));
        begin = end;
      }
      std::ranges::shuffle(lines, random.engine());
      std::string joined;
      for (const auto& line : lines) joined += line;
      return joined;
    };
    write_file(folder_ / "depth.txt", shuffled(images_));
    write_file(folder_ / "groundtruth.txt", shuffled(poses_));
    const auto reading = read_all(address());
    EXPECT_EQ(reading.frames.size(), 13U) << reading.error;
    expect_true_poses(reading.frames);
  });
}

TEST_F(Tum, takes_windows_line_ends_blank_lines_and_comments_anywhere) {
  images_ += "\r\n   \n#1305031102.9 depth/none.png\n";
  std::string dos;
  for (const char c : poses_) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
  poses_ = dos;
  write_lists();
  EXPECT_EQ(read_all(address()).frames.size(), 13U);
}

TEST_F(Tum, keeps_the_first_of_two_lines_of_one_time_and_counts_the_other) {
  image(0.3);
  image(0.3);
  poses_ += fmt::format("{}.200000 9 9 9 0 0 0 1\n", kEpoch_s);
  write_lists();
  const auto reading = read_all(address());
  EXPECT_EQ(reading.frames.size(), 13U) << reading.error;
  EXPECT_EQ(lost(reading.tally, FrameLoss::kOutOfOrder), 2U);
  EXPECT_EQ(reading.tally.poses_refused, 1U);
  expect_true_poses(reading.frames);
}

TEST_F(Tum, loses_and_counts_the_images_inside_a_gap_of_the_ground_truth) {
  poses_.clear();
  for (const int i : {0, 5, 10, 35, 40, 45, 50}) poses_ += pose_line(0.01 * i);
  write_lists();
  const auto reading = read_all(address());
  // 250 ms without a pose: the images at 0.133 ... 0.333 s.
  EXPECT_EQ(lost(reading.tally, FrameLoss::kPoseGap), 7U);
  EXPECT_EQ(reading.frames.size(), 9U);
  expect_true_poses(reading.frames);
}

TEST_F(Tum, loses_and_counts_the_images_after_the_last_pose) {
  poses_.clear();
  for (int i = 0; i <= 20; ++i) poses_ += pose_line(0.01 * i);
  write_lists();
  const auto reading = read_all(address());
  EXPECT_EQ(reading.frames.size(), 7U) << "0 to 0.2 s";
  EXPECT_EQ(lost(reading.tally, FrameLoss::kNoPose), 9U);
}

TEST_F(Tum, refuses_lists_that_do_not_overlap_in_time_showing_both_ranges) {
  write_file(folder_ / "groundtruth.txt", "100.5 0 0 0 0 0 0 1\n101.25 0 0 0 0 0 0 1\n");
  EXPECT_THAT(read_all(address()).error, AllOf(HasSubstr("1305031102.000 to 1305031102.500 s"),
                                               HasSubstr("100.500 to 101.250 s")));
}

TEST_F(Tum, refuses_a_malformed_line_naming_file_and_line) {
  const std::pair<const char*, const char*> bad_poses[] = {
      {"1305031102.5 0 0 0 0 0 0\n", "8 columns"},
      {"1305031102.5 0 0 0 0 0 0 1 7\n", "8 columns"},
      {"soon 0 0 0 0 0 0 1\n", "'soon' is not a time"},
      {"1305031102.5 0 x 0 0 0 0 1\n", "'x' is not a number"},
  };
  for (const auto& [line, complaint] : bad_poses) {
    write_file(folder_ / "groundtruth.txt", "# one\n\n" + std::string(line) + pose_line(0.2));
    EXPECT_THAT(read_all(address()).error,
                AllOf(HasSubstr("groundtruth.txt:3"), HasSubstr(complaint)));
  }
  write_lists();
  write_file(folder_ / "depth.txt", images_ + "1305031103.0\n");
  EXPECT_THAT(read_all(address()).error, AllOf(HasSubstr("depth.txt:20"), HasSubstr("2 columns")));
}

TEST_F(Tum, refuses_a_folder_that_lacks_a_list_or_lists_nothing) {
  for (const char* list : {"depth.txt", "groundtruth.txt"}) {
    write_file(folder_ / list, "# nothing\n");
    EXPECT_THAT(read_all(address()).error, AllOf(HasSubstr(list), HasSubstr("lists nothing")));
    std::filesystem::remove(folder_ / list);
    EXPECT_THAT(read_all(address()).error, AllOf(HasSubstr(list), HasSubstr("no such file")));
    write_lists();
  }
}

TEST_F(Tum, leaves_out_and_counts_poses_that_are_none) {
  const std::pair<const char*, PoseRefusal> bad_poses[] = {
      {"1305031102.255 0 nan 0 0 0 0 1\n", PoseRefusal::kNotFinite},
      {"1305031102.255 0 0 0 nan 0 0 1\n", PoseRefusal::kNotFinite},
      {"1305031102.255 0 -inf 0 0 0 0 1\n", PoseRefusal::kNotFinite},
      {"1305031102.255 0 0 0 0 0 0 0\n", PoseRefusal::kNotUnit},
      {"1305031102.255 0 0 0 0.5 0.5 0.5 0.6\n", PoseRefusal::kNotUnit},
  };
  for (const auto& [line, refusal] : bad_poses) {
    write_file(folder_ / "groundtruth.txt", std::string(line) + poses_);
    const auto reading = read_all(address());
    EXPECT_EQ(reading.error, "") << line;
    EXPECT_EQ(reading.frames.size(), 13U) << line;
    EXPECT_EQ(reading.tally.poses_refused_by[static_cast<std::size_t>(refusal)], 1U) << line;
    expect_true_poses(reading.frames);
  }
}

TEST_F(Tum, leaves_out_and_counts_an_image_that_is_missing_or_no_depth_and_names_it) {
  const auto file = folder_ / "depth/1305031102.300000.png";
  test::write_png(file, test::flat(1), test::PngKind::kRgb8);
  const auto wrong = read_all(address());
  EXPECT_EQ(wrong.error, "");
  EXPECT_EQ(wrong.frames.size(), 12U);
  EXPECT_EQ(lost(wrong.tally, FrameLoss::kImageUnreadable), 1U);
  ASSERT_EQ(wrong.events.size(), 1U);
  EXPECT_EQ(wrong.events[0].kind, RigEventKind::kSkipped);
  EXPECT_THAT(wrong.events[0].who, HasSubstr("1305031102.300000.png"));
  EXPECT_THAT(wrong.events[0].what, HasSubstr("8-bit RGB"));

  std::filesystem::remove(file);
  const auto missing = read_all(address());
  EXPECT_EQ(missing.frames.size(), 12U) << missing.error;
  EXPECT_EQ(lost(missing.tally, FrameLoss::kImageMissing), 1U);
  expect_true_poses(missing.frames);
}

TEST_F(Tum, takes_its_camera_from_the_first_image_that_can_be_read) {
  std::filesystem::remove(folder_ / "depth/1305031102.000000.png");
  write_file(folder_ / "depth/1305031102.033333.png", "no image");
  const auto reading = read_all(address());
  EXPECT_EQ(reading.frames.size(), 13U) << reading.error;
  EXPECT_EQ(lost(reading.tally, FrameLoss::kImageMissing), 1U);
  EXPECT_EQ(lost(reading.tally, FrameLoss::kImageUnreadable), 1U);
}

TEST_F(Tum, without_a_single_good_image_is_an_error_that_names_the_first) {
  for (const auto& image : std::filesystem::directory_iterator(folder_ / "depth"))
    write_file(image.path(), "no image");
  EXPECT_THAT(read_all(address()).error,
              AllOf(HasSubstr("1305031102.000000.png"), HasSubstr("damaged PNG")));
}

}  // namespace
}  // namespace swiftlet
