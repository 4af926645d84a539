// SPDX-License-Identifier: GPL-3.0-or-later
// A disk that is full at any byte of any output: an error in one line, no file, no part.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <set>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/own_file.hpp"
#include "core/table.hpp"
#include "fixtures/samples.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/geometry_file.hpp"
#include "io/label_file.hpp"
#include "io/lookup_file.hpp"
#include "io/mammogram_dicom.hpp"
#include "io/mammogram_file.hpp"
#include "io/mesh_file.hpp"
#include "io/picture_file.hpp"
#include "io/segmentation_file.hpp"
#include "io/surface_file.hpp"
#include "io/tet_mesh_file.hpp"
#include "io/volume_file.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;

struct Writer {
  const char* name;  ///< of the file or folder it writes
  std::function<void(const fs::path&)> write;
};

Mammogram mammogram() {
  Mammogram image;
  image.pose = view_pose(Side::left, 0);
  image.view = View::cc;
  image.energy = "W/Rh:28";
  image.width = 40;
  image.height = 30;
  image.pixel = 0.5;
  for (int n = 0; n < 1200; ++n) image.path.push_back(float(n * 31 % 50));
  image.thickness.assign(1200, 50);
  image.fibroglandular = image.path;
  image.through_back.assign(1200, 0);
  return image;
}

template <class T>
Volume<T> volume() {
  Grid grid;
  grid.size = {12, 11, 5};
  Volume<T> out(grid);
  for (std::size_t v = 0; v < out.voxels.size(); ++v) out.voxels[v] = T(v * 7919 % 251);
  return out;
}

PolyLines curve() {
  PolyLines lines;
  lines.points = {{0, 0, 0}, {1, 0, 0.5}, {2, 0, 0.7}};
  lines.lines = {{0, 1, 2}};
  return lines;
}

TriMesh surface() {
  TriMesh out;
  out.points = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}};
  out.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}};
  return out;
}

MatchLookup lookup() {
  MatchLookup out;
  out.from_view = View::cc;
  out.to_view = View::mlo;
  out.pitch = 5;
  out.nu = out.nv = 4;
  out.samples = 3;
  out.status.assign(16, 1);
  out.depth.assign(16, 30);
  out.curve.assign(96, 1);
  out.deviation.assign(48, 1);
  out.length.assign(16, 40);
  out.imaged.assign(144, 2);
  return out;
}

TetMesh tetrahedron() {
  TetMesh out;
  out.points = surface().points;
  out.tetrahedra = {{0, 1, 2, 3}};
  out.tissue = {Tissue::fat};
  return out;
}

const Writer writers[] = {
    {"mesh.vtkhdf", [](const fs::path& f) { write_mesh(f, samples::full_mesh()); }},
    {"geometry.vtkhdf", [](const fs::path& f) { write_geometry(f, samples::geometry()); }},
    {"labels.vtkhdf", [](const fs::path& f) { write_labels(f, samples::labels()); }},
    {"lookup.h5", [](const fs::path& f) { write_lookup(f, lookup()); }},
    {"surface.vtp", [](const fs::path& f) { write_surface(f, surface()); }},
    {"curve.vtp", [](const fs::path& f) { write_polylines(f, curve()); }},
    {"tetrahedra.vtu", [](const fs::path& f) { write_tet_mesh(f, tetrahedron()); }},
    {"image.vti", [](const fs::path& f) { write_mammogram(f, mammogram()); }},
    {"image.png", [](const fs::path& f) { write_mammogram_png(f, mammogram()); }},
    {"picture.png",
     [](const fs::path& f) {
       write_picture_png(f, {20, 10, std::vector<float>(200, 0.5F)});
     }},
    {"image.dcm", [](const fs::path& f) { write_mammogram_dicom(f, mammogram(), {}); }},
    {"labels.dcm", [](const fs::path& f) { write_segmentation(f, samples::labels()); }},
    {"scan.nrrd", [](const fs::path& f) { write_volume(f, volume<float>()); }},
    {"scan.nii", [](const fs::path& f) { write_volume(f, volume<std::int16_t>()); }},
    {"scan.nii.gz", [](const fs::path& f) { write_volume(f, volume<std::int16_t>()); }},
    {"scan.mha", [](const fs::path& f) { write_volume(f, volume<std::uint8_t>()); }},
    {"dicom", [](const fs::path& f) { write_dicom_series(f, volume<std::int16_t>(), "T1"); }},
    {"table.tsv",
     [](const fs::path& f) {
       write_table(f, {{"a", "b"}, {{"1", "2"}}});
     }},
};

class FullDisk : public testing::TestWithParam<Writer> {};

std::uintmax_t largest_file(const fs::path& written) {
  if (!fs::is_directory(written)) return fs::file_size(written);
  std::uintmax_t most = 0;
  for (const auto& entry : fs::directory_iterator(written))
    most = std::max(most, entry.file_size());
  return most;
}

enum Code { success = 0, one_line_failure = 1, anything_else = 2 };

Code write_within(rlim_t bytes, const Writer& writer, const fs::path& target) {
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
    Code code = success;
    try {
      writer.write(target);
    } catch (const Error& error) {
      const std::string text = error.what();
      const bool good = error.kind() == ErrorKind::failed && text.find('\n') == std::string::npos &&
                        text.find(target.filename().string()) != std::string::npos;
      code = good ? one_line_failure : anything_else;
    } catch (...) {
      code = anything_else;
    }
    _exit(code);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? Code(WEXITSTATUS(status)) : anything_else;
}

TEST_P(FullDisk, AtAnyByteLeavesNothing) {
  const ScratchFolder folder;
  const fs::path target = folder / GetParam().name;
  GetParam().write(target);
  const std::uintmax_t size = largest_file(target);
  fs::remove_all(target);
  constexpr unsigned counts = 64;
  for (unsigned n = 0; n < counts; ++n) {
    const std::uintmax_t bytes = size * n / counts;
    EXPECT_EQ(write_within(bytes, GetParam(), target), one_line_failure) << bytes << " of " << size;
    EXPECT_TRUE(fs::is_empty(folder.path())) << bytes << " of " << size;
  }
  EXPECT_EQ(write_within(size - 1, GetParam(), target), one_line_failure);
  EXPECT_TRUE(fs::is_empty(folder.path()));
  EXPECT_EQ(write_within(size, GetParam(), target), success);
}

TEST_P(FullDisk, WhatWasWrittenIsKnownAsOurs) {
  const ScratchFolder folder;
  const fs::path target = folder / GetParam().name;
  GetParam().write(target);
  EXPECT_TRUE(fs::is_directory(target) || written_by_us(target));
  GetParam().write(target);  // and may be written again
}

INSTANTIATE_TEST_SUITE_P(Writers, FullDisk, testing::ValuesIn(writers), [](const auto& writer) {
  std::string name = writer.param.name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

}  // namespace
}  // namespace breast
