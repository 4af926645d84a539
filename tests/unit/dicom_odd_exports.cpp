// SPDX-License-Identifier: GPL-3.0-or-later
// Exports that were once read wrong in silence, chosen wrong, or called damaged without being so.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>

#include "core/error.hpp"
#include "fixtures/dicom_export.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/volume_file.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;
using namespace fixtures;
using ShortVolume = Volume<std::int16_t>;

ShortVolume scan_of(int shift) {
  return numbered(exported_grid(), 241, shift);  // of 8 bits
}

/// A series in a folder of its own.
ExportImages series(const std::string& name, int number) {
  ExportImages images;
  images.series = name;
  images.number = number;
  return images;
}

/// "read" if the volume is the expected one, otherwise the refusal.
std::string outcome(const fs::path& folder, const ShortVolume& expected, int number = 0) {
  try {
    const Volume<float> read = read_volume(folder, ScanChoice(number));
    const bool same = read.grid.size == expected.grid.size &&
                      std::equal(read.voxels.begin(), read.voxels.end(), expected.voxels.begin(),
                                 expected.voxels.end());
    return same ? "read" : "read as another volume";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    return error.what();
  }
}

void expect_refusal(const std::string& says, const char* words) {
  EXPECT_NE(says.find(words), std::string::npos) << says;
  EXPECT_EQ(says.find("damaged"), std::string::npos) << says;
}

// Words of 16 bits hold two pixels of 8, the second one first.
TEST(DicomOddExports, BytesInBigEndianWordsAreRead) {
  const ShortVolume volume = scan_of(0);
  for (const char* syntax : {explicit_big, explicit_little}) {
    const ScratchFolder folder;
    ExportForm form;
    form.syntax = syntax;
    for (int k = 0; k < volume.grid.size[2]; ++k) {
      const std::vector<std::int16_t> slice = slice_values(volume, k);
      const std::vector<std::uint8_t> bytes(slice.begin(), slice.end());
      std::vector<std::int16_t> words(bytes.size() / 2);
      std::memcpy(words.data(), bytes.data(), bytes.size());
      DatasetBuilder set = series_elements(volume.grid, {}, "1.2.840.10008.5.1.4.1.1.4",
                                           "bytes " + std::to_string(k));
      set.unsigned_short(0x00280100, 8)
          .unsigned_short(0x00280101, 8)
          .unsigned_short(0x00280102, 7)
          .unsigned_short(0x00280103, 0)
          .text(0x00200032, "DS", position_of(volume.grid, k, {}))
          .text(0x00200037, "DS", axes_of(volume.grid))
          .text(0x00280030, "DS", "4.5\\4");
      write_object(folder / (std::to_string(k) + ".dcm"), set, words, 20, 18, 1, form);
    }
    EXPECT_EQ(outcome(folder.path(), volume), "read") << syntax;
  }
}

TEST(DicomOddExports, BigEndianElementsWithoutMetaInformationAreRead) {
  const ScratchFolder folder;
  ExportForm form;
  form.syntax = explicit_big;
  form.meta = false;
  write_slices(folder.path(), "a", "", scan_of(0), {}, form);
  EXPECT_EQ(outcome(folder.path(), scan_of(0)), "read");
}

// The middle of the volume would be shifted, as the ends of the line alone give its place.
TEST(DicomOddExports, SlicesBesideTheLineOfTheOthersAreRefused) {
  for (const auto& [first, last] : {std::pair{7, 7}, {4, 11}}) {
    for (const auto& [mm, read] : {std::pair{12.0, false}, {0.3, false}, {0.1, true}}) {
      const ScratchFolder folder;
      ExportImages images;
      images.change = [&, from = first, to = last, by = mm](DatasetBuilder& set, int k) {
        const Vec3 at = scan_of(0).grid.to_patient(Vec3(0, 0, k));
        const double x = at.x() + (k >= from && k <= to ? by : 0);
        set.text(0x00200032, "DS", numbers({x, at.y(), at.z()}));
      };
      write_slices(folder.path(), "a", ".dcm", scan_of(0), images, {});
      const std::string says = outcome(folder.path(), scan_of(0));
      if (read) {
        EXPECT_EQ(says, "read");
      } else {
        expect_refusal(says, "beside the straight line");
      }
    }
  }
}

