// SPDX-License-Identifier: GPL-3.0-or-later
// Volumes whose headers leave voxel size or orientation open, contradict themselves or point
// elsewhere are refused in one line before a library sees them.
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/report.hpp"
#include "fixtures/dicom_elements.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/volume_file.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;

Volume<std::int16_t> small_volume() {
  Grid grid;
  grid.size = {6, 5, 4};
  grid.spacing = Vec3(0.75, 1.25, 2.5);
  grid.origin = Vec3(-30.5, 12.25, 40.125);
  Volume<std::int16_t> volume(grid);
  for (std::size_t v = 0; v < volume.voxels.size(); ++v) volume.voxels[v] = std::int16_t(v % 97);
  return volume;
}

std::string error_of(const fs::path& file) {
  try {
    read_volume(file);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 2) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "accepted";
}

// `text` with the first line that begins with `line` replaced, or taken out when `by` is empty.
std::string with_line(std::string text, const std::string& line, const std::string& by) {
  const auto at = text.find("\n" + line) + 1;
  EXPECT_NE(at, 0u) << line;
  return text.replace(at, text.find('\n', at) + 1 - at, by.empty() ? "" : by + "\n");
}

struct Header {
  const char *name, *line, *by, *says;
};

class NrrdHeaders : public testing::TestWithParam<Header> {};
TEST_P(NrrdHeaders, AreRefused) {
  const ScratchFolder folder;
  write_volume(folder / "good.nrrd", small_volume());
  const std::string good = read_text(folder / "good.nrrd");
  write_text(folder / "bad.nrrd", with_line(good, GetParam().line, GetParam().by));
  EXPECT_NE(error_of(folder / "bad.nrrd").find(GetParam().says), std::string::npos)
      << error_of(folder / "bad.nrrd");
}
constexpr const char* d = "space directions";
INSTANTIATE_TEST_SUITE_P(
    Lines, NrrdHeaders,
    testing::Values(
        Header{"no_space", "space:", "", "states no space"},
        Header{"unknown_space", "space:", "space: scanner-xyz", "scanner-xyz"},
        Header{"no_directions", d, "", "space directions"},
        Header{"spacings_only", d, "spacings: 1 1 1", "space directions"},
        Header{"zero", d, "space directions: (0,0,0) (0,1,0) (0,0,1)", "voxel size 0"},
        Header{"tiny", d, "space directions: (1e-9,0,0) (0,1,0) (0,0,1)", "voxel size"},
        Header{"huge", d, "space directions: (1e308,0,0) (0,1,0) (0,0,1)", "voxel size"},
        Header{"nan", d, "space directions: (nan,0,0) (0,1,0) (0,0,1)", "finite"},
        Header{"sheared", d, "space directions: (1,0.01,0) (0,1,0) (0,0,1)", "orthonormal"},
        Header{"far", "space origin", "space origin: (1e300,0,0)", "origin"},
        Header{"inches", "kinds", "space units: \"in\" \"in\" \"in\"", "\"in\""},
        Header{"two_units", "kinds", "space units: \"mm\" \"m\" \"mm\"", "one unit"},
        Header{"no_origin", "space origin", "", "states no space origin"},
        Header{"commas", "space origin", "space origin: (-30,5,12,25,40,125)", "space origin"},
        Header{"one_slice_less", "sizes", "sizes: 6 5 3", "header announces 180"},
        Header{"one_slice_more", "sizes", "sizes: 6 5 5", "header announces 300"},
        Header{"skipped_lines", "kinds", "line skip: 1", "to be skipped"},
        Header{"endless", "sizes", "sizes: 100000 100000 4", "voxels"},
        Header{"negative", "sizes", "sizes: -6 5 -4", "voxels"},
        Header{"twice", "kinds", "type: float", "twice"},
        Header{"device", "kinds", "data file: /dev/zero", "own folder"},
        Header{"climbing", "kinds", "data file: ../other.raw", "own folder"},
        Header{"absent", "kinds", "data file: other.raw", "does not exist"},
        Header{"list", "kinds", "data file: LIST", "one"},
        Header{"bzip2", "encoding", "encoding: bzip2", "bzip2"},
        Header{"colour", "type", "type: block", "block"}),
    [](const auto& header) { return header.param.name; });

