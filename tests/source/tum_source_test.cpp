// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/recordings.hpp"
#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using test::read_all;
using test::write_file;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::int64_t kEpoch_s = 1305031102;

/// A camera that moves along the world's x at 1 m/s and turns about the world's z at 1 rad/s,
/// looking along y: interpolation must hit it exactly. Starts at kEpoch_s.
Transform<World, Camera> true_pose(double t_s) {
  Eigen::Matrix3d R_looking_along_y;
  R_looking_along_y << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(t_s, Eigen::Vector3d::UnitZ()));
  return Transform<World, Camera>::trusted(turn * Eigen::Quaterniond(R_looking_along_y),
                                           {t_s, 2, 1});
}

std::string pose_line(double t_s) {
  const auto T = true_pose(t_s);
  const auto& q = T.rotation();
  const auto& p = T.translation();
  return fmt::format("{}.{:06} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", kEpoch_s,
                     std::llround(t_s * 1e6), p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
}

/// Images every 33.3 ms from 0 to 0.5 s, poses every 10 ms from 0.1 to 0.9 s.
class Tum : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_ / "depth");
    write_file(folder_ / "camera-intrinsics.txt", test::kSmallCamera);
    for (int i = 0; i < 16; ++i) image(i * 1.0 / 30);
    for (int i = 10; i <= 90; ++i) poses_ += pose_line(0.01 * i);
    write_lists();
  }
  void image(double t_s) {
    const auto stamp = fmt::format("{}.{:06}", kEpoch_s, std::llround(t_s * 1e6));
    test::write_png(folder_ / ("depth/" + stamp + ".png"), test::flat(10000));
    images_ += stamp + " depth/" + stamp + ".png\n";
  }
  void write_lists() {
    write_file(folder_ / "depth.txt", images_);
    write_file(folder_ / "groundtruth.txt", poses_);
  }
  [[nodiscard]] std::string address() const { return "tum:" + folder_.path().string(); }
  [[nodiscard]] static std::size_t lost(FrameTally tally, FrameLoss loss) { return tally.of(loss); }

  test::TempFolder folder_;
  std::string images_ = "# depth maps\n# file: 'rgbd_dataset.bag'\n# timestamp filename\n";
  std::string poses_ = "# ground truth trajectory\n# timestamp tx ty tz qx qy qz qw\n";
};

