// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/export/exporters.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

#if SWIFTLET_HAS_OCTOMAP
#include "store/octomap_leaves.hpp"
#endif

#include "store/store_support.hpp"
#include "swiftlet/bag/open_recording.hpp"
#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/store/export/octomap_import.hpp"

namespace swiftlet {
namespace {

using test::Random;
using test::TempFolder;
using Voxels = std::map<VoxelIndex, Occupancy>;

constexpr OccupancyThresholds kThresholds;

/// A map with noise, with whole blocks of one state (which OctoMap prunes) and on both sides of 0.
struct ExportedMap {
  ExportedMap() {
    Random random;
    auto store = BlockStore::create(folder / "a.swl", 0.05);
    for (int i = 0; i < 60; ++i) {
      const BlockIndex index{random.integer(-4, 4), random.integer(-4, 4), random.integer(-2, 1)};
      const VoxelBlock block =
          i % 2 == 0 ? test::random_block(random) : test::block_full_of(random.integer(0, 255));
      (*store)->evict(index, block, static_cast<std::uint64_t>(i));
    }
    EXPECT_TRUE((*store)->close());
    for (const auto& [index, block] : test::blocks_in(folder / "a.swl")) {
      for (int offset = 0; offset < kBlockVoxels; ++offset) {
        const auto state = kThresholds.classify(block.voxels[static_cast<std::size_t>(offset)]);
        if (state != Occupancy::kUnknown) voxels[voxel_at(index, offset)] = state;
        if (state == Occupancy::kOccupied) ++occupied;
      }
    }
  }
  [[nodiscard]] std::filesystem::path write(const char* format) const {
    const auto map = load_map(folder / "a.swl");
    const auto out = folder / (std::string("a.") + format).c_str();
    const auto done = export_map(format, *map, out);
    EXPECT_TRUE(done.has_value()) << (done ? "" : done.error().text());
    EXPECT_FALSE(std::filesystem::exists(out.string() + ".part"));
    return out;
  }
  TempFolder folder;
  Voxels voxels;
  std::uint64_t occupied = 0;
};

bool has_tool(const char* name) {
  return std::system(("command -v " + std::string(name) + " > /dev/null").c_str()) == 0;
}

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The points of an ASCII PCD, as voxels; PCL itself wrote it.
std::vector<VoxelIndex> voxels_of_ascii_pcd(const std::filesystem::path& path) {
  std::vector<VoxelIndex> voxels;
  bool is_data = false;
  for (const std::string& line : lines_of(path)) {
    double x = 0;
    double y = 0;
    double z = 0;
    if (is_data && std::sscanf(line.c_str(), "%lf %lf %lf", &x, &y, &z) == 3) {
      voxels.push_back(voxel_containing({x, y, z}, 0.05));
    }
    is_data = is_data || line.starts_with("DATA ascii");
  }
  std::ranges::sort(voxels);
  return voxels;
}

std::vector<VoxelIndex> occupied_of(const Voxels& voxels) {
  std::vector<VoxelIndex> occupied;
  for (const auto& [v, state] : voxels) {
    if (state == Occupancy::kOccupied) occupied.push_back(v);
  }
  return occupied;
}

TEST(Exporters, pcl_reads_our_ply_and_pcd_with_exactly_the_occupied_voxels) {
  if (!has_tool("pcl_ply2pcd") || !has_tool("pcl_convert_pcd_ascii_binary")) {
    GTEST_SKIP() << "pcl-tools is not installed";
  }
  const ExportedMap map;
  const auto run = [&](const std::string& command) {
    ASSERT_EQ(std::system((command + " > /dev/null 2>&1").c_str()), 0) << command;
  };
  run("pcl_convert_pcd_ascii_binary " + map.write("pcd").string() + " " +
      (map.folder / "pcd.txt").string() + " 0");
  EXPECT_EQ(voxels_of_ascii_pcd(map.folder / "pcd.txt"), occupied_of(map.voxels));

  run("pcl_ply2pcd -format 0 " + map.write("ply").string() + " " +
      (map.folder / "ply.pcd").string());
  EXPECT_EQ(voxels_of_ascii_pcd(map.folder / "ply.pcd"), occupied_of(map.voxels));
}

TEST(Exporters, mcap_holds_exactly_the_occupied_voxels_as_a_cloud) {
  const ExportedMap map;
  auto reader = open_recording(map.write("mcap"));
  ASSERT_TRUE(reader) << reader.error().text();
  const auto message = (*reader)->next();
  ASSERT_TRUE(message && *message);
  EXPECT_EQ((*message)->connection->topic, "/map/occupied");
  const auto cloud = ros::parse_point_cloud((*message)->serialized());
  ASSERT_TRUE(cloud);
  ASSERT_EQ(cloud->data.size(), std::size_t{cloud->width} * cloud->point_step);
  std::vector<VoxelIndex> voxels;
  for (std::size_t at = 0; at < cloud->data.size(); at += cloud->point_step) {
    float p[3];
    std::memcpy(p, cloud->data.data() + at, sizeof(p));
    voxels.push_back(voxel_containing({p[0], p[1], p[2]}, 0.05));
  }
  std::ranges::sort(voxels);
  EXPECT_EQ(voxels, occupied_of(map.voxels));
  EXPECT_FALSE((*reader)->next().value()) << "one cloud, no more";
  EXPECT_TRUE((*reader)->info().is_closed);
}

TEST(Exporters, leave_nothing_behind_when_they_fail) {
  const ExportedMap map;
  const auto saved = load_map(map.folder / "a.swl");
  for (const auto& exporter : exporters()) {
    if (exporter.make == nullptr) continue;
    const auto failed = exporter.make(*saved, "/nowhere/at/all/a", {});
    ASSERT_FALSE(failed.has_value()) << exporter.name;
    EXPECT_EQ(failed.error().code, ErrorCode::kIo);
    const auto full = exporter.make(*saved, "/proc/a", {});
    EXPECT_FALSE(full.has_value()) << exporter.name;
  }
  const auto unknown = export_map("dwg", *saved, map.folder / "a.dwg");
  ASSERT_FALSE(unknown.has_value());
  EXPECT_NE(unknown.error().remedy.find("ply"), std::string::npos);
}

TEST(Exporters, report_progress_up_to_one) {
  const ExportedMap map;
  const auto saved = load_map(map.folder / "a.swl");
  double last = 0.0;
  ASSERT_TRUE(export_map("ply", *saved, map.folder / "a.ply", [&](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  }));
  EXPECT_EQ(last, 1.0);
}

/// Points that begin with three numbers of a type, in files whose header ends with a line.
template <class Number>
std::vector<VoxelIndex> voxels_of_binary(const std::filesystem::path& path,
                                         std::string_view last_line, std::size_t point_bytes,
                                         const Eigen::Vector3d& origin_m) {
  const auto bytes = test::bytes_of(path);
  const std::string_view text(bytes.data(), bytes.size());
  std::vector<VoxelIndex> voxels;
  for (std::size_t at = text.find(last_line) + last_line.size(); at + point_bytes <= text.size();
       at += point_bytes) {
    Eigen::Matrix<Number, 3, 1> p;
    std::memcpy(p.data(), text.data() + at, sizeof p);
    voxels.push_back(voxel_containing(p.template cast<double>() + origin_m, 0.05));
  }
  std::ranges::sort(voxels);
  return voxels;
}

TEST(Exporters, distinct_voxels_keep_distinct_points_far_from_the_origin) {
  Random random;
  const TempFolder folder;
  const BlockIndex far{2'250'000, -13'500'000 / 8, 625};  // 900 km east, 675 km south
  const VoxelBlock block = test::random_block(random);
  auto store = BlockStore::create(folder / "far.swl", 0.05);
  (*store)->evict(far, block, 1);
  ASSERT_TRUE((*store)->close());
  std::vector<VoxelIndex> occupied;
  for (int offset = 0; offset < kBlockVoxels; ++offset) {
    if (kThresholds.classify(block.voxels[static_cast<std::size_t>(offset)]) ==
        Occupancy::kOccupied)
      occupied.push_back(voxel_at(far, offset));
  }
  std::ranges::sort(occupied);
  const auto map = load_map(folder / "far.swl");
  ASSERT_TRUE(export_map("ply", *map, folder / "far.ply"));
  EXPECT_EQ(voxels_of_binary<double>(folder / "far.ply", "end_header\n", 28, {0, 0, 0}), occupied);

  ASSERT_TRUE(export_map("pcd", *map, folder / "far.pcd"));
  const auto origin = pcd_origin(*map);
  ASSERT_TRUE(origin);
  EXPECT_EQ(voxels_of_binary<float>(folder / "far.pcd", "DATA binary\n", 16, *origin), occupied);
  EXPECT_EQ(lines_of(folder / "far.pcd")[1], "# add (" + std::to_string(std::llround(origin->x())) +
                                                 ", " + std::to_string(std::llround(origin->y())) +
                                                 ", " + std::to_string(std::llround(origin->z())) +
                                                 ") m to every point");
}

#if SWIFTLET_HAS_OCTOMAP

/// Every voxel of a tree, whatever was pruned.
template <class Tree>
Voxels voxels_of(const Tree& tree) {
  Voxels voxels;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const int edge = 1 << (16 - leaf.getDepth());
    const octomap::OcTreeKey first = leaf.getIndexKey();  // lowest key of the leaf's cube
    for_each_block({{first[0] - 32768, first[1] - 32768, first[2] - 32768}, {edge, edge, edge}},
                   [&](const BlockIndex& i) {
                     voxels[{i.x, i.y, i.z}] =
                         tree.isNodeOccupied(*leaf) ? Occupancy::kOccupied : Occupancy::kFree;
                   });
  }
  return voxels;
}

TEST(Exporters, liboctomap_reads_exactly_our_free_and_occupied_voxels_from_bt) {
  const ExportedMap map;
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary(map.write("bt").string()));
  EXPECT_EQ(tree.getResolution(), 0.05);
  EXPECT_EQ(voxels_of(tree), map.voxels);
}