class MetaHeaders : public testing::TestWithParam<Header> {};
TEST_P(MetaHeaders, AreRefused) {
  const ScratchFolder folder;
  write_volume(folder / "good.mha", small_volume());
  const std::string good = read_text(folder / "good.mha");
  write_text(folder / "bad.mha", with_line(good, GetParam().line, GetParam().by));
  EXPECT_NE(error_of(folder / "bad.mha").find(GetParam().says), std::string::npos)
      << error_of(folder / "bad.mha");
}
INSTANTIATE_TEST_SUITE_P(
    Lines, MetaHeaders,
    testing::Values(
        Header{"dimensions", "NDims", "NDims = 18446744073709551615", "NDims"},
        Header{"two_sizes", "DimSize", "DimSize = 6 5", "NDims"},
        Header{"contradiction", "DimSize", "DimSize = 6 5 4\nDimSize = 6 5 3", "DimSize twice"},
        Header{"no_matrix", "TransformMatrix", "", "orientation"},
        Header{"sheared", "TransformMatrix", "TransformMatrix = 1 0.01 0 0 1 0 0 0 1",
               "orthonormal"},
        Header{"nan", "TransformMatrix", "TransformMatrix = nan 0 0 0 1 0 0 0 1", "orientation"},
        Header{"no_spacing", "ElementSpacing", "", "voxel size"},
        Header{"zero", "ElementSpacing", "ElementSpacing = 0 1 1", "voxel size"},
        Header{"negative", "ElementSpacing", "ElementSpacing = 1 -1 1", "voxel size"},
        Header{"huge", "ElementSpacing", "ElementSpacing = 1 1 1e308", "voxel size"},
        Header{"device", "ElementDataFile", "ElementDataFile = /dev/zero", "own folder"},
        Header{"list", "ElementDataFile", "ElementDataFile = LIST", "one"},
        Header{"no_offset", "Offset", "", "states no Offset"},
        Header{"commas", "Offset", "Offset = -30,5 12,25 40,125", "three finite numbers"},
        Header{"commas_in_size", "ElementSpacing", "ElementSpacing = 0,75 1,25 2,5", "voxel size"},
        Header{"one_slice_less", "DimSize", "DimSize = 6 5 3",
               "240 bytes, but the header announces 180"},
        Header{"one_slice_more", "DimSize", "DimSize = 6 5 5", "truncated"},
        Header{"not_packed", "CompressedData", "CompressedData = True", "not the compressed data"},
        Header{"text", "BinaryData =", "BinaryData = False", "as text"},
        Header{"endless", "DimSize", "DimSize = 100000 100000 4", "voxels"},
        Header{"inches", "DimSize", "DistanceUnits = in\nDimSize = 6 5 4", "in"}),
    [](const auto& header) { return header.param.name; });

// A NIfTI file with bytes of its header replaced.
class NiftiHeaders : public testing::Test {
 protected:
  void SetUp() override {
    write_volume(folder_ / "good.nii", small_volume());
    good_ = read_text(folder_ / "good.nii");
  }
  template <class T>
  static void put(std::string& bytes, std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
  }
  std::string refusal(const std::string& bytes) {
    write_text(folder_ / "bad.nii", bytes);
    return error_of(folder_ / "bad.nii");
  }
  void expect(const char* says, const std::string& bytes) {
    const std::string text = refusal(bytes);
    EXPECT_NE(text.find(says), std::string::npos) << text;
  }
  ScratchFolder folder_;
  std::string good_;
};

