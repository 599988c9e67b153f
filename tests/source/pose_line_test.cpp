// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/pose_line.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <thread>

#include "source/udp_sender.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/source/bag/bag_streams.hpp"
#include "swiftlet/source/live/live_rig.hpp"
#include "swiftlet/source/live/pose_guard.hpp"
#include "swiftlet/source/live/pose_socket.hpp"

namespace swiftlet {
namespace {

using ::testing::HasSubstr;

TEST(PoseLine, comes_back_bit_for_bit) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-1e3, 1e3);
  for (int i = 0; i < 1000; ++i) {
    const PoseSample pose{{static_cast<std::int64_t>(random() >> 2U)},
                          Eigen::Quaterniond(any(random), any(random), any(random), any(random)),
                          {any(random), any(random), any(random)},
                          static_cast<std::uint8_t>(i % 4)};
    const auto again = parse_pose_line(pose_line(pose));
    ASSERT_TRUE(again) << again.error().text() << " in " << pose_line(pose);
    EXPECT_EQ(again->stamp, pose.stamp);
    EXPECT_EQ(again->R_world_body.coeffs(), pose.R_world_body.coeffs());
    EXPECT_EQ(again->t_world_body_m, pose.t_world_body_m);
    EXPECT_EQ(again->confidence, pose.confidence);
  }
}

TEST(PoseLine, is_full_confidence_without_a_ninth_column_and_lets_the_gates_judge_nan) {
  const auto pose = parse_pose_line("  1600000000.25 1 2\t3 0 0 nan 1 \r");
  ASSERT_TRUE(pose) << pose.error().text();
  EXPECT_EQ(pose->stamp.ns, 1'600'000'000'250'000'000);
  EXPECT_EQ(pose->confidence, 3);
  EXPECT_TRUE(std::isnan(pose->R_world_body.z()));
}

TEST(PoseLine, turns_the_axes_of_a_t265) {
  const auto pose = parse_pose_line("1 0.1 0.2 0.3 0 0 0 1", BodyAxes::kT265);
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->t_world_body_m, Eigen::Vector3d(-0.3, -0.1, 0.2));
}

TEST(PoseLine, answers_hostile_lines_with_a_reason) {
  for (const char* line :
       {"", "1", "1 2 3 4 5 6 7", "1 2 3 4 5 6 7 8 9 10", "x 0 0 0 0 0 0 1", "1 0 0 0 0 0 0 one",
        "-1 0 0 0 0 0 0 1", "1e300 0 0 0 0 0 0 1", "99999999999999999999 0 0 0 0 0 0 1",
        "1 0 0 0 0 0 0 1 4", "1 0 0 0 0 0 0 1 nan", "1 0 0 0 0 0 0 0x1", "1 0,1 0 0 0 0 0 1"}) {
    const auto pose = parse_pose_line(line);
    ASSERT_FALSE(pose) << line;
    EXPECT_FALSE(pose.error().what.empty());
  }
}

TEST(PoseLine, survives_any_bytes) {
  std::mt19937_64 random(11);
  const std::string good = "1600000000.25 1 2 3 0 0 0 1 3";
  for (int i = 0; i < 20000; ++i) {
    std::string line = good;
    for (int k = 0; k < 3; ++k) line[random() % line.size()] = static_cast<char>(random());
    const auto pose = parse_pose_line(line);
    if (pose) {
      EXPECT_GE(pose->stamp.ns, 0);
    }
  }
  EXPECT_FALSE(parse_pose_line(std::string(1'000'000, '7')));
}

/// Notes what arrives.
class Notes final : public LiveSink {
 public:
  void push(const PoseSample& pose) override {
    const std::lock_guard lock(mutex_);
    poses_.push_back(pose);
  }
  void push(DepthFrame /*depth*/) override {}
  void note(RigEvent event) override {
    const std::lock_guard lock(mutex_);
    events_.push_back(std::move(event));
  }
  void start_poses_anew() override {}
  std::optional<HostTime> last_image(std::size_t /*camera*/) const override { return {}; }
  std::optional<HostTime> last_pose() const override { return {}; }

  /// Waits up to ten seconds for that many poses.
  std::vector<PoseSample> poses(std::size_t count) {
    for (int i = 0; i < 1000; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      const std::lock_guard lock(mutex_);
      if (poses_.size() >= count) return poses_;
    }
    const std::lock_guard lock(mutex_);
    return poses_;
  }
  std::vector<RigEvent> events() {
    const std::lock_guard lock(mutex_);
    return events_;
  }

