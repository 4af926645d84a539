// SPDX-License-Identifier: GPL-3.0-or-later
// Dixon series as scanners store them: water, fat, in and opposed phase, and what is derived from them, told apart by
// the type of each image, of each frame, or by the names of series.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "fixtures/dicom_export.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/series/contrast.hpp"
#include "io/volume_file.hpp"

namespace breast {
namespace {

using namespace fixtures;
using ShortVolume = Volume<std::int16_t>;

std::string contrast_named(const std::string& type, const std::string& description) {
  const std::map<std::string, std::string> header = {
      {"0008|0008", type}, {"0008|103e", description}, {"0018|0080", "5"}, {"0018|0081", "2"}};
  return contrast_name(contrast_of([&](const char* key) -> std::string {
    const auto found = header.find(key);
    return found == header.end() ? "" : found->second;
  }));
}

TEST(DicomContrasts, AreThoseOfTheTypeOrOfTheName) {
  struct Case {
    const char *type, *description, *contrast;
  };
  const std::vector<Case> cases = {
      {"DERIVED\\PRIMARY\\DIXON\\WATER", "", "water"},
      {"DERIVED\\PRIMARY\\DIXON\\FAT", "", "fat"},
      {"DERIVED\\PRIMARY\\DIXON\\IN_PHASE\\DIS2D\\MFSPLIT", "", "in phase"},
      {"DERIVED\\PRIMARY\\DIXON\\OUT_PHASE", "", "opposed phase"},
      {"DERIVED\\PRIMARY\\DIXON\\FAT_FRACTION", "", "map of a quantity"},
      {"DERIVED\\PRIMARY\\DIXON\\R2_STAR_MAP", "", "map of a quantity"},
      {"ORIGINAL\\PRIMARY\\W\\W\\DERIVED", "", "water"},
      {"ORIGINAL\\PRIMARY\\OP\\OP\\DERIVED", "", "opposed phase"},
      {"ORIGINAL\\PRIMARY\\M_FFE\\M\\FFE", "", "T1"},
      {"ORIGINAL\\PRIMARY\\PHASE MAP\\P\\FFE", "", "phase or complex part"},
      {"DERIVED\\PRIMARY\\MAX_IP\\NONE", "", "projection"},
      {"ORIGINAL\\PRIMARY\\M\\ND", "t1_vibe_dixon_tra_in", "in phase"},
      {"ORIGINAL\\PRIMARY\\M\\ND", "t1_vibe_dixon_tra_opp", "opposed phase"},
      {"ORIGINAL\\PRIMARY\\M\\ND", "t1_vibe_dixon_tra_W", "water"},
      {"ORIGINAL\\PRIMARY\\M\\ND", "t1_vibe_dixon_tra_F", "fat"},
      {"ORIGINAL\\PRIMARY\\OTHER", "WATER: Ax VIBRANT", "water"},
      {"ORIGINAL\\PRIMARY\\OTHER", "Ax T1 in-phase", "in phase"},
      {"ORIGINAL\\PRIMARY\\OTHER", "Ax T1 out of phase", "opposed phase"},
      {"ORIGINAL\\PRIMARY\\M\\ND", "t1_tra dynamic in 5 phases", "T1"},
      {"ORIGINAL\\PRIMARY\\M\\ND", "t1 tra dyn phase 1 in 60 s", "T1"},
      // The letter of "w/o" is no water image, and what it takes back is the word after it.
      {"ORIGINAL\\PRIMARY\\OTHER", "AX T1 W/O FS", "T1"},
      {"ORIGINAL\\PRIMARY\\OTHER", "AX T1w/o FS", "T1"},
      {"ORIGINAL\\PRIMARY\\OTHER", "T1 axw/o w/o FS", "T1"},
      {"ORIGINAL\\PRIMARY\\OTHER", "AXIAL T1 W/O FAT SAT", "T1"},
      {"ORIGINAL\\PRIMARY\\OTHER", "AX T1 W/O CONTRAST", "T1"},
      {"ORIGINAL\\PRIMARY\\OTHER", "AX T1 W/ FS", "T1 fat-suppressed"},
      {"ORIGINAL\\PRIMARY\\OTHER", "AX T1 FS W/O CONTRAST", "T1 fat-suppressed"},
      {"ORIGINAL\\PRIMARY\\OTHER", "AX T1 W/O GAD FS", "T1 fat-suppressed"},
      {"ORIGINAL\\PRIMARY\\OTHER", "T1 FS no contrast", "T1 fat-suppressed"},
      {"ORIGINAL\\PRIMARY\\OTHER", "VIBRANT fat suppressed pre", "T1 fat-suppressed"},
      {"ORIGINAL\\PRIMARY\\M\\ND", "t1_fl3d_tra_we", "T1 fat-suppressed"},
      {"ORIGINAL\\PRIMARY\\M\\ND", "T1 ohne FS", "T1"},
      {"ORIGINAL\\PRIMARY\\M\\ND", "T1 sans fat sat", "T1"},
      {"ORIGINAL\\PRIMARY\\M\\ND", "T1 non-fat-sat", "T1"},
      {"ORIGINAL\\PRIMARY\\M\\ND", "T1 W TSE", "T1"},
      {"ORIGINAL\\PRIMARY\\M\\ND", "t1_tra post op", "T1"},
      {"ORIGINAL\\PRIMARY\\M\\ND", "T1 map", "map of a quantity"},
      {"ORIGINAL\\PRIMARY\\M\\ND", "eADC", "diffusion"},
      {"DERIVED\\PRIMARY\\T1 MAP\\MFSPLIT", "", "map of a quantity"},
      {"DERIVED\\SECONDARY", "t1 dyn Subtraktion", "subtraction"}};
  for (const Case& one : cases)
    EXPECT_EQ(contrast_named(one.type, one.description), one.contrast)
        << one.type << " " << one.description;
}

ShortVolume volume_of(int shift) {
  return numbered(exported_grid(), 1009, shift);
}

const std::map<std::string, std::string>& kinds() {
  static const std::map<std::string, std::string> all = {
      {"water", "DERIVED\\PRIMARY\\DIXON\\WATER"},
      {"fat", "DERIVED\\PRIMARY\\DIXON\\FAT"},
      {"in phase", "DERIVED\\PRIMARY\\DIXON\\IN_PHASE"},
      {"opposed phase", "DERIVED\\PRIMARY\\DIXON\\OUT_PHASE"},
      {"map of a quantity", "DERIVED\\PRIMARY\\DIXON\\FAT_FRACTION"}};
  return all;
}

/// All kinds of the scan at `times` time points; the nth volume is shifted by 10 n.
std::vector<std::pair<ShortVolume, ExportImages>> dixon(int times) {
  std::vector<std::pair<ShortVolume, ExportImages>> all;
  for (int time = 1; time <= times; ++time) {
    for (const auto& [name, type] : kinds()) {
      ExportImages images;
      images.type = type;
      images.time = times > 1 ? time : 0;
      images.first_instance = 1 + int(all.size()) * 100;
      all.emplace_back(volume_of(10 * int(all.size())), images);
    }
  }
  return all;
}

/// Every series is one of the volumes with its contrast, and without a number in phase is taken.
void expect_kinds(const std::filesystem::path& folder,
                  const std::vector<std::pair<ShortVolume, ExportImages>>& all) {
  std::vector<std::string> remarks;
  const Table list = list_series(folder, {}, remarks);
  ASSERT_EQ(list.rows.size(), all.size());
  std::set<std::string> found;
  for (std::size_t row = 0; row < list.rows.size(); ++row) {
    const Volume<float> read = read_volume(folder, ScanChoice(int(row) + 1));
    const auto same = std::find_if(all.begin(), all.end(), [&](const auto& one) {
      return std::equal(read.voxels.begin(), read.voxels.end(), one.first.voxels.begin(),
                        one.first.voxels.end());
    });
    ASSERT_NE(same, all.end()) << "row " << row + 1 << " mixes volumes";
    EXPECT_EQ(kinds().at(list.cell(row, "contrast")), same->second.type);
    found.insert(same->second.type + std::to_string(same->second.time));
  }
  EXPECT_EQ(found.size(), all.size());
  VolumeSource source;
  read_volume(folder, {}, &source);
  EXPECT_EQ(source.contrast, "in phase");
}

TEST(DicomContrasts, TellTheImagesOfADixonSeriesApart) {
  // Series in folders of their own with time points would be equally good.
  const std::vector<std::pair<std::string, int>> forms = {
      {"enhanced", 1}, {"enhanced", 2}, {"slices", 1}, {"slices", 2}, {"folders", 1}};
  for (const auto& [form, times] : forms) {
    SCOPED_TRACE(form + ", time points " + std::to_string(times));
    const auto all = dixon(times);
    const ScratchFolder folder;
    if (form == "enhanced") write_enhanced(folder / "dixon.dcm", all, {});
    for (std::size_t n = 0; n < all.size() && form != "enhanced"; ++n) {
      ExportImages images = all[n].second;
      const std::string name = "v" + std::to_string(n);
      if (form == "folders") {
        images.series = name;
        images.number = int(n) + 1;
      }
      write_slices(form == "folders" ? folder / name : folder / "all", name, "", all[n].first,
                   images, {});
    }
    expect_kinds(folder.path(), all);
  }
}

/// Three slices of derived images from that place on, mm along the axis.
void write_derived(const std::filesystem::path& folder, const std::string& type, double place) {
  ExportImages derived;
  derived.type = type;
  derived.first_instance = 500 + int(place);
  ShortVolume few = volume_of(300);
  few.grid.size[2] = 3;
  few.grid.origin.z() += place;
  few.voxels.resize(few.grid.voxels());
  write_slices(folder, type.substr(16, 3) + std::to_string(int(place)), "", few, derived, {});
}

// Projections and maps of a scan among its own images: at some of its places, and between them.
TEST(DicomContrasts, DerivedImagesDoNotDisturbTheScan) {
  const std::string projection = "DERIVED\\PRIMARY\\MAX_IP\\NONE",
                    map = "DERIVED\\PRIMARY\\FF\\NONE",
                    relaxation = "DERIVED\\PRIMARY\\R2_STAR\\NONE";
  const std::vector<std::vector<std::pair<std::string, double>>> cases = {
      {{projection, 0}}, {{projection, 1.7}}, {{map, 0}}, {{map, 0}, {relaxation, 40}}};
  for (const auto& beside : cases) {
    SCOPED_TRACE(beside.back().first + " at " + std::to_string(beside.back().second));
    const ShortVolume volume = volume_of(0);
    const ScratchFolder folder;
    write_slices(folder / "all", "a", "", volume, {}, {});
    for (const auto& [type, place] : beside) write_derived(folder / "all", type, place);
    VolumeSource source;
    const Volume<float> read = read_volume(folder.path(), {}, &source);
    EXPECT_TRUE(std::equal(read.voxels.begin(), read.voxels.end(), volume.voxels.begin(),
                           volume.voxels.end()));
    EXPECT_EQ(source.contrast, "T1");
  }
}

}  // namespace
}  // namespace breast
