// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5 files made to mislead: values elsewhere, links that multiply, storage that inflates, damage
// that HDF5 itself does not survive. All are one line of Error (input).
#include <gtest/gtest.h>
#include <hdf5.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>
#include <zlib.h>

#include <functional>
#include <random>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "fixtures/complaint.hpp"
#include "fixtures/samples.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/derivative_file.hpp"
#include "io/geometry_file.hpp"
#include "io/label_file.hpp"
#include "io/mesh_file.hpp"
#include "mesh/locate.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;

using fixtures::complaint;

class HostileMesh : public testing::Test {
 protected:
  void SetUp() override { write_mesh(file_, samples::full_mesh()); }
  /// Edits through HDF5, which drops the seal, then reads.
  std::string after(const std::function<void(hid_t)>& edit) {
    const hid_t h5 = H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    edit(h5);
    H5Fclose(h5);
    return complaint([&] { read_mesh(file_); });
  }
  static void add(hid_t h5, const char* path, hid_t layout, hsize_t count, bool write = true) {
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t set =
        H5Dcreate2(h5, path, H5T_NATIVE_UINT8, space, H5P_DEFAULT, layout, H5P_DEFAULT);
    const std::vector<unsigned char> zeros(write ? std::size_t(count) : 0);
    if (write) H5Dwrite(set, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, zeros.data());
    H5Dclose(set);
    H5Sclose(space);
  }
  static hid_t chunked(hsize_t chunk) {
    const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(layout, 1, &chunk);
    H5Pset_deflate(layout, 1);
    return layout;
  }
  ScratchFolder folder_;
  const fs::path file_ = folder_ / "mesh.vtkhdf";
};

TEST_F(HostileMesh, ValuesOfAnotherFileAreNotRead) {
  write_text(folder_ / "secret", std::string(100, 'x'));
  const std::string text = after([&](hid_t h5) {
    const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(layout, (folder_ / "secret").c_str(), 0, 100);
    add(h5, "/breast/notes", layout, 100, false);
    H5Pclose(layout);
  });
  EXPECT_NE(text.find("another file"), std::string::npos) << text;
}

// HDF5 1.10 copies as many bytes as the shape asks for, whatever the header of the dataset says it holds.
TEST_F(HostileMesh, AShortCompactDatasetIsNotReadBeyondItsEnd) {
  constexpr hsize_t count = 1000;
  after([&](hid_t h5) {
    const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_layout(layout, H5D_COMPACT);
    add(h5, "/breast/notes", layout, count);
    H5Pclose(layout);
  });
  std::string bytes = read_text(file_);
  const std::string header{char(3), char(0), char(count % 256),
                           char(count / 256)};  // version, compact, size
  const std::size_t at = bytes.find(header);
  ASSERT_NE(at, std::string::npos);
  bytes[at + 2] = bytes[at + 3] = 1;
  write_text(file_, bytes);
  const std::string text = complaint([&] { read_mesh(file_); });
  EXPECT_NE(text.find("states 1000 values in 257 bytes"), std::string::npos) << text;
}