TEST(DicomOddExports, PositionsInWholeMillimetresAreSaidToBeRounded) {
  ShortVolume volume = scan_of(0);
  volume.grid.spacing[2] = 4.5;
  const ScratchFolder folder;
  ExportImages images;
  images.change = [&](DatasetBuilder& set, int k) {
    const Vec3 at = volume.grid.to_patient(Vec3(0, 0, k));
    set.text(0x00200032, "DS", numbers({at.x(), at.y(), std::floor(at.z())}));
  };
  write_slices(folder.path(), "a", ".dcm", volume, images, {});
  expect_refusal(outcome(folder.path(), volume), "rounded");
}

// Image Type does not tell them apart, and phase is numbered first.
TEST(DicomOddExports, MagnitudeIsTakenWhereAnElementOfItsOwnTellsPhase) {
  const auto stated = [](const char* component) {
    return [=](DatasetBuilder& set, int) { set.text(0x00089208, "CS", component); };
  };
  const auto private_number = [](int number) {
    return [=](DatasetBuilder& set, int) {
      set.text(0x00430010, "LO", "GEMS_PARM_01").signed_short(0x0043102f, std::int16_t(number));
    };
  };
  using Change = std::function<void(DatasetBuilder&, int)>;
  const std::vector<std::pair<Change, Change>> forms = {{stated("PHASE"), stated("MAGNITUDE")},
                                                        {private_number(1), private_number(0)}};
  for (const auto& [phase, magnitude] : forms) {
    const ScratchFolder folder;
    ExportImages images;
    images.change = phase;
    write_slices(folder.path(), "p", ".dcm", scan_of(300), images, {});
    images.change = magnitude;
    images.first_instance = 100;
    write_slices(folder.path(), "m", ".dcm", scan_of(0), images, {});
    EXPECT_EQ(outcome(folder.path(), scan_of(0)), "read");
    VolumeSource source;
    read_volume(folder.path(), ScanChoice(2), &source);
    EXPECT_EQ(source.contrast, "phase or complex part");
  }
}

TEST(DicomOddExports, SyntaxesOfOneMakerAndPixelsOnAServerAreNamed) {
  const std::vector<std::pair<const char*, const char*>> cases = {
      {"1.2.840.113619.5.2", "is no standard one"},
      {"1.3.46.670589.33.1.4.1", "is no standard one"},
      {"1.2.840.10008.1.2.4.94", "names a server"},
      {"1.2.840.10008.1.2.4.95", "names a server"}};
  for (const auto& [syntax, words] : cases) {
    const ScratchFolder folder;
    const ShortVolume volume = scan_of(0);
    const DatasetBuilder set =
        series_elements(volume.grid, {}, "1.2.840.10008.5.1.4.1.1.4", syntax);
    fs::create_directories(folder.path());
    std::ofstream(folder / "a.dcm", std::ios::binary) << set.file(syntax);
    expect_refusal(outcome(folder.path(), volume), words);
  }
}

TEST(DicomOddExports, APictureOfTheScreenAmongTheSlicesIsNoneOfThem) {
  const ScratchFolder folder;
  const ShortVolume volume = scan_of(0);
  write_slices(folder.path(), "a", ".dcm", volume, {}, {});
  const DatasetBuilder set =
      series_elements(volume.grid, {}, "1.2.840.10008.5.1.4.1.1.7", "picture");
  write_object(folder / "picture.dcm", set, slice_values(volume, 0), 20, 18, 1, {});
  EXPECT_EQ(outcome(folder.path(), volume), "read");
}

