// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/volume_file.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "core/error.hpp"
#include "fixtures/scratch_folder.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;

class VolumeFile : public ::testing::Test {
 protected:
  const ScratchFolder scratch;
  const fs::path& folder = scratch.path();
};

/// Oblique grid with three different spacings and sizes: any mix-up of axes shows.
template <class T>
Volume<T> oblique_volume() {
  Grid grid;
  grid.size = {7, 5, 4};
  grid.spacing = Vec3(0.75, 1.25, 2.5);
  grid.origin = Vec3(-30.5, 12.25, 40.125);
  grid.direction = Eigen::AngleAxisd(0.3, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  Volume<T> volume(grid);
  for (std::size_t n = 0; n < volume.voxels.size(); ++n)
    volume.voxels[n] = static_cast<T>((n * 37) % 101);
  return volume;
}

void expect_same_grid(const Grid& a, const Grid& b, double tolerance) {
  EXPECT_EQ(a.size, b.size);
  EXPECT_LT((a.spacing - b.spacing).norm(), tolerance);
  EXPECT_LT((a.origin - b.origin).norm(), 20 * tolerance);
  EXPECT_LT((a.direction - b.direction).norm(), tolerance);
}

template <class T>
void expect_same_voxels(const Volume<float>& read, const Volume<T>& written) {
  ASSERT_EQ(read.voxels.size(), written.voxels.size());
  for (std::size_t n = 0; n < read.voxels.size(); ++n) {
    ASSERT_EQ(read.voxels[n], static_cast<float>(written.voxels[n])) << n;
  }
}

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 2);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "";
}

TEST_F(VolumeFile, ReadsBackWhatItWroteInEveryFormat) {
  const auto shorts = oblique_volume<std::int16_t>();
  const auto bytes = oblique_volume<std::uint8_t>();
  const auto floats = oblique_volume<float>();
  for (const char* ending : {".nrrd", ".nii", ".nii.gz", ".mha"}) {
    SCOPED_TRACE(ending);
    const fs::path file = folder / (std::string("volume") + ending);
    const double tolerance = 1e-5;  // NIfTI keeps its quaternion in single precision
    write_volume(file, shorts);
    expect_same_voxels(read_volume(file), shorts);
    write_volume(file, bytes);
    expect_same_voxels(read_volume(file), bytes);
    write_volume(file, floats);
    const Volume<float> read = read_volume(file);
    expect_same_voxels(read, floats);
    expect_same_grid(read.grid, floats.grid, tolerance);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 4)
      << "temporaries must be gone";
}

TEST_F(VolumeFile, ContentHashIsOfTheContentNotTheFormat) {
  const auto volume = oblique_volume<std::int16_t>();
  VolumeSource nrrd, mha, other;
  write_volume(folder / "a.nrrd", volume);
  write_volume(folder / "a.mha", volume);
  auto changed = volume;
  changed.voxels[17] += 1;
  write_volume(folder / "b.nrrd", changed);
  read_volume(folder / "a.nrrd", 0, &nrrd);
  read_volume(folder / "a.mha", 0, &mha);
  read_volume(folder / "b.nrrd", 0, &other);
  EXPECT_EQ(nrrd.content_sha256, mha.content_sha256);
  EXPECT_NE(nrrd.content_sha256, other.content_sha256);
}

TEST_F(VolumeFile, DicomSeriesReadsBackInAnyFileOrder) {
  const auto volume = oblique_volume<std::int16_t>();
  const fs::path dicom = folder / "dicom";
  write_dicom_series(dicom, volume, "simulated T1");
  write_dicom_series(dicom, volume, "simulated T1");  // replaces its own
  fs::rename(dicom / "slice_0001.dcm", dicom / "z.dcm");
  fs::rename(dicom / "slice_0003.dcm", dicom / "a.dcm");
  VolumeSource source, nrrd;
  const Volume<float> read = read_volume(dicom, 0, &source);
  expect_same_voxels(read, volume);
  expect_same_grid(read.grid, volume.grid, 1e-6);
  write_volume(folder / "same.nrrd", volume);
  read_volume(folder / "same.nrrd", 0, &nrrd);
  EXPECT_EQ(source.content_sha256, nrrd.content_sha256);
  EXPECT_NE(source.description.find("4 files of 7 x 5 pixels"), std::string::npos)
      << source.description;
  EXPECT_EQ(source.description.find("simulated T1"), std::string::npos) << "may hold a name";
}

TEST_F(VolumeFile, DicomMissingSliceIsNamed) {
  const fs::path dicom = folder / "dicom";
  write_dicom_series(dicom, oblique_volume<std::int16_t>(), "T1");
  fs::remove(dicom / "slice_0002.dcm");
  EXPECT_NE(error_of([&] { read_volume(dicom); }).find("missing"), std::string::npos);
}