// HDF5 1.10 copies from beyond an attribute's message, and from beyond its memory, when a length in it is damaged. The
// message: version, 0, lengths of name, datatype and dataspace (2 bytes each), and these, in multiples of 8 bytes.
TEST_F(HostileMesh, AttributesThatLeaveTheirMessageAreRefused) {
  const std::string fine = after([](hid_t h5) {
    const hsize_t count = 3;
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t notes = H5Acreate_by_name(h5, "/breast", "notes", H5T_NATIVE_DOUBLE, space,
                                          H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const double values[] = {1, 2, 3};
    H5Awrite(notes, H5T_NATIVE_DOUBLE, values);
    H5Aclose(notes);
    H5Sclose(space);
  });
  EXPECT_EQ(fine, "accepted");
  const std::string whole = read_text(file_);
  const std::size_t name = whole.find(std::string("notes\0\0\0", 8));
  ASSERT_NE(name, std::string::npos);
  const auto damaged = [&](std::size_t at, const std::string& bytes) {
    write_text(file_, std::string(whole).replace(at, bytes.size(), bytes));
    return complaint([&] { read_mesh(file_); });
  };
  const std::size_t type = name + 8, space = type + 24;  // a double takes 20 bytes
  const std::string longest = "\xff\xff", longer = "is longer than its message",
                    values_longer = "values of attribute notes are longer";
  for (const std::size_t length : {name - 6, name - 4, name - 2})
    EXPECT_NE(damaged(length, longest).find(longer), std::string::npos) << length - name;
  EXPECT_NE(damaged(name + 5, "x").find("has no end"), std::string::npos);
  EXPECT_NE(damaged(type + 4, longest).find(values_longer), std::string::npos);
  EXPECT_NE(damaged(space + 8, "\x04").find(values_longer), std::string::npos);
  EXPECT_NE(damaged(space + 1, "\x08").find(values_longer), std::string::npos);
}

// As h5py writes a text.
TEST_F(HostileMesh, AnAttributeOfVariableLengthIsRead) {
  const std::string text = after([](hid_t h5) {
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, H5T_VARIABLE);
    const hid_t notes = H5Acreate_by_name(h5, "/breast", "notes", type, space, H5P_DEFAULT,
                                          H5P_DEFAULT, H5P_DEFAULT);
    const char* words = "edited by hand";
    H5Awrite(notes, type, &words);
    H5Aclose(notes);
    H5Sclose(space);
    H5Tclose(type);
  });
  EXPECT_EQ(text, "accepted");
}

TEST_F(HostileMesh, VirtualDatasetsAreNotRead) {
  const std::string text = after([&](hid_t h5) {
    const hsize_t count = 10;
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_virtual(layout, space, (folder_ / "other.h5").c_str(), "/x", space);
    add(h5, "/breast/notes", layout, count, false);
    H5Pclose(layout);
    H5Sclose(space);
  });
  EXPECT_NE(text.find("another file"), std::string::npos) << text;
}

