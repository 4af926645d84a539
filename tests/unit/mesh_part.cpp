// SPDX-License-Identifier: GPL-3.0-or-later
// A part of a mesh: its arrays follow, and its numbers say where it is in the whole, also through files.
#include "mesh/part.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "fixtures/complaint.hpp"
#include "fixtures/samples.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/mesh_file.hpp"
#include "mesh/nodal.hpp"

namespace breast {
namespace {

using fixtures::complaint;

/// All elements but the first and every fourth after it, among them that of the nipple.
std::vector<int> some_elements(const HexMesh& mesh) {
  std::vector<int> list;
  for (int e = 0; e < mesh.elements(); ++e)
    if (e % 4 != 0) list.push_back(e);
  return list;
}

HexMesh whole_mesh(int order) {
  HexMesh mesh = samples::full_mesh(3, order);
  mesh.contact->friction = {{0, 0, mesh.points[0], 1, 2},
                            {mesh.element(1)[3], 1, mesh.points[1], 3, 4}};
  mesh.contact->face_rules = {1, 2};
  return mesh;
}

class PartOf : public testing::TestWithParam<int> {};

TEST_P(PartOf, EveryArrayFollowsItsElementsAndNodes) {
  const HexMesh whole = whole_mesh(GetParam());
  const std::vector<int> elements = some_elements(whole);
  const HexMesh part = restricted(whole, elements);
  EXPECT_EQ(part.element_numbers, elements);
  ASSERT_EQ(part.nodes(), int(part.node_numbers.size()));
  for (int n = 0; n < part.nodes(); ++n) {
    const auto there = std::size_t(part.node_numbers[std::size_t(n)]), here = std::size_t(n);
    EXPECT_EQ(part.points[here], whole.points[there]);
    EXPECT_EQ(part.imaged[here], whole.imaged[there]);
    EXPECT_EQ(part.reference[here], whole.reference[there]);
    EXPECT_EQ(part.contact_pressure[here], whole.contact_pressure[there]);
  }
  for (int e = 0; e < part.elements(); ++e) {
    const auto there = std::size_t(elements[std::size_t(e)]), here = std::size_t(e);
    EXPECT_EQ(part.tissue[here], whole.tissue[there]);
    EXPECT_EQ(part.fibroglandular_fraction[here], whole.fibroglandular_fraction[there]);
    EXPECT_EQ(part.pressure[here], whole.pressure[there]);
    EXPECT_EQ(part.det_F[here], whole.det_F[there]);
    EXPECT_EQ(part.scaled_jacobian[here], whole.scaled_jacobian[there]);
    for (int a = 0; a < part.nodes_per_element(); ++a)
      EXPECT_EQ(part.node_numbers[std::size_t(part.element(e)[a])], whole.element(int(there))[a]);
  }
  EXPECT_EQ(part.skin_thickness.size(), part.skin_faces.size());
  EXPECT_LT(part.skin_faces.size(), whole.skin_faces.size());
  EXPECT_GT(part.cut_faces.size(), whole.cut_faces.size());
}

TEST_P(PartOf, WhatLiesElsewhereIsLeftOut) {
  const HexMesh whole = whole_mesh(GetParam());
  const HexMesh part = restricted(whole, some_elements(whole));
  EXPECT_EQ(part.landmark("nipple"), nullptr);
  ASSERT_NE(part.landmark("tumour"), nullptr);
  EXPECT_EQ(landmark_position(part, part.points, *part.landmark("tumour")),
            landmark_position(whole, whole.points, *whole.landmark("tumour")));
  ASSERT_EQ(part.contact->friction.size(), 1U);  // node 0 is of element 0 alone
  EXPECT_EQ(part.node_numbers[std::size_t(part.contact->friction[0].node)], whole.element(1)[3]);
  EXPECT_TRUE(part.contact->face_rules.empty());
}

TEST_P(PartOf, APartOfAPartHasTheNumbersOfTheWhole) {
  const HexMesh whole = whole_mesh(GetParam());
  const HexMesh part = restricted(whole, some_elements(whole));
  const HexMesh less = restricted(part, {1, 4, 5, 8}), same = restricted(whole, {2, 6, 7, 11});
  EXPECT_EQ(less.element_numbers, same.element_numbers);
  EXPECT_EQ(less.node_numbers, same.node_numbers);
  EXPECT_TRUE(have_same_elements(less, same));
  EXPECT_FALSE(have_same_elements(less, part));
  const auto in_whole = indices_in(whole, less), in_part = indices_in(part, less);
  ASSERT_TRUE(in_whole && in_part);
  EXPECT_EQ(in_whole->elements, same.element_numbers);
  EXPECT_EQ(in_part->elements, (std::vector<int>{1, 4, 5, 8}));
  EXPECT_FALSE(indices_in(less, whole));
}

TEST_P(PartOf, VectorsFollowTheNodesAndBack) {
  const HexMesh whole = whole_mesh(GetParam());
  const HexMesh part = restricted(whole, some_elements(whole));
  const PartIndices at = *indices_in(whole, part);
  const Eigen::VectorXd all = flatten(whole.points), own = at.restricted(all);
  EXPECT_EQ(own, flatten(part.points));
  EXPECT_EQ(at.restricted(at.extended(own, whole.nodes())), own);
  EXPECT_DOUBLE_EQ(at.extended(own, whole.nodes()).dot(all), own.dot(own));
}

std::vector<int> second_and_fifth(const HexTopology&) {
  return {1, 4};
}

TEST_P(PartOf, AFunctionOfTheTopologyChooses) {
  const HexMesh whole = whole_mesh(GetParam());
  EXPECT_TRUE(have_same_elements(restricted(whole, second_and_fifth), restricted(whole, {1, 4})));
}

TEST_P(PartOf, APartElsewhereOrAnotherMeshIsNone) {
  const HexMesh whole = whole_mesh(GetParam());
  HexMesh first = restricted(whole, {0}), last = restricted(whole, {26});
  EXPECT_EQ(first.connectivity, last.connectivity);  // which alone would not tell them apart
  EXPECT_FALSE(have_same_elements(first, last));
  std::swap(first.connectivity[0], first.connectivity[1]);
  EXPECT_FALSE(indices_in(whole, first));
}

TEST_P(PartOf, NumbersAreKeptInFiles) {
  const ScratchFolder folder;
  const HexMesh whole = whole_mesh(GetParam());
  const HexMesh part = restricted(whole, some_elements(whole));
  write_mesh(folder / "part.vtkhdf", part);
  write_mesh(folder / "whole.vtkhdf", whole);
  EXPECT_TRUE(have_same_elements(read_mesh(folder / "part.vtkhdf"), part));
  EXPECT_TRUE(read_mesh(folder / "whole.vtkhdf").element_numbers.empty());
  EXPECT_TRUE(indices_in(read_mesh(folder / "whole.vtkhdf"), part));
}

INSTANTIATE_TEST_SUITE_P(Orders, PartOf, testing::Values(1, 2));

TEST(PartFile, NumbersThatCannotBeAreRefused) {
  const ScratchFolder folder;
  const auto file = folder / "part.vtkhdf";
  const HexMesh whole = whole_mesh(1);
  const auto refused = [&](const char* path, bool remove) {
    write_mesh(file, restricted(whole, some_elements(whole)));
    const hid_t h5 = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    if (remove) {
      H5Ldelete(h5, path, H5P_DEFAULT);
    } else {
      const hid_t set = H5Dopen2(h5, path, H5P_DEFAULT);
      const hid_t space = H5Dget_space(set);
      std::vector<long> values(std::size_t(H5Sget_simple_extent_npoints(space)));
      H5Dread(set, H5T_NATIVE_LONG, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      values[3] = values[2];
      H5Dwrite(set, H5T_NATIVE_LONG, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      H5Sclose(space);
      H5Dclose(set);
    }
    H5Fclose(h5);
    const std::string text = complaint([&] { read_mesh(file); });
    EXPECT_NE(text.find(path), std::string::npos) << text;
  };
  for (const char* path : {"/VTKHDF/CellData/element_number", "/VTKHDF/PointData/node_number"}) {
    refused(path, true);
    refused(path, false);
  }
}

}  // namespace
}  // namespace breast