TEST_F(NiftiHeaders, WithoutOrientation) {
  std::string bad = good_;
  put(bad, 252, std::int16_t(0));
  EXPECT_EQ(refusal(bad), "accepted");  // sform alone
  put(bad, 254, std::int16_t(0));
  expect("left and right", bad);
  put(bad, 252, std::int16_t(1));
  EXPECT_EQ(refusal(bad), "accepted");  // qform alone
}

TEST_F(NiftiHeaders, ThatContradictThemselves) {
  std::string bad = good_;
  float x = 0;
  std::memcpy(&x, bad.data() + 280, sizeof x);
  put(bad, 280, -x);  // left and right exchanged in sform alone
  expect("contradict", bad);
  bad = good_;
  put(bad, 280, 2 * x);
  expect("contradict", bad);
}

TEST_F(NiftiHeaders, WithoutVoxelSize) {
  for (const float size : {0.0F, -1.0F, 1e-9F, 1e30F, std::numeric_limits<float>::quiet_NaN()}) {
    std::string bad = good_;
    put(bad, 80, size);
    expect("voxel size", bad);
  }
}

TEST_F(NiftiHeaders, WithNumbersThatAreNone) {
  for (const float odd :
       {1e30F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (std::size_t at = 256; at < 328; at += 4) {
      std::string bad = good_;
      put(bad, at, odd);
      EXPECT_NE(refusal(bad), "accepted") << at;
    }
  }
  std::string bad = good_;
  put(bad, 70, std::int16_t(128));  // colour
  expect("data type", bad);
  bad = good_;
  put(bad, 108, std::numeric_limits<float>::infinity());
  expect("start of the voxels", bad);
  bad = good_;
  put(bad, 344, 'x');
  expect("not the NIfTI header", bad);
}

// Bytes behind the voxels mean that the header's sizes or start of the voxels are not those of the data.
TEST_F(NiftiHeaders, OfAFileThatIsLongerThanTheyAnnounce) {
  std::string bad = good_;
  put(bad, 46, std::int16_t(3));  // one slice less
  expect("592 bytes, but the header announces 532", bad);
  expect("593 bytes, but the header announces 592", good_ + '\0');
  gzFile packed = gzopen((folder_ / "bad.nii.gz").c_str(), "wb");
  gzwrite(packed, bad.data(), unsigned(bad.size()));
  gzclose(packed);
  EXPECT_NE(error_of(folder_ / "bad.nii.gz").find("announces 532"), std::string::npos);
}

TEST_F(NiftiHeaders, ScaleTheStoredValues) {
  std::string scaled = good_;
  put(scaled, 112, 0.5F);
  put(scaled, 116, -3.0F);
  ASSERT_EQ(refusal(scaled), "accepted");
  EXPECT_EQ(read_volume(folder_ / "bad.nii").voxels[10], 2);
  put(scaled, 112, 0.0F);  // no scale, as the format has it
  ASSERT_EQ(refusal(scaled), "accepted");
  EXPECT_EQ(read_volume(folder_ / "bad.nii").voxels[10], 10);
}

TEST_F(NiftiHeaders, OfTheOtherOrderOfBytes) {
  std::string other = good_;
  const auto turn = [&](std::size_t from, std::size_t to, std::size_t each) {
    for (std::size_t at = from; at < to; at += each)
      std::reverse(other.begin() + long(at), other.begin() + long(at + each));
  };
  turn(0, 4, 4);
  turn(40, 56, 2);
  turn(68, 76, 2);
  turn(76, 120, 4);
  turn(252, 256, 2);
  turn(256, 328, 4);
  turn(352, other.size(), 2);
  ASSERT_EQ(refusal(other), "accepted");
  const Volume<float> read = read_volume(folder_ / "bad.nii"),
                      good = read_volume(folder_ / "good.nii");
  EXPECT_EQ(read.voxels, good.voxels);
  EXPECT_EQ(read.grid.origin, good.grid.origin);
}

// The same volume with its lengths in another unit, by either form of orientation.
TEST_F(NiftiHeaders, OfOtherUnitsGiveMillimetres) {
  const Grid mm = small_volume().grid;
  constexpr double single_precision = 1e-4;
  const std::pair<std::uint8_t, double> units[] = {{1, 1e-3}, {3, 1e3}, {0, 1.0}};
  for (const auto& [code, factor] : units) {
    for (const std::size_t unstated : {std::size_t(252), std::size_t(254)}) {
      std::string other = good_;
      std::vector<std::size_t> lengths = {80, 84, 88, 268, 272, 276};
      for (std::size_t at = 280; at < 328; at += 4) lengths.push_back(at);
      for (const std::size_t at : lengths) {
        float length = 0;
        std::memcpy(&length, other.data() + at, sizeof length);
        put(other, at, float(factor * length));
      }
      put(other, 123, code);
      put(other, unstated, std::int16_t(0));
      ASSERT_EQ(refusal(other), "accepted") << int(code);
      const Grid read = read_volume(folder_ / "bad.nii").grid;
      EXPECT_LT((read.spacing - mm.spacing).norm(), single_precision) << int(code);
      EXPECT_LT((read.origin - mm.origin).norm(), single_precision) << int(code);
      EXPECT_LT((read.direction - mm.direction).norm(), single_precision) << int(code);
    }
  }
}

TEST(VolumeHeaders, OfOtherUnitsGiveMillimetres) {
  const ScratchFolder folder;
  const Grid mm = small_volume().grid;
  write_volume(folder / "mm.nrrd", small_volume());
  write_volume(folder / "mm.mha", small_volume());
  const std::string nrrd = read_text(folder / "mm.nrrd"), meta = read_text(folder / "mm.mha");
  std::string text = with_line(nrrd, "kinds", "space units: \"cm\" \"cm\" \"cm\"");
  text =
      with_line(text, "space directions", "space directions: (0.075,0,0) (0,0.125,0) (0,0,0.25)");
  write_text(folder / "cm.nrrd",
             with_line(text, "space origin", "space origin: (-3.05,1.225,4.0125)"));
  text = with_line(meta, "ElementSpacing", "DistanceUnits = um\nElementSpacing = 750 1250 2500");
  write_text(folder / "um.mha", with_line(text, "Offset", "Offset = -30500 12250 40125"));
  for (const char* name : {"cm.nrrd", "um.mha"}) {
    ASSERT_EQ(error_of(folder / name), "accepted");
    const Grid read = read_volume(folder / name).grid;
    EXPECT_LT((read.spacing - mm.spacing).norm(), 1e-9) << name;
    EXPECT_LT((read.origin - mm.origin).norm(), 1e-9) << name;
  }
}

TEST(VolumeHeaders, VoxelsAsTextAreCounted) {
  const ScratchFolder folder;
  write_volume(folder / "gzip.nrrd", small_volume());
  std::string text = read_text(folder / "gzip.nrrd");
  text = with_line(text.substr(0, text.find("\n\n") + 2), "encoding", "encoding: text");
  for (int v = 0; v < 120; ++v) text += std::to_string(v) + (v % 6 == 5 ? "\n" : ", ");
  write_text(folder / "text.nrrd", text);
  EXPECT_EQ(error_of(folder / "text.nrrd"), "accepted");
  write_text(folder / "text.nrrd", text + "120\n");
  EXPECT_NE(error_of(folder / "text.nrrd").find("121 voxels, but the header announces 120"),
            std::string::npos);
}

// MetaImage's compressed voxels are a zlib stream, which ITK inflates as far as the header's sizes go.
TEST(VolumeHeaders, ACompressedMetaImageIsAsLongAsItsSizes) {
  const ScratchFolder folder;
  write_volume(folder / "raw.mha", small_volume());
  const std::string raw = read_text(folder / "raw.mha");
  const auto data = raw.find("LOCAL\n") + 6;
  uLongf size = compressBound(uLong(raw.size() - data));
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(raw.data() + data), uLong(raw.size() - data));
  packed.resize(size);
  const std::string unsized =
      with_line(raw.substr(0, data), "CompressedData", "CompressedData = True");
  write_text(folder / "packed.mha", unsized + packed);
  EXPECT_NE(error_of(folder / "packed.mha").find("no CompressedDataSize"), std::string::npos);
  const std::string header =
      with_line(unsized, "CompressedData =",
                "CompressedData = True\nCompressedDataSize = " + std::to_string(packed.size()));
  write_text(folder / "packed.mha", header + packed);
  EXPECT_EQ(read_volume(folder / "packed.mha").voxels, read_volume(folder / "raw.mha").voxels);
  write_text(folder / "packed.mha", with_line(header, "DimSize", "DimSize = 6 5 3") + packed);
  EXPECT_NE(error_of(folder / "packed.mha").find("announces 180"), std::string::npos);
}