TEST_F(VolumeFile, SeveralDicomSeriesAreListed) {
  const auto volume = oblique_volume<std::int16_t>();
  write_dicom_series(folder / "one", volume, "first");
  auto changed = volume;
  changed.voxels[3] += 5;
  write_dicom_series(folder / "two", changed, "second");
  for (const auto& entry : fs::directory_iterator(folder / "two")) {
    fs::copy(entry.path(), folder / "one" / ("two_" + entry.path().filename().string()));
  }
  const std::string text = error_of([&] { read_volume(folder / "one"); });
  EXPECT_NE(text.find("1 = 4 files of 7 x 5 pixels"), std::string::npos) << text;
  EXPECT_NE(text.find("2 = 4 files of 7 x 5 pixels"), std::string::npos) << text;
  EXPECT_EQ(text.find("second"), std::string::npos) << "a description may hold a name: " << text;
  VolumeSource a, b;
  read_volume(folder / "one", 1, &a);
  read_volume(folder / "one", 2, &b);
  EXPECT_NE(a.content_sha256, b.content_sha256);
  EXPECT_NE(error_of([&] { read_volume(folder / "one", 3); }), "");
}

TEST_F(VolumeFile, TruncationAnywhereIsOneLine) {
  const auto volume = oblique_volume<float>();
  for (const char* ending : {".nrrd", ".nii", ".nii.gz", ".mha"}) {
    const fs::path whole = folder / (std::string("whole") + ending);
    write_volume(whole, volume);
    const auto size = fs::file_size(whole);
    for (int part = 0; part < 20; ++part) {
      const fs::path cut = folder / (std::string("cut") + ending);
      fs::copy_file(whole, cut, fs::copy_options::overwrite_existing);
      fs::resize_file(cut, size * part / 20);
      EXPECT_NE(error_of([&] { read_volume(cut); }), "") << ending << " cut to " << part << "/20";
    }
  }
  // Inside the checksum and length that end a gzip stream, also where the voxels are a whole number
  // of the reader's buffers.
  Volume<float> round(volume.grid);
  round.grid.size = {64, 32, 32};
  round.voxels.assign(round.grid.voxels(), 1.5F);
  write_volume(folder / "round.nrrd", round);
  write_volume(folder / "round.nii.gz", round);
  for (const char* name : {"whole.nrrd", "whole.nii.gz", "round.nrrd", "round.nii.gz"}) {
    const auto size = fs::file_size(folder / name);
    EXPECT_EQ(error_of([&] { read_volume(folder / name); }), "");
    for (int bytes = 1; bytes <= 9; ++bytes) {
      fs::resize_file(folder / name, size - std::uintmax_t(bytes));
      EXPECT_NE(error_of([&] { read_volume(folder / name); }), "") << name << " without " << bytes;
    }
  }
  const fs::path dicom = folder / "dicom";
  write_dicom_series(dicom, oblique_volume<std::int16_t>(), "T1");
  const fs::path last = dicom / "slice_0004.dcm";
  const auto size = fs::file_size(last);
  for (int part = 0; part < 20; ++part) {
    fs::copy_file(last, folder / "keep", fs::copy_options::overwrite_existing);
    fs::resize_file(last, size * part / 20);
    EXPECT_NE(error_of([&] { read_volume(dicom); }), "") << part;
    fs::copy_file(folder / "keep", last, fs::copy_options::overwrite_existing);
  }
}

TEST_F(VolumeFile, ForeignAndNonFiniteFilesAreRefused) {
  std::ofstream(folder / "text.nrrd") << "hello\n";
  std::ofstream(folder / "scan.xyz") << "hello\n";
  EXPECT_NE(error_of([&] { read_volume(folder / "text.nrrd"); }), "");
  EXPECT_NE(error_of([&] { read_volume(folder / "scan.xyz"); }).find("extension"),
            std::string::npos);
  EXPECT_NE(error_of([&] { read_volume(folder / "absent.nrrd"); }), "");
  fs::create_directories(folder / "empty");
  EXPECT_NE(error_of([&] { read_volume(folder / "empty"); }).find("DICOM"), std::string::npos);
  auto volume = oblique_volume<float>();
  volume.at(2, 3, 1) = std::numeric_limits<float>::quiet_NaN();
  write_volume(folder / "nan.nrrd", volume);
  EXPECT_NE(error_of([&] { read_volume(folder / "nan.nrrd"); }).find("(2,3,1)"), std::string::npos);
}

TEST_F(VolumeFile, AForeignFolderIsNotReplacedByDicom) {
  std::ofstream(folder / "thesis.txt") << "years of work\n";
  EXPECT_THROW(write_dicom_series(folder, oblique_volume<std::int16_t>(), "T1"), Error);
  EXPECT_TRUE(fs::exists(folder / "thesis.txt"));
}

}  // namespace
}  // namespace breast