TEST_F(HostileMesh, LinksAreRefused) {
  const std::string hard = after([](hid_t h5) {
    H5Lcreate_hard(h5, "/VTKHDF/Points", h5, "/breast/again", H5P_DEFAULT, H5P_DEFAULT);
  });
  EXPECT_NE(hard.find("second link"), std::string::npos) << hard;
  write_mesh(file_, samples::full_mesh());
  const std::string loop = after([](hid_t h5) {
    H5Lcreate_hard(h5, "/breast", h5, "/breast/sets/up", H5P_DEFAULT, H5P_DEFAULT);
  });
  EXPECT_NE(loop, "accepted");
  write_mesh(file_, samples::full_mesh());
  const std::string outside = after([&](hid_t h5) {
    H5Lmove(h5, "/breast", h5, "/moved", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft("/moved", h5, "/breast", H5P_DEFAULT, H5P_DEFAULT);
  });
  EXPECT_NE(outside.find("link"), std::string::npos) << outside;
}

TEST_F(HostileMesh, InflationHasABudget) {
  const std::string text = after([](hid_t h5) {
    const hid_t layout = chunked(hsize_t(1) << 24);
    for (const char* path : {"/breast/zeros1", "/breast/zeros2"}) {  // in a file of 6 MB
      add(h5, path, layout, hsize_t(600) << 20);
    }
    H5Pclose(layout);
  });
  EXPECT_NE(text.find("bytes of memory"), std::string::npos) << text;
}

TEST_F(HostileMesh, AnUnwrittenGiantIsRefused) {
  const std::string text = after([](hid_t h5) {
    const hid_t layout = chunked(1000);
    add(h5, "/breast/giant", layout, 5'000'000, false);
    H5Pclose(layout);
  });
  EXPECT_NE(text, "accepted");
}

TEST_F(HostileMesh, GiantChunksAreRefused) {
  const std::string text = after([](hid_t h5) {
    const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t chunk = hsize_t(1) << 31, count = 100, most = H5S_UNLIMITED;
    H5Pset_chunk(layout, 1, &chunk);
    H5Pset_deflate(layout, 1);
    const hid_t space = H5Screate_simple(1, &count, &most);
    const hid_t set =
        H5Dcreate2(h5, "/breast/chunk", H5T_NATIVE_UINT8, space, H5P_DEFAULT, layout, H5P_DEFAULT);
    EXPECT_GE(set, 0);
    H5Dclose(set);
    H5Sclose(space);
    H5Pclose(layout);
  });
  EXPECT_NE(text.find("chunks"), std::string::npos) << text;
}

// The list of a group's members, whose tree names itself as its neighbour: HDF5 follows it for ever, or
// until memory ends.
TEST_F(HostileMesh, AGroupThatNeverEndsTakesLittleMemoryAndTime) {
  std::string bytes = read_text(file_);
  bytes.resize(bytes.rfind("libbreast sha256"));
  constexpr std::size_t level = 5, neighbour = 16, address_bytes = 8;
  int changed = 0;
  for (std::size_t at = bytes.find("TREE"); at != std::string::npos;
       at = bytes.find("TREE", at + 1)) {
    if (bytes[at + level - 1] != 0 || bytes[at + level] != 0) continue;  // a group's, and a leaf
    for (std::size_t k = 0; k < address_bytes; ++k) bytes[at + neighbour + k] = char(at >> (8 * k));
    ++changed;
  }
  ASSERT_GT(changed, 0);
  write_bytes(file_, bytes);
  rusage before{}, used{};
  getrusage(RUSAGE_CHILDREN, &before);
  EXPECT_NE(complaint([&] { read_mesh(file_); }), "accepted");
  getrusage(RUSAGE_CHILDREN, &used);
  EXPECT_LT(used.ru_maxrss, 1024 * 1024) << "kB";
  EXPECT_LT(used.ru_utime.tv_sec + used.ru_stime.tv_sec - before.ru_utime.tv_sec, 10);
}

// Without its seal, damage reaches HDF5: whatever that does, one line comes out of it.
TEST_F(HostileMesh, DamageBehindTheSealIsSurvived) {
  const std::string good = read_text(file_);
  const std::string body = good.substr(0, good.size() - 80);
  std::mt19937 random(20080302);
  int refused = 0;
  for (int n = 0; n < 150; ++n) {
    std::string bad = body;
    for (int flips = 1 + n % 3; flips > 0; --flips) {
      bad[random() % std::min<std::size_t>(bad.size(), n % 2 ? 6000 : bad.size())] ^=
          char(1 << random() % 8);
    }
    write_text(file_, bad);
    refused += complaint([&] { read_mesh(file_); }) != "accepted";
  }
  EXPECT_GT(refused, 50);
}

// HDF5 1.10 would copy what lies behind its buffer.
TEST_F(HostileMesh, ChunksThatHoldLessThanTheirShapeAsksForAreRefused) {
  const HexMesh mesh = samples::full_mesh(10);
  write_mesh(file_, mesh);
  const std::string text = after([&](hid_t h5) {
    const char* points = "/VTKHDF/Points";
    H5Ldelete(h5, points, H5P_DEFAULT);
    const hsize_t shape[2] = {mesh.points.size(), 3};
    const hid_t space = H5Screate_simple(2, shape, nullptr), layout = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(layout, 2, shape);
    H5Pset_deflate(layout, 2);
    const hid_t set =
        H5Dcreate2(h5, points, H5T_IEEE_F64LE, space, H5P_DEFAULT, layout, H5P_DEFAULT);
    const std::vector<double> half(3 * mesh.points.size() / 2, 1.0);
    std::vector<unsigned char> packed(compressBound(8 * half.size()));
    uLongf bytes = packed.size();
    compress(packed.data(), &bytes, reinterpret_cast<const unsigned char*>(half.data()),
             8 * half.size());
    const hsize_t origin[2] = {0, 0};
    EXPECT_GE(H5Dwrite_chunk(set, H5P_DEFAULT, 0, origin, bytes, packed.data()), 0);
    H5Dclose(set);
    H5Pclose(layout);
    H5Sclose(space);
  });
  EXPECT_NE(text.find("/VTKHDF/Points is damaged: chunk 0 holds fewer than"), std::string::npos)
      << text;
}

// The type is changed from 8-byte to 12-byte numbers, while the chunks remain as they were.
TEST_F(HostileMesh, TypesWiderThanTheirChunksAreRefused) {
  write_mesh(file_, samples::full_mesh(10));
  after([](hid_t) {});  // which drops the seal
  const std::string whole = read_text(file_),
                    type("\x11\x20\x3f\x00\x08\x00\x00\x00\x00\x00\x40", 11);
  int chunked = 0;
  for (std::size_t at = whole.find(type); at != std::string::npos; at = whole.find(type, at + 1)) {
    std::string bad = whole;
    bad[at + 4] = 12;
    bad[at + 9] = 8;  // the first bit of the number: 8 bytes of 12
    write_text(file_, bad);
    const std::string text = complaint([&] { read_mesh(file_); });
    EXPECT_EQ(text.find("crashed"), std::string::npos) << text;
    chunked += text.find("bytes of its shape and type") != std::string::npos;
  }
  EXPECT_GT(chunked, 0);
}

TEST_F(HostileMesh, PlacesOfNoBodyAreRefused) {
  for (const char* path :
       {"/VTKHDF/Points", "/VTKHDF/PointData/imaged", "/VTKHDF/PointData/reference",
        "/breast/landmarks/imaged", "/breast/hermite/skin/x"}) {
    write_mesh(file_, samples::full_mesh());
    const std::string text = after([&](hid_t h5) {
      const hid_t set = H5Dopen2(h5, path, H5P_DEFAULT), space = H5Dget_space(set);
      std::vector<double> values(std::size_t(H5Sget_simple_extent_npoints(space)));
      H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      values[1] = -1e154;
      H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      H5Sclose(space);
      H5Dclose(set);
    });
    EXPECT_NE(text.find("-1e+154"), std::string::npos) << path << ": " << text;
  }
}

TEST_F(HostileMesh, DerivativesOfAnotherTypeAreRefusedByName) {
  Derivatives derivatives;
  const HexMesh mesh = samples::full_mesh();
  derivatives.position["fat"].assign(mesh.points.size(), Vec3(1, 2, 3));
  write_mesh(file_, mesh, derivatives);
  const hid_t h5 = H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Ldelete(h5, "/VTKHDF/PointData/derivative_fat", H5P_DEFAULT);
  const hsize_t shape[2] = {mesh.points.size(), 3};
  const hid_t space = H5Screate_simple(2, shape, nullptr);
  const hid_t set = H5Dcreate2(h5, "/VTKHDF/PointData/derivative_fat", H5T_NATIVE_INT, space,
                               H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const std::vector<int> values(3 * mesh.points.size(), 7);
  H5Dwrite(set, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space);
  H5Dclose(set);
  H5Fclose(h5);
  const std::string text = complaint([&] { read_derivatives(file_, mesh); });
  EXPECT_NE(text.find("derivative_fat"), std::string::npos) << text;
  EXPECT_NE(text.find("mesh.vtkhdf"), std::string::npos) << text;
}

TEST(HostileLabels, NamesThatTablesCannotHoldAreRefused) {
  const ScratchFolder folder;
  for (const std::string name : {"", "a/b", "a\tb", "\x1b[31m"}) {
    LabelVolume labels = samples::labels();
    labels.landmarks[name] = Vec3(1, 2, 3);
    write_labels(folder / "labels.vtkhdf", labels);
    EXPECT_NE(complaint([&] { read_labels(folder / "labels.vtkhdf"); }).find("landmarks/name"),
              std::string::npos);
  }
}

TEST(Locating, CoordinatesThatOverflowAreAnErrorNotAnIndex) {
  HexMesh mesh = samples::full_mesh();
  for (Vec3& point : mesh.points) point *= 1e200;
  const Locator locator(mesh, mesh.points);
  EXPECT_THROW(locator.nearest(Vec3(-1e203, 0, 0)), Error);
  EXPECT_THROW(nearest_on_faces(mesh, mesh.points, mesh.skin_faces, Vec3(-1e203, 0, 0)), Error);
}

}  // namespace
}  // namespace breast