TEST(VolumeHeaders, AnUpperCaseEndingIsCheckedAsWell) {
  const ScratchFolder folder;
  for (const std::string ending : {"NRRD", "NII", "NII.GZ", "MHA"}) {
    const fs::path file = folder / ("SCAN." + ending);
    write_volume(file, small_volume());
    EXPECT_EQ(error_of(file), "accepted") << ending;
    fs::resize_file(file, fs::file_size(file) - 3);
    EXPECT_NE(error_of(file), "accepted") << ending;
  }
}

TEST(VolumeHeaders, VoxelsInAFileOfTheSameFolderAreRead) {
  const ScratchFolder folder;
  const Volume<std::int16_t> volume = small_volume();
  write_volume(folder / "scan.nrrd", volume);
  const std::string nrrd = read_text(folder / "scan.nrrd");
  const auto voxels = nrrd.find("\n\n") + 2;
  write_text(folder / "voxels.gz", nrrd.substr(voxels));
  write_text(folder / "scan.nhdr", nrrd.substr(0, voxels - 1) + "data file: voxels.gz\n");
  write_volume(folder / "scan.mha", volume);
  const std::string meta = read_text(folder / "scan.mha");
  const auto data = meta.find("LOCAL\n");
  write_text(folder / "voxels.raw", meta.substr(data + 6));
  write_text(folder / "scan.mhd", meta.substr(0, data) + "voxels.raw\n");
  for (const char* name : {"scan.nhdr", "scan.mhd"}) {
    ASSERT_EQ(error_of(folder / name), "accepted");
    const Volume<float> read = read_volume(folder / name);
    EXPECT_TRUE(std::equal(read.voxels.begin(), read.voxels.end(), volume.voxels.begin())) << name;
  }
}