TEST(Exporters, liboctomap_reads_exactly_our_free_and_occupied_voxels_from_ot) {
  const ExportedMap map;
  const std::unique_ptr<octomap::AbstractOcTree> any(
      octomap::AbstractOcTree::read(map.write("ot").string()));
  const auto* tree = dynamic_cast<octomap::OcTree*>(any.get());
  ASSERT_NE(tree, nullptr);
  EXPECT_EQ(voxels_of(*tree), map.voxels);
  // And the very log-odds: one step of the byte is 0.04.
  const auto [v, state] = *map.voxels.begin();
  const auto block = load_map(map.folder / "a.swl")->find(block_of(v));
  const auto* node =
      tree->search(centre_of(v, 0.05).x(), centre_of(v, 0.05).y(), centre_of(v, 0.05).z());
  ASSERT_NE(node, nullptr);
  const int steps = block->value().voxels[offset_in_block(v)] - kUnknownVoxel;
  EXPECT_NEAR(node->getLogOdds(), 0.04 * steps, 1e-5);
}

TEST(Exporters, refuse_voxels_beyond_octomaps_key_space) {
  TempFolder folder;
  {
    auto store = BlockStore::create(folder / "a.swl", 0.05);
    (*store)->evict({4095, 0, 0}, test::block_full_of(255), 1);  // voxels up to 32767: the last
  }
  EXPECT_TRUE(export_map("bt", *load_map(folder / "a.swl"), folder / "a.bt"));
  {
    auto store = BlockStore::create(folder / "b.swl", 0.05);
    (*store)->evict({4096, 0, 0}, test::block_full_of(255), 1);
  }
  const auto beyond = export_map("bt", *load_map(folder / "b.swl"), folder / "b.bt");
  ASSERT_FALSE(beyond.has_value());
  EXPECT_EQ(beyond.error().code, ErrorCode::kUnsupported);
  EXPECT_FALSE(std::filesystem::exists(folder / "b.bt"));
}

TEST(OctomapImport, reads_our_exports_as_liboctomap_does) {
  const ExportedMap map;
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary(map.write("bt").string()));
  test::expect_same_leaves(map.folder / "a.bt", tree);
  const auto summary = read_octomap(map.write("ot"));
  ASSERT_TRUE(summary.has_value());
  EXPECT_EQ(summary->occupied_voxels, map.occupied);
  EXPECT_EQ(summary->occupied_voxels + summary->free_voxels, map.voxels.size());
}

TEST(OctomapImport, every_truncated_file_is_an_error) {
  const ExportedMap map;
  for (const char* format : {"bt", "ot"}) {
    const auto whole = test::bytes_of(map.write(format));
    for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 400) {
      test::write_bytes(map.folder / "cut",
                        {whole.begin(), whole.begin() + std::ptrdiff_t(length)});
      EXPECT_FALSE(read_octomap(map.folder / "cut").has_value()) << format << " " << length;
    }
  }
}

#endif

}  // namespace
}  // namespace swiftlet
