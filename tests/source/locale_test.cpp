// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <clocale>
#include <locale>
#include <sstream>

#include "support/temp_folder.hpp"
#include "swiftlet/base/number_text.hpp"
#include "swiftlet/file/output_file.hpp"
#include "swiftlet/sim/ply_reader.hpp"
#include "swiftlet/sim/scene_file.hpp"
#include "swiftlet/source/folders/openloris_calibration.hpp"
#include "swiftlet/source/rig/rig_file.hpp"
#include "swiftlet/source/text_file.hpp"
#include "swiftlet/store/export/octomap_import.hpp"

namespace swiftlet {
namespace {

/// As in much of Europe: 1.234,5.
struct CommaNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// A host program that works in such a locale, as C++ and (where it is installed) as C.
class CommaLocale {
 public:
  CommaLocale()
      : before_(std::locale::global(std::locale(std::locale::classic(), new CommaNumbers))) {
    std::setlocale(LC_ALL, "de_DE.UTF-8");
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;
  ~CommaLocale() {
    std::locale::global(before_);
    std::setlocale(LC_ALL, "C");
  }

 private:
  std::locale before_;
};

constexpr std::string_view kRig = "cameras:\n  - at_m: [0.125, -0.5, +0.25]\n    looks: forward\n";

constexpr std::string_view kSensors =
    "%YAML:1.0\n---\ncamera:\n  width: 1280\n  height: 800\n"
    "  intrinsics: {data: [ 1020.5, 640., 1021.25, 400. ]}\n";
constexpr std::string_view kTransforms =
    "%YAML:1.0\n---\ntrans_matrix:\n  - parent_frame: base_link\n    child_frame: camera\n"
    "    matrix: {data: [ 1., 0., 0., 0.25, 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1. ]}\n";
constexpr std::string_view kTree =
    "# Octomap OcTree binary file\nid OcTree\nsize 0\nres 0.05\ndata\n";
constexpr std::string_view kMesh =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0.5 0 -1500.25\n1 0 0\n0 1 1e-2\n3 0 1 2\n";

/// What every reader of numbers makes of them, as one text.
std::string all_that_is_read(const std::filesystem::path& folder) {
  std::string text;
  const auto add = [&](const auto& read, auto tell) {
    text += read ? fmt::format("{}\n", tell(*read)) : read.error().text() + "\n";
  };
  add(parse_rig(kRig, "rig.yaml"), [](const RigDescription& rig) {
    const auto& t = rig.rig.cameras.front().T_body_camera.translation();
    return fmt::format("rig {} {} {}", t.x(), t.y(), t.z());
  });
  add(read_openloris_camera(folder, "camera"), [](const OpenLorisCamera& camera) {
    const auto& i = camera.intrinsics;
    return fmt::format("openloris {} {} {} {}", i.width(), i.fx(), i.cy(),
                       camera.T_body_camera.translation().x());
  });
  add(read_octomap(folder / "map.bt", {}),
      [](const OctomapSummary& tree) { return fmt::format("octomap {}", tree.voxel_m); });
#if SWIFTLET_HAS_EMBREE
  std::istringstream mesh_text{std::string(kMesh)};
  add(sim::read_ply(mesh_text, "wall.ply"), [](const sim::TriangleMesh& mesh) {
    return fmt::format("ply {} {} {}", mesh.vertices_m[0].x(), mesh.vertices_m[0].z(),
                       mesh.vertices_m[2].z());
  });
#endif
  text += fmt::format("number {}\n", parse_number("-1500.25").value_or(0.0));
  return text;
}

TEST(CommaLocale, of_a_host_program_changes_nothing_that_is_read) {
  const test::TempFolder folder;
  test::write_file(folder / "sensors.yaml", kSensors);
  test::write_file(folder / "trans_matrix.yaml", kTransforms);
  test::write_file(folder / "map.bt", kTree);
  const std::string expected = all_that_is_read(folder.path());
  EXPECT_NE(expected.find("rig 0.125 -0.5 0.25\n"), std::string::npos) << expected;
  EXPECT_NE(expected.find("openloris 1280 1020.5 400 0.25\n"), std::string::npos) << expected;
  EXPECT_NE(expected.find("octomap 0.05\n"), std::string::npos) << expected;

  const CommaLocale comma;
  EXPECT_EQ(all_that_is_read(folder.path()), expected);
}

TEST(CommaLocale, of_a_host_program_changes_nothing_that_is_written) {
  const test::TempFolder folder;
  const CommaLocale comma;
  auto file = OutputFile::create(folder / "out");
  ASSERT_TRUE(file);
  file->stream() << 1234.5 << ' ' << 10000;
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(test::content_of(folder / "out"), "1234.5 10000");
}

}  // namespace
}  // namespace swiftlet