TEST(VolumeHeaders, OtherSpacesAreTurnedIntoLps) {
  struct Space {
    const char *name, *directions, *origin;
  };
  const ScratchFolder folder;
  write_volume(folder / "lps.nrrd", small_volume());
  const Volume<float> lps = read_volume(folder / "lps.nrrd");
  for (const Space& space :
       {Space{"right-anterior-superior", "(-0.75,0,0) (0,-1.25,0) (0,0,2.5)",
              "(30.5,-12.25,40.125)"},
        Space{"left-anterior-superior", "(0.75,0,0) (0,-1.25,0) (0,0,2.5)",
              "(-30.5,-12.25,40.125)"},
        Space{"LAS", "(0.75,0,0) (0,-1.25,0) (0,0,2.5)", "(-30.5,-12.25,40.125)"}}) {
    std::string text = read_text(folder / "lps.nrrd");
    text = with_line(text, "space:", std::string("space: ") + space.name);
    text =
        with_line(text, "space directions", std::string("space directions: ") + space.directions);
    text = with_line(text, "space origin", std::string("space origin: ") + space.origin);
    write_text(folder / "other.nrrd", text);
    const Volume<float> other = read_volume(folder / "other.nrrd");
    EXPECT_LT((lps.grid.origin - other.grid.origin).norm(), 1e-9) << space.name;
    EXPECT_LT((lps.grid.direction - other.grid.direction).norm(), 1e-9) << space.name;
    EXPECT_EQ(lps.voxels, other.voxels) << space.name;
  }
}

