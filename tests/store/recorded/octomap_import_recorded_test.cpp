// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>

#if SWIFTLET_HAS_OCTOMAP

#include <octomap/ColorOcTree.h>

#include <memory>

#include "store/octomap_leaves.hpp"
#include "support/recorded.hpp"

namespace swiftlet {
namespace {

TEST(OctomapImport, reads_recorded_bt_files_as_liboctomap_does) {
  const auto folder = test::recorded_folder("octomap");
  SWIFTLET_NEEDS_RECORDING(folder);
  for (const char* name : {"geb079.bt", "octomap_python_test.bt", "octomap_tutor_sample.bt"}) {
    octomap::OcTree tree(1.0);
    ASSERT_TRUE(tree.readBinary((folder / name).string()));
    test::expect_same_leaves(folder / name, tree);
  }
}

TEST(OctomapImport, reads_a_recorded_colour_tree_and_names_its_kind) {
  const auto folder = test::recorded_folder("octomap");
  SWIFTLET_NEEDS_RECORDING(folder);
  const auto path = folder / "octomap_tutor_sample.ot";
  const std::unique_ptr<octomap::AbstractOcTree> any(octomap::AbstractOcTree::read(path.string()));
  const auto* tree = dynamic_cast<octomap::ColorOcTree*>(any.get());
  ASSERT_NE(tree, nullptr);
  test::expect_same_leaves(path, *tree);
  EXPECT_EQ(read_octomap(path)->kind, "ColorOcTree");
}

}  // namespace
}  // namespace swiftlet

#endif
