// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "app/support/run_program.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/doctor/doctor_checks.hpp"
#include "swiftlet/source/rig/rig_file.hpp"

namespace swiftlet::test {
namespace {

using namespace doctor;
using nlohmann::json;
using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::HasSubstr;

/// A D435 and a T265 in good health, as the doctor would see them.
DoctorExam healthy() {
  DoctorExam exam{.subject = "realsense:"};
  exam.system = RealsenseSystem{
      "2.53.1",
      true,
      {{"Intel RealSense D435", "S1", "5.12.7.100", "5.12.7.100", "3.2", {"848x480@30"}, false},
       {"Intel RealSense T265", "S2", "0.2.0.951", "0.2.0.951", "2.1", {}, true}}};
  exam.rig = intel_t265_d435_rig().rig;
  exam.is_t265 = true;
  exam.intrinsics = IntrinsicsNote{IntrinsicsOrigin::kSdk, {}};
  exam.facts.emplace();
  exam.facts->cameras.resize(1);
  for (int t_ms = 0; t_ms <= 2000; t_ms += 5) {
    const Stamp stamp{t_ms * 1'000'000LL};
    PoseSample pose{stamp, Eigen::Quaterniond::Identity(), {1e-3 * t_ms, 0, 0}};
    pose.clock = ClockDomain::kGlobal;
    exam.facts->poses.note(pose);
    if (t_ms % 35 != 0) continue;
    DepthFrame depth{stamp, DepthImage{}, PinholeIntrinsics::create(4, 4, 4, 4, 2, 2).value()};
    depth.clock = ClockDomain::kGlobal;
    exam.facts->cameras[0].note(depth);
  }
  exam.tally.delivered = 58;
  exam.readings = {{.pixels = 1000, .readings = 900, .medians_m = {2.0F}}};
  return exam;
}

/// The worst that a check finds, "good" for nothing at all.
Severity worst(const DoctorExam& exam, std::string_view check) {
  const auto found = find_registered(doctor_checks(), check, "check");
  EXPECT_TRUE(found);
  std::vector<Finding> findings;
  if (found) found->make(exam, findings);
  Severity worst = Severity::kGood;
  for (const Finding& finding : findings) {
    worst = std::max(worst, finding.severity);
    EXPECT_FALSE(finding.what.empty());
    EXPECT_EQ(finding.remedy.empty(), finding.severity == Severity::kGood)
        << check << ": says what to do, and only where there is something: " << finding.what;
  }
  return worst;
}

/// One thing that is wrong, the check that must see it, and how bad it is.
struct Illness {
  std::string_view check;
  Severity severity;
  void (*infect)(DoctorExam& exam);
};

void all_clocks(StreamStatistics& stream, ClockDomain clock) {
  stream.clocks.fill(0);
  stream.clocks[static_cast<std::size_t>(clock)] = stream.samples;
}

const Illness kIllnesses[]{
    {"sdk", Severity::kNote, [](DoctorExam& e) { e.system->can_know_t265 = false; }},
    {"devices", Severity::kFault, [](DoctorExam& e) { e.system->devices.clear(); }},
    {"devices", Severity::kWarning, [](DoctorExam& e) { e.system->devices.pop_back(); }},
    {"firmware", Severity::kWarning,
     [](DoctorExam& e) { e.system->devices[0].firmware = "5.9.14.0"; }},
    {"usb", Severity::kFault, [](DoctorExam& e) { e.system->devices[0].usb = "2.1"; }},
    {"profile", Severity::kWarning,
     [](DoctorExam& e) { e.system->devices[0].depth_profiles = {"480x270@6"}; }},
    {"reading", Severity::kFault,
     [](DoctorExam& e) {
       e.fault = Error{ErrorCode::kIo, "x", "is gone", ""};
     }},
    {"intrinsics", Severity::kWarning, [](DoctorExam& e) { e.intrinsics->origin = {}; }},
    {"intrinsics", Severity::kNote,
     [](DoctorExam& e) { e.intrinsics->origin = IntrinsicsOrigin::kKnownDataset; }},
    {"depth_units", Severity::kWarning, [](DoctorExam& e) { e.depth_doubt = "all is near"; }},
    {"mounts", Severity::kFault,
     [](DoctorExam& e) {
       e.rig.cameras[0].T_body_camera =
           Transform<Body, Camera>::trusted(Eigen::Quaterniond::Identity(), {28, 0, 0});
     }},
    {"mounts", Severity::kWarning, [](DoctorExam& e) { e.is_t265 = false; }},
    {"clocks", Severity::kFault,
     [](DoctorExam& e) { all_clocks(e.facts->cameras[0], ClockDomain::kDevice); }},
    {"clocks", Severity::kFault,
     [](DoctorExam& e) { all_clocks(e.facts->cameras[0], ClockDomain::kSystem); }},
    {"clocks", Severity::kWarning,
     [](DoctorExam& e) {
       all_clocks(e.facts->cameras[0], ClockDomain::kSystem);
       all_clocks(e.facts->poses, ClockDomain::kSystem);
     }},
    {"clocks", Severity::kNote, [](DoctorExam& e) { --e.facts->cameras[0].clocks[1]; }},
    {"depth_rate", Severity::kFault, [](DoctorExam& e) { e.facts->cameras[0] = {}; }},
    {"depth_rate", Severity::kWarning,
     [](DoctorExam& e) { e.facts->cameras[0].longest_gap = std::chrono::seconds(1); }},
    {"depth_rate", Severity::kWarning, [](DoctorExam& e) { e.facts->cameras[0].backward = 3; }},
    {"pose_rate", Severity::kFault, [](DoctorExam& e) { e.facts->poses = {}; }},
    {"pose_rate", Severity::kWarning, [](DoctorExam& e) { e.facts->poses.samples /= 10; }},
    {"pose_rate", Severity::kWarning,
     [](DoctorExam& e) { e.facts->poses.longest_gap = std::chrono::milliseconds(300); }},
    {"overlap", Severity::kFault,
     [](DoctorExam& e) { e.facts->poses.first = e.facts->poses.last = Stamp{9'000'000'000}; }},
    {"overlap", Severity::kWarning,
     [](DoctorExam& e) { e.facts->poses.last = Stamp{1'000'000'000}; }},
    {"confidence", Severity::kWarning,
     [](DoctorExam& e) {
       e.facts->poses.confidence = {0, 200, 0, 201};
     }},
    {"poses", Severity::kWarning, [](DoctorExam& e) { e.facts->poses.broken = 7; }},
    {"poses", Severity::kFault, [](DoctorExam& e) { e.facts->poses.least_tilt_rad = 1.5; }},
    {"poses", Severity::kWarning, [](DoctorExam& e) { e.tally.pose_jumps = 1; }},
    {"poses", Severity::kNote, [](DoctorExam& e) { e.facts->poses.high_m = e.facts->poses.low_m; }},
    {"depth_units", Severity::kWarning, [](DoctorExam& e) { e.readings[0].medians_m = {2000.0F}; }},
    {"readings", Severity::kWarning, [](DoctorExam& e) { e.readings[0].readings = 100; }},
    {"clocks", Severity::kWarning, [](DoctorExam& e) { e.tally.pose_clock.back = 1; }},
    {"depth_rate", Severity::kWarning, [](DoctorExam& e) { e.tally.of(FrameLoss::kBadStamp) = 1; }},
    {"depth_rate", Severity::kWarning,
     [](DoctorExam& e) {
       e.rig.cameras.resize(2);
       e.facts->cameras.push_back(e.facts->cameras[0]);
       e.facts->cameras[0].last = Stamp{9'000'000'000};
     }},
    {"depth_rate", Severity::kNote,
     [](DoctorExam& e) {
       e.facts->cameras[0].intrinsics_changed = Stamp{1'000'000'000};
       e.facts->cameras[0].intrinsics_changes = 1;
     }},
    {"poses", Severity::kWarning, [](DoctorExam& e) { e.tally.poses_refused_by.back() = 1; }},
    {"frames", Severity::kFault,
     [](DoctorExam& e) {
       e.tally.delivered = 0;
       e.tally.of(FrameLoss::kPoseStale) = 58;
     }},
    {"frames", Severity::kWarning, [](DoctorExam& e) { e.tally.of(FrameLoss::kNoPose) = 58; }},
};

TEST(DoctorChecks, find_nothing_wrong_with_a_healthy_rig) {
  for (const auto& check : doctor_checks())
    EXPECT_LE(worst(healthy(), check.name), Severity::kNote) << check.name;
}

TEST(DoctorChecks, each_find_what_they_are_for) {
  std::set<std::string_view> seen;
  for (const Illness& illness : kIllnesses) {
    DoctorExam exam = healthy();
    illness.infect(exam);
    EXPECT_EQ(worst(exam, illness.check), illness.severity) << illness.check;
    seen.insert(illness.check);
  }
  EXPECT_EQ(seen.size(), doctor_checks().size()) << "every check has an illness here";
}

TEST(DoctorChecks, do_not_call_a_pose_of_the_camera_itself_askew) {
  DoctorExam exam = healthy();
  const Eigen::Quaterniond optical(0.5, -0.5, 0.5, -0.5);  // of a camera that looks along x
  exam.facts->poses = {};
  for (int t_ms = 0; t_ms <= 2000; t_ms += 5)
    exam.facts->poses.note({Stamp{t_ms * 1'000'000LL}, optical, {1e-3 * t_ms, 0, 0}});
  EXPECT_EQ(worst(exam, "poses"), Severity::kFault);
  exam.rig.cameras[0].T_body_camera = {};
  EXPECT_EQ(worst(exam, "poses"), Severity::kNote);
}

TEST(DoctorChecks, survive_a_rig_of_which_nothing_is_known) {
  const DoctorExam nothing;
  for (const auto& check : doctor_checks()) EXPECT_EQ(worst(nothing, check.name), Severity::kGood);
}

class DoctorProgram : public ::testing::Test {
 protected:
  json examine(const std::vector<std::string>& words, int exit_code) const {
    std::vector<std::string> all{"doctor", "--json"};
    all.insert(all.end(), words.begin(), words.end());
    const Ended ended = run(all, folder_.path());
    EXPECT_EQ(ended.exit_code, exit_code) << ended.out << ended.err;
    return json::parse(ended.out, nullptr, false);
  }
  static std::set<std::string> checks(const json& report, const std::string& severity) {
    std::set<std::string> names;
    for (const auto& finding : report["findings"]) {
      if (finding["severity"] == severity) names.insert(finding["check"].get<std::string>());
    }
    return names;
  }
  TempFolder folder_;
};

TEST_F(DoctorProgram, says_that_there_is_no_camera_or_no_sdk_and_what_to_do) {
  const Ended ended = run({"doctor"}, folder_.path());
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.out, AnyOf(HasSubstr("this build of Swiftlet has no RealSense SDK"),
                               HasSubstr("no depth camera is connected")));
  EXPECT_THAT(ended.out, HasSubstr("-> "));
  EXPECT_THAT(ended.err, HasSubstr("swiftlet: doctor: 1 fault found"));
}

TEST_F(DoctorProgram, refuses_what_cannot_be_meant) {
  EXPECT_EQ(run({"doctor", "kitti:x"}, folder_.path()).exit_code, 2);
  EXPECT_EQ(run({"doctor", "--seconds", "-1"}, folder_.path()).exit_code, 2);
  EXPECT_EQ(run({"record", "sim:wall", "-o", "d"}, folder_.path()).exit_code, 2);
  EXPECT_EQ(run({"record", "realsense"}, folder_.path()).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "d"));
}

TEST_F(DoctorProgram, records_nothing_where_there_is_no_camera) {
  const Ended ended = run({"record", "realsense", "-o", "rec"}, folder_.path());
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, AnyOf(HasSubstr("no RealSense SDK"), HasSubstr("is connected")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "rec")) << "nothing half-written";
}

TEST_F(DoctorProgram, tells_a_file_that_cannot_be_read) {
  const json report = examine({"bag:nowhere.bag"}, 1);
  EXPECT_EQ(report["faults"], 1);
  EXPECT_THAT(report["findings"][0]["what"].get<std::string>(), HasSubstr("nowhere.bag"));
}

#if SWIFTLET_HAS_EMBREE
TEST_F(DoctorProgram, examines_a_simulated_rig) {
  const json report = examine({"sim:corridor_loop?frames=30"}, 0);
  EXPECT_EQ(report["faults"], 0);
  EXPECT_GT(report["poses"]["rate_hz"].get<double>(), 190.0);
  EXPECT_EQ(report["cameras"][0]["samples"], 30);
  EXPECT_THAT(checks(report, "good"),
              ::testing::IsSupersetOf({"mounts", "clocks", "pose_rate", "overlap", "depth_units"}));
}

TEST_F(DoctorProgram, finds_a_tracker_that_dies) {
  const json report = examine({"sim:corridor_loop?frames=60&fault=dead&fault_at=0.5"}, 0);
  EXPECT_THAT(checks(report, "warning"), Contains("overlap"));
  EXPECT_THAT(checks(report, "warning"), Contains("frames"));
}

TEST_F(DoctorProgram, finds_a_jump_and_broken_poses) {
  EXPECT_THAT(checks(examine({"sim:corridor_loop?frames=60&fault=jump&fault_at=1"}, 0), "warning"),
              Contains("poses"));
  EXPECT_THAT(checks(examine({"sim:corridor_loop?frames=60&fault=nan"}, 0), "warning"),
              Contains("poses"));
}
#endif  // SWIFTLET_HAS_EMBREE

}  // namespace
}  // namespace swiftlet::test