// A stream of zeros a thousand times larger than what the header accounts for.
TEST(VolumeHeaders, AGzipBombStopsAtWhatTheHeaderAnnounces) {
  const ScratchFolder folder;
  write_volume(folder / "good.nii.gz", small_volume());
  gzFile good = gzopen((folder / "good.nii.gz").c_str(), "rb");
  std::string header(352, '\0');
  gzread(good, header.data(), 352);
  gzclose(good);
  gzFile bomb = gzopen((folder / "bomb.nii.gz").c_str(), "wb");
  gzwrite(bomb, header.data(), 352);
  const std::string zeros(std::size_t(1) << 20, '\0');
  for (int megabyte = 0; megabyte < 600; ++megabyte)
    gzwrite(bomb, zeros.data(), unsigned(zeros.size()));
  gzclose(bomb);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_NE(error_of(folder / "bomb.nii.gz").find("of more than 592 bytes"), std::string::npos);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_LT(seconds.count(), 0.5);
}

// A line is read as far as a header's lines may reach, not to the end of the file.
TEST(VolumeHeaders, AFileWithoutLineEndsDoesNotFillMemory) {
  const ScratchFolder folder;
  constexpr std::uintmax_t gigabyte = std::uintmax_t(1) << 30;
  constexpr double some_mb = 100;
  const double before = peak_memory_mb();
  const std::pair<const char*, const char*> files[] = {{"a.nrrd", "NRRD0005\n"},
                                                       {"a.mha", "ObjectType = Image\n"}};
  for (const auto& [name, head] : files) {
    write_text(folder / name, head);
    fs::resize_file(folder / name, gigabyte);  // a hole: the disk holds none of it
    EXPECT_NE(error_of(folder / name), "accepted") << name;
  }
  EXPECT_LT(peak_memory_mb() - before, some_mb);
}

class DicomHeaders : public testing::Test {
 protected:
  void SetUp() override { write_dicom_series(folder_ / "scan", small_volume(), "T1"); }
  fs::path slice(int n) const { return folder_ / ("scan/slice_000" + std::to_string(n) + ".dcm"); }
  /// Replaces a text by one of the same length in some slices.
  void change(const std::string& from, const std::string& to, int first = 1, int last = 4) {
    ASSERT_EQ(from.size(), to.size());
    for (int n = first; n <= last; ++n) {
      std::string bytes = read_text(slice(n));
      const auto at = bytes.find(from);
      ASSERT_NE(at, std::string::npos) << from;
      write_text(slice(n), bytes.replace(at, from.size(), to));
    }
  }
  void expect(const char* says) {
    const std::string text = error_of(folder_ / "scan");
    EXPECT_NE(text.find(says), std::string::npos) << text;
  }
  ScratchFolder folder_;
};

// Zeros are elements without content, eight bytes each, and every one costs a seek.
TEST_F(DicomHeaders, OfEndlessElements) {
  std::string bytes = read_text(slice(2)).substr(0, 132);
  write_text(slice(2), bytes.append(std::size_t(8) << 20, '\0'));
  expect("more elements than any image");
}

