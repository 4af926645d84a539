// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/lineage.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace breast {
namespace {

History made_by(const std::string& tool, const std::string& from) {
  return {{tool, "0", tool, {{from + ".file", from}}}};
}

TEST(Lineage, OnlyWhatAToolWasGivenIsTaken) {
  const History labels = made_by("segment", "scan");
  check_given_to("segment", labels, "scan.nrrd", "scan");
  check_given_to("hexmesh", labels, "other.nrrd", "other");  // nothing is known of hexmesh
  try {
    check_given_to("segment", labels, "other.nrrd", "other");
    FAIL() << "another scan is taken";
  } catch (const Error& error) {
    EXPECT_NE(
        std::string(error.what()).find("other.nrrd: is not what segment was given (scan.file)"),
        std::string::npos)
        << error.what();
  }
}

TEST(Lineage, FilesOfOneScanHaveAnInputInCommon) {
  const History cc = made_by("compress", "reference"), image = made_by("project-mammogram", "cc"),
                other = made_by("compress", "elsewhere"), none;
  const Origin mesh{"cc.vtkhdf", "cc", &cc, Side::left};
  check_same_origin(mesh, {"cc.vti", "image", &image});  // the one is an input of the other
  check_same_origin(mesh, {"mlo.vtkhdf", "mlo", &cc});
  check_same_origin(mesh, {"foreign.vti", "foreign", &none});
  EXPECT_THROW(check_same_origin(mesh, {"mlo.vtkhdf", "mlo", &other}), Error);
  EXPECT_THROW(check_same_origin(mesh, {"right.vti", "image", &image, Side::right}), Error)
      << "the other breast of the same scan";
}

}  // namespace
}  // namespace breast