// The first of them would be taken for the slice.
TEST(DicomOddExports, MoreFramesThanStatedAreRefused) {
  const ShortVolume volume = scan_of(0);
  for (const std::size_t padding : {10, 360}) {
    const ScratchFolder folder;
    for (int k = 0; k < volume.grid.size[2]; ++k) {
      std::vector<std::int16_t> values = slice_values(volume, k);
      values.resize(values.size() + padding);
      DatasetBuilder set = series_elements(volume.grid, {}, "1.2.840.10008.5.1.4.1.1.4",
                                           "frames " + std::to_string(k));
      set.text(0x00200032, "DS", position_of(volume.grid, k, {}))
          .text(0x00200037, "DS", axes_of(volume.grid))
          .text(0x00280030, "DS", "4.5\\4");
      write_object(folder / (std::to_string(k) + ".dcm"), set, values, 20, 18, 1, {});
    }
    const std::string says = outcome(folder.path(), volume);
    if (padding < 360) {
      EXPECT_EQ(says, "read");
    } else {
      expect_refusal(says, "more frames than it states");
    }
  }
}

// It states its class in the meta information alone.
TEST(DicomOddExports, ADirectoryOfFilesUnderAnotherNameIsCalledSo) {
  const ScratchFolder folder;
  write_slices(folder.path(), "a", ".dcm", scan_of(0), {}, {});
  std::string directory = DatasetBuilder()
                              .text(0x00080016, "UI", "1.2.840.10008.1.3.10")
                              .text(0x00080018, "UI", "2.25.3")
                              .file();
  directory.resize(directory.find(std::string("\x08\0\x16\0UI", 6)));
  std::ofstream(folder / "index.dcm", std::ios::binary)
      << directory << DatasetBuilder().text(0x00041130, "CS", "DISC").bytes();
  VolumeSource source;
  read_volume(folder.path(), {}, &source);
  ASSERT_EQ(source.remarks.size(), 1u);
  EXPECT_NE(source.remarks.front().find("directory of files (1)"), std::string::npos)
      << source.remarks.front();
}

// Also where their contrasts differ: the better one may be of another woman, or years old.
TEST(DicomOddExports, SeveralWomenOrExaminationsAreNotChosenBetween) {
  for (const bool of_one_woman : {true, false}) {
    const ScratchFolder folder;
    write_slices(folder / "a", "a", ".dcm", scan_of(0), series("a", 1), {});
    ExportImages other = series("b", 2);
    other.description = "T1 SPAIR";
    other.study = "2.25.2";
    if (!of_one_woman) other.patient = "43";
    write_slices(folder / "b", "b", ".dcm", scan_of(300), other, {});
    expect_refusal(outcome(folder.path(), scan_of(0)), "several patients or examinations");
    EXPECT_EQ(outcome(folder.path(), scan_of(0), 1), "read");
    EXPECT_EQ(outcome(folder.path(), scan_of(300), 2), "read");
    std::vector<std::string> remarks;
    const Table list = list_series(folder.path(), {}, remarks);
    for (std::size_t row = 0; row < list.rows.size(); ++row)
      EXPECT_EQ(list.cell(row, "use").find("taken"), std::string::npos) << list.cell(row, "use");
  }
}

// A reformatted series, or a difference whose name does not say so, has the contrast of the scan by its header.
TEST(DicomOddExports, WhatIsSecondaryIsNotTakenForTheScan) {
  const ScratchFolder folder;
  write_slices(folder / "a", "a", ".dcm", scan_of(0), series("a", 5), {});
  ExportImages other = series("b", 4);
  other.type = "DERIVED\\SECONDARY\\OTHER";
  write_slices(folder / "b", "b", ".dcm", scan_of(300), other, {});
  EXPECT_EQ(outcome(folder.path(), scan_of(0)), "read");
}

}  // namespace
}  // namespace breast