 private:
  std::mutex mutex_;
  std::vector<PoseSample> poses_;
  std::vector<RigEvent> events_;
};

TEST(PoseSocket, takes_one_or_more_lines_a_datagram_and_survives_the_rest) {
  const test::UdpSender sender;
  Notes notes;
  const auto socket = listen_for_poses(sender.port(), BodyAxes::kRep103, notes);
  ASSERT_TRUE(socket) << socket.error().text();
  sender.send("1 0 0 0 0 0 0 1\n# nothing\n\n2 0 0 0 0 0 0 1\r\n");
  sender.send("");
  sender.send(std::string("\0\xFF\n", 3));
  sender.send(std::string(60'000, '1'));
  sender.send("3 0 0 0 0 0 0 1");
  const auto poses = notes.poses(3);
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses[2].stamp.ns, 3'000'000'000);
  ASSERT_EQ(notes.events().size(), 1U) << "told at most once a second";
  EXPECT_EQ(notes.events()[0].kind, RigEventKind::kBadPose);
}

constexpr std::string_view kKey = "0123456789abcdef0123456789abcdef";

Stamp now() {
  return Stamp{Nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count()};
}

TEST(PoseGuard, admits_what_the_owner_of_the_key_sends_once_and_in_order_and_nothing_else) {
  PoseGuard guard{std::string(kKey)};
  const Stamp t = now();
  const std::string lines = "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n";
  const std::string good = signed_poses(lines, kKey, t);
  EXPECT_EQ(guard.admit(good, t), lines);
  EXPECT_EQ(guard.admit(good, t).error(), PoseDenial::kReplayed) << "the same again";
  const Stamp later = t + std::chrono::milliseconds(1);
  EXPECT_EQ(guard.admit(signed_poses(lines, kKey, later), t), lines);
  EXPECT_EQ(guard.admit(good, t).error(), PoseDenial::kReplayed) << "an older one";
  for (const auto off : {std::chrono::seconds(31), std::chrono::seconds(-31)}) {
    EXPECT_EQ(guard.admit(signed_poses(lines, kKey, t + off), t).error(), PoseDenial::kReplayed);
  }
  EXPECT_EQ(guard.admit(lines, t).error(), PoseDenial::kForged);
  EXPECT_EQ(guard.admit("", t).error(), PoseDenial::kForged);
  const Stamp last = t + std::chrono::seconds(1);
  EXPECT_EQ(guard.admit(signed_poses(lines, "another key", last), t).error(), PoseDenial::kForged);
  const std::string whole = signed_poses(lines, kKey, last);
  for (std::size_t i = 0; i + 1 < whole.size(); ++i) {  // but for the last line end
    std::string spoilt = whole;
    spoilt[i] = static_cast<char>(spoilt[i] ^ 1);
    EXPECT_FALSE(guard.admit(spoilt, t)) << "byte " << i;
  }
  EXPECT_EQ(guard.admit(whole, t), lines);
}

TEST(PoseGuard, computes_the_hmac_that_others_do) {
  // printf '1 0 0 0 0 0 0 1\nsent 5\n' | openssl dgst -sha256 -hmac 0123456789abcdef...
  EXPECT_EQ(signed_poses("1 0 0 0 0 0 0 1", kKey, Stamp{5}),
            "1 0 0 0 0 0 0 1\nsent 5\nhmac "
            "0ba54a2c61f914b7af7743e8a92d455bb78d28050edb501fc90f2e0a19a19f59\n");
}

TEST(PoseSocket, with_a_key_takes_signed_poses_and_counts_the_others_by_reason) {
  const test::TempFolder folder;
  test::write_file(folder / "key", std::string(kKey) + "\n");
  PoseAddress address;
  const test::UdpSender sender;
  address.port = sender.port();
  address.key_file = folder / "key";
  Notes notes;
  std::filesystem::permissions(folder / "key", std::filesystem::perms(0644));
  EXPECT_THAT(listen_for_poses(address, BodyAxes::kRep103, notes).error().text(),
              HasSubstr("chmod 600"));
  std::filesystem::permissions(folder / "key", std::filesystem::perms(0600));
  const auto socket = listen_for_poses(address, BodyAxes::kRep103, notes);
  ASSERT_TRUE(socket) << socket.error().text();
  const std::string good = signed_poses("1 0 0 0 0 0 0 1\n", kKey, now());
  sender.send(good);
  sender.send(good);
  sender.send("2 0 0 0 0 0 0 1\n");
  sender.send(signed_poses("3 0 0 0 0 0 0 1\n", kKey, now()));
  const auto poses = notes.poses(2);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[1].stamp.ns, 3'000'000'000);
  ASSERT_EQ(notes.events().size(), 2U);
  EXPECT_EQ(notes.events()[0].kind, RigEventKind::kReplayedPose);
  EXPECT_EQ(notes.events()[1].kind, RigEventKind::kForgedPose);
}

TEST(PoseSocket, refuses_a_key_that_is_short_or_missing) {
  const test::TempFolder folder;
  test::write_file(folder / "key", "short\n");
  std::filesystem::permissions(folder / "key", std::filesystem::perms(0600));
  EXPECT_THAT(load_pose_key(folder / "key").error().text(), HasSubstr("openssl rand"));
  EXPECT_THAT(load_pose_key(folder / "none").error().text(), HasSubstr("no such file"));
}

TEST(PoseSocket, beyond_loopback_without_a_key_is_warned_of) {
  const test::UdpSender sender;
  Notes notes;
  const auto address = parse_pose_address(fmt::format("udp:0.0.0.0:{}", sender.port()));
  ASSERT_TRUE(address);
  ASSERT_TRUE(listen_for_poses(*address, BodyAxes::kRep103, notes));
  ASSERT_EQ(notes.events().size(), 1U);
  EXPECT_EQ(notes.events()[0].kind, RigEventKind::kOpenPort);
  for (const char* bad : {"udp:", "udp:0", "udp:host:5", "udp:1.2.3.4:0", "unix:", "tcp:1"})
    EXPECT_FALSE(parse_pose_address(bad)) << bad;
}

TEST(PoseSocket, in_the_file_system_is_its_users_alone_and_takes_over_what_a_killed_one_left) {
  const test::TempFolder folder;
  const auto address = parse_pose_address("unix:" + (folder / "poses").string());
  ASSERT_TRUE(address);
  Notes notes;
  {
    const auto socket = listen_for_poses(*address, BodyAxes::kRep103, notes);
    ASSERT_TRUE(socket) << socket.error().text();
    EXPECT_EQ(std::filesystem::status(address->socket).permissions(), std::filesystem::perms(0600));
    EXPECT_FALSE(listen_for_poses(*address, BodyAxes::kRep103, notes)) << "somebody listens";
    test::send_to_path(address->socket, "1 0 0 0 0 0 0 1\n");
    EXPECT_EQ(notes.poses(1).size(), 1U);
  }
  EXPECT_FALSE(std::filesystem::exists(address->socket));
  test::leave_dead_socket(address->socket);
  EXPECT_TRUE(listen_for_poses(*address, BodyAxes::kRep103, notes));
  test::write_file(address->socket, "no socket");
  EXPECT_FALSE(listen_for_poses(*address, BodyAxes::kRep103, notes)) << "a file of the user's";
}

TEST(PoseSocket, says_that_a_port_is_taken_and_frees_its_own) {
  const test::UdpSender sender;
  Notes notes;
  {
    const auto first = listen_for_poses(sender.port(), BodyAxes::kRep103, notes);
    ASSERT_TRUE(first);
    const auto second = listen_for_poses(sender.port(), BodyAxes::kRep103, notes);
    ASSERT_FALSE(second);
    EXPECT_THAT(second.error().text(), HasSubstr(std::to_string(sender.port())));
    EXPECT_THAT(second.error().text(), HasSubstr("choose another port"));
  }
  EXPECT_TRUE(listen_for_poses(sender.port(), BodyAxes::kRep103, notes));
}

TEST(TextPoses, name_the_line_that_is_wrong) {
  const test::TempFolder folder;
  test::write_file(folder / "poses.txt", "# stamp ...\n1 0 0 0 0 0 0 1\n2 0 0 0 0 0 1\n");
  const auto poses = open_bag_poses(folder / "poses.txt", {});
  ASSERT_FALSE(poses);
  EXPECT_THAT(poses.error().text(),
              HasSubstr("poses.txt:3: a pose has 8 or 9 columns, this line 7"));
  test::write_file(folder / "none.txt", "# stamp ...\n");
  EXPECT_THAT(open_bag_poses(folder / "none.txt", {}).error().text(), HasSubstr("no poses"));
}

}  // namespace
}  // namespace swiftlet