void expect_true_poses(const std::vector<Frame>& frames) {
  for (const Frame& frame : frames) {
    const double t_s = seconds(frame.stamp - Stamp{kEpoch_s * 1'000'000'000});
    const auto expected = true_pose(t_s);
    EXPECT_LT((frame.T_world_camera.translation() - expected.translation()).norm(), 1e-9) << t_s;
    EXPECT_LT(frame.T_world_camera.rotation().angularDistance(expected.rotation()), 1e-7) << t_s;
  }
}

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

TEST_F(Tum, takes_the_depth_unit_the_up_axis_and_a_time_offset_from_its_address) {
  const auto unit = read_all(address() + "?depth_unit_m=0.001");
  ASSERT_EQ(unit.frames.size(), 13U) << unit.error;
  EXPECT_FLOAT_EQ(unit.frames[0].depth.depth_m(0, 0), 10.0F);

  const auto up = read_all(address() + "?up=-y&depth_unit_m=0.0002");
  ASSERT_EQ(up.frames.size(), 13U) << up.error;
  const Eigen::Vector3d native = true_pose(0.1).translation();
  EXPECT_LT((up.frames[0].T_world_camera.translation() -
             Eigen::Vector3d(native.z(), -native.x(), -native.y()))
                .norm(),
            1e-9);

  // Images stamped 100 ms early by their camera: with the offset the first three have a pose, too.
  const auto offset = read_all(address() + "?time_offset_ms=100");
  ASSERT_EQ(offset.frames.size(), 16U) << offset.error;
  expect_true_poses(offset.frames);
}

TEST_F(Tum, refuses_an_option_that_cannot_be_meant_naming_those_there_are) {
  for (const char* option : {"depth_unit_m=0", "depth_unit_m=nan", "up=w", "up=+",
                             "intrinsics=", "time_offset_ms=soon", "rig=x.yaml"}) {
    EXPECT_THAT(read_all(address() + "?" + option).error,
                AllOf(HasSubstr(option), HasSubstr("cannot be meant"), HasSubstr("depth_unit_m")));
  }
}

TEST_F(Tum, may_lie_in_a_folder_with_a_question_mark_in_its_name) {
  const auto odd = folder_ / "what?up=+z";
  std::filesystem::create_directory(odd);
  for (const char* name : {"depth", "depth.txt", "groundtruth.txt", "camera-intrinsics.txt"})
    std::filesystem::rename(folder_ / name, odd / name);
  EXPECT_EQ(read_all("tum:" + odd.string()).frames.size(), 13U);
  const auto reading = read_all("tum:" + odd.string() + "?depth_unit_m=0.001");
  ASSERT_EQ(reading.frames.size(), 13U) << reading.error;
  EXPECT_FLOAT_EQ(reading.frames[0].depth.depth_m(0, 0), 10.0F);
}

TEST_F(Tum, says_whether_somebody_told_the_depth_unit) {
  EXPECT_TRUE((*open_source(address()))->info().assumed_depth_unit_m);
  EXPECT_FALSE((*open_source(address() + "?depth_unit_m=0.0002"))->info().assumed_depth_unit_m);
}

TEST_F(Tum, takes_intrinsics_by_option_before_those_of_the_folder_and_says_so) {
  const auto origin = [](const std::string& from) {
    const auto source = open_source(from);
    return source ? text_of((*source)->info().intrinsics) : source.error().text();
  };
  EXPECT_EQ(origin(address()), "file: " + (folder_ / "camera-intrinsics.txt").string());
  EXPECT_EQ(origin(address() + "?intrinsics=30,31,12,8"), "option: 30,31,12,8");
  const auto reading = read_all(address() + "?intrinsics=30,31,12,8");
  ASSERT_FALSE(reading.frames.empty()) << reading.error;
  EXPECT_EQ(reading.frames[0].intrinsics, PinholeIntrinsics::create(24, 16, 30, 31, 12, 8));

  const auto file = (folder_ / "my_camera.txt").string();
  write_file(file, "40 0 11\n0 41 7\n0 0 1\n");
  EXPECT_EQ(origin(address() + "?intrinsics=" + file), "file: " + file);
  EXPECT_EQ(read_all(address() + "?intrinsics=" + file).frames[0].intrinsics.fy(), 41.0);
  EXPECT_THAT(origin(address() + "?intrinsics=0,0,12,8"), HasSubstr("singular"));
  EXPECT_THAT(origin(address() + "?intrinsics=30,31,12"), HasSubstr("no such file"));
}

TEST_F(Tum, takes_full_scale_for_no_reading) {
  for (const std::uint16_t value : {std::uint16_t{0}, std::uint16_t{65535}}) {
    test::write_png(folder_ / "depth/1305031102.100000.png", test::flat(value));
    const auto reading = read_all(address());
    ASSERT_EQ(reading.frames.size(), 13U);
    for (const auto pixel : reading.frames[0].depth.raw.pixels()) EXPECT_EQ(pixel, 0);
  }
}

/// A folder of one image of 640 x 480 pixels, without a camera-intrinsics.txt.
class TumDataset : public ::testing::Test {
 protected:
  [[nodiscard]] std::string folder_named(const std::string& name, const std::string& head = "") {
    const auto folder = parent_ / name;
    std::filesystem::create_directory(folder);
    test::write_png(folder / "0.png", Image<std::uint16_t>(640, 480, 5000));
    write_file(folder / "depth.txt", head + "1.0 0.png\n");
    write_file(folder / "groundtruth.txt", "0.95 0 0 0 0 0 0 1\n1.05 0 0 0 0 0 0 1\n");
    return "tum:" + folder.string();
  }
  test::TempFolder parent_;
};

TEST_F(TumDataset, is_known_by_the_name_of_its_folder) {
  const std::pair<const char*, double> cameras[] = {{"rgbd_dataset_freiburg1_xyz", 517.3},
                                                    {"rgbd_dataset_freiburg2_desk", 520.9},
                                                    {"fr3_office", 535.4}};
  for (const auto& [name, fx_px] : cameras) {
    const std::string plain = folder_named(name);
    for (const auto& address : {plain, plain + "/"}) {
      const auto reading = read_all(address);
      ASSERT_EQ(reading.frames.size(), 1U) << reading.error;
      EXPECT_EQ(reading.frames[0].intrinsics.fx(), fx_px) << address;
    }
  }
}

TEST_F(TumDataset, is_known_by_the_head_of_its_list_whatever_the_folder_is_called) {
  const auto address = folder_named(
      "copy_of_fr1", "# depth maps\n# file: 'rgbd_dataset_freiburg3_cabinet.bag'\n# timestamp\n");
  const auto source = open_source(address);
  ASSERT_TRUE(source) << source.error().text();
  EXPECT_EQ(text_of((*source)->info().intrinsics),
            "known dataset: TUM freiburg3, by the head of depth.txt");
}

TEST_F(TumDataset, that_it_is_not_has_no_intrinsics_and_the_error_says_how_to_give_them) {
  for (const char* name : {"my_flight", "freiburg", "freiburg4_desk", "afr1", "fr12"}) {
    EXPECT_THAT(read_all(folder_named(name)).error,
                AllOf(HasSubstr("nobody tells the intrinsics"), HasSubstr("camera-intrinsics.txt"),
                      HasSubstr("?intrinsics=fx,fy,cx,cy")))
        << name;
  }
}

TEST_F(TumDataset, of_another_image_size_is_not_given_its_intrinsics) {
  const auto address = folder_named("freiburg1_xyz");
  test::write_png(parent_ / "freiburg1_xyz/0.png", Image<std::uint16_t>(320, 240, 5000));
  EXPECT_THAT(read_all(address).error, AllOf(HasSubstr("320 x 240"), HasSubstr("640 x 480 only")));
}

}  // namespace
}  // namespace swiftlet