// Another reader takes the text of an unknown kind for a length, and asks for a gigabyte.
TEST_F(DicomHeaders, OfAnUnknownKind) {
  change(std::string("\x08\0\x60\0CS", 6), std::string("\x08\0\x60\0KS", 6), 2, 2);
  expect("no element where one must be");
}
TEST_F(DicomHeaders, WithoutPixelSpacing) {
  change(std::string("\x28\0\x30\0", 4), std::string("\x28\0\x31\0", 4));
  expect("states no pixel spacing");
}
TEST_F(DicomHeaders, WithPixelSpacingZero) {
  change("1.25\\0.75", "0.00\\0.75");
  expect("pixel spacing 0");
}
TEST_F(DicomHeaders, WithDecimalCommas) {
  change("1.25\\0.75", "1,25\\0,75");
  expect("states no pixel spacing of two numbers");
}
TEST_F(DicomHeaders, WithOneSliceOfAnotherSpacing) {
  change("1.25\\0.75", "1.35\\0.75", 3, 3);
  expect("slice_0003.dcm");
}
TEST_F(DicomHeaders, OfPixelsThatAreNotGreyShorts) {
  change("MONOCHROME2", "PALETTE COL");
  expect("PALETTE");
}
TEST_F(DicomHeaders, OfTwelveBits) {
  change(std::string("\x28\0\0\1US\2\0\x10\0", 10), std::string("\x28\0\0\1US\2\0\x0c\0", 10));
  expect("12 bits");
}
TEST_F(DicomHeaders, OfTwoPatients) {
  change("SIMULATED", "SOMEBODY ", 3, 3);
  expect("slice_0003.dcm: names another patient");
}
TEST_F(DicomHeaders, OfAnotherModality) {
  change(std::string("\x08\0\x60\0CS\2\0MR", 10), std::string("\x08\0\x60\0CS\2\0CT", 10));
  expect("modality CT");
}
TEST_F(DicomHeaders, WithATransferSyntaxThatIsNotThatOfThePixels) {
  change(std::string("1.2.840.10008.1.2.1\0", 20), std::string("1.2.840.10008.1.2.5\0", 20), 2, 2);
  expect("slice_0002.dcm: pixel data are not encapsulated, contrary to the transfer syntax");
}
TEST_F(DicomHeaders, OfThePatientsPositionAreKept) {
  VolumeSource source;
  read_volume(folder_ / "scan", 0, &source);
  EXPECT_EQ(source.patient_position, "HFP");
}
// A text of two bytes, which is no number in binary.
TEST_F(DicomHeaders, WithRescaleSlopeZero) {
  for (int n = 1; n <= 4; ++n) {
    write_text(slice(n), fixtures::with_elements(read_text(slice(n)),
                                                 DatasetBuilder().number(0x00281053, 0)));
  }
  expect("rescale slope 0: must be above 0");
}
TEST_F(DicomHeaders, BesideALinkToItself) {
  fs::create_symlink(folder_ / "scan/loop", folder_ / "scan/loop");
  fs::create_symlink(folder_ / "nowhere", folder_ / "scan/broken.dcm");
  EXPECT_EQ(error_of(folder_ / "scan"), "accepted");
}
TEST_F(DicomHeaders, WithAxesThatAreNot) {
  change("1\\0\\0\\0\\1\\0", "1\\0\\0\\0\\2\\0");
  expect("perpendicular");
}
TEST_F(DicomHeaders, AMissingSliceIsBetweenTheTwoThatAreNamed) {
  Volume<std::int16_t> longer = small_volume();
  longer.grid.size[2] = 9;
  longer.voxels.resize(longer.grid.voxels(), 1);
  write_dicom_series(folder_ / "long", longer, "T1");
  fs::remove(folder_ / "long/slice_0008.dcm");
  const std::string text = error_of(folder_ / "long");
  EXPECT_NE(text.find("slice_0007.dcm and slice_0009.dcm"), std::string::npos) << text;
}

TEST(DicomFolders, APatientsSlicesAreNotReplaced) {
  const ScratchFolder folder;
  write_dicom_series(folder / "patient", small_volume(), "T1");
  for (int n = 1; n <= 4; ++n) {
    const fs::path file = folder / ("patient/slice_000" + std::to_string(n) + ".dcm");
    std::string bytes = read_text(file);
    for (auto at = bytes.find("libbreast"); at != std::string::npos; at = bytes.find("libbreast")) {
      bytes.replace(at, 9, "hospital1");
    }
    write_text(file, bytes);
  }
  EXPECT_THROW(check_dicom_folder(folder / "patient"), Error);
  EXPECT_THROW(write_dicom_series(folder / "patient", small_volume(), "T1"), Error);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "patient"), {}), 4);
}

}  // namespace
}  // namespace breast
