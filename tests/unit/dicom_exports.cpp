// SPDX-License-Identifier: GPL-3.0-or-later
// Exports of archives with two peculiarities each: every one is read as the volume that it holds, or refused
// in words that say why.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "core/error.hpp"
#include "fixtures/dicom_export.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/volume_file.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;
using namespace fixtures;
using ShortVolume = Volume<std::int16_t>;
using Features = std::set<std::string>;

/// Of this many slices, large enough for a scan of a breast; sagittal ones run from right to left.
ShortVolume test_volume(bool sagittal, double x, int shift) {
  Grid grid = exported_grid();
  grid.spacing[2] = 5.02;
  if (sagittal) grid.origin = Vec3(x, -40, 60);
  if (sagittal) grid.direction << 0, 0, 1, 1, 0, 0, 0, -1, 0;
  if (sagittal) grid.direction.col(2) = grid.direction.col(0).cross(grid.direction.col(1));
  return numbered(grid, 1009, shift);
}

/// The peculiarity, and a word of the refusal if it cannot be read.
const std::map<std::string, std::string>& features() {
  static const std::map<std::string, std::string> all = {{"presentation state", ""},
                                                         {"report", ""},
                                                         {"time points", ""},
                                                         {"image types", ""},
                                                         {"rounded positions", ""},
                                                         {"enhanced", ""},
                                                         {"folders", ""},
                                                         {"no preamble", ""},
                                                         {"private kinds", ""},
                                                         {"trailing bytes", ""},
                                                         {"implicit", ""},
                                                         {"big-endian", ""},
                                                         {"deflated", ""},
                                                         {"JPEG", ""},
                                                         {"JPEG 2000", ""},
                                                         {"RLE", ""},
                                                         {"two slabs", ""},
                                                         {"localiser", ""},
                                                         {"small shear", ""},
                                                         {"T2 beside", ""},
                                                         {"sent twice", ""},
                                                         {"prior examination", "examinations"},
                                                         {"missing slice", "missing or duplicated"},
                                                         {"equal series", "equally good"}};
  return all;
}

const std::map<std::string, std::string>& syntaxes() {
  static const std::map<std::string, std::string> all = {{"implicit", implicit_little},
                                                         {"big-endian", explicit_big},
                                                         {"deflated", deflated},
                                                         {"JPEG", "1.2.840.10008.1.2.4.70"},
                                                         {"JPEG 2000", "1.2.840.10008.1.2.4.90"},
                                                         {"RLE", "1.2.840.10008.1.2.5"}};
  return all;
}

ExportForm form_of(const Features& with) {
  ExportForm form;
  for (const auto& [name, uid] : syntaxes())
    if (with.contains(name)) form.syntax = uid;
  form.preamble = !with.contains("no preamble");
  form.odd_private = with.contains("private kinds");
  form.trailing = with.contains("trailing bytes");
  return form;
}

ExportImages images_of(const Features& with) {
  ExportImages images;
  if (with.contains("rounded positions")) images.decimals = -1;
  if (with.contains("small shear")) images.drift = Vec3(0.002, 0.002, 0);
  return images;
}

/// The volumes that one series holds, with what is stated of each; the first is the one to be read.
std::vector<std::pair<ShortVolume, ExportImages>> series_of(const Features& with) {
  const bool sagittal = with.contains("two slabs");
  std::vector<std::pair<ShortVolume, ExportImages>> all;
  for (const int time : with.contains("time points") ? std::vector{1, 2} : std::vector{0}) {
    for (const std::string& type : with.contains("image types")
                                       ? std::vector<std::string>{"M\\ND", "P\\ND"}
                                       : std::vector<std::string>{"M\\ND"}) {
      for (const double x : sagittal ? std::vector<double>{30, -110} : std::vector<double>{0}) {
        ExportImages images = images_of(with);
        images.time = time;
        images.type = "ORIGINAL\\PRIMARY\\" + type;
        images.first_instance = 1 + int(all.size()) * 100;
        all.emplace_back(test_volume(sagittal, x, 10 * int(all.size())), images);
      }
    }
  }
  return all;
}

void write_without(const Features& with, const fs::path& folder, const std::string& ending,
                   const ExportForm& form, const std::string& sending = "") {
  auto all = series_of(with);
  for (auto& [volume, images] : all) images.sending = sending;
  if (with.contains("enhanced")) {
    write_enhanced(folder / ("enhanced" + ending), all, form);
    return;
  }
  for (std::size_t n = 0; n < all.size(); ++n)
    write_slices(folder, "v" + std::to_string(n) + "_", ending, all[n].first, all[n].second, form);
  if (with.contains("missing slice")) {
    char number[16];
    std::snprintf(number, sizeof number, "%03d", 7 * 6);  // the seventh
    for (std::size_t n = 0; n < all.size(); ++n)
      fs::remove(folder / ("v" + std::to_string(n) + "_" + number + ending));
  }
}

ShortVolume written(const Features& with, const fs::path& folder) {
  const ExportForm form = form_of(with);
  const fs::path deep = with.contains("folders") ? folder / "A1/B 2" : folder;
  const std::string ending = with.contains("folders") ? "" : ".dcm";
  write_without(with, deep, ending, form);
  if (with.contains("sent twice")) {
    ExportForm again = form;  // another node of the archive stores it otherwise
    if (again.syntax == explicit_little && !again.odd_private) again.syntax = implicit_little;
    write_without(with, deep / "again", ending, again, "2");
  }
  if (with.contains("presentation state"))
    write_without_pixels(folder / ("ps" + ending), "1.2.840.10008.5.1.4.1.1.11.1", form);
  if (with.contains("report"))
    write_without_pixels(folder / ("sr" + ending), "1.2.840.10008.5.1.4.1.1.88.22", form);
  const auto beside = [&](const char* name, const std::function<void(ExportImages&)>& change,
                          int slices) {
    ShortVolume volume = test_volume(with.contains("two slabs"), 30, 500);
    volume.grid.size[2] = slices;
    volume.voxels.resize(volume.grid.voxels());
    ExportImages images = images_of(with);
    images.series = name;
    images.number = 2;
    change(images);
    write_slices(deep / name, name, ending, volume, images, form);
  };
  if (with.contains("localiser"))
    beside(
        "loc", [](ExportImages& i) { i.type = "ORIGINAL\\PRIMARY\\LOCALIZER"; }, 3);
  if (with.contains("T2 beside"))
    beside(
        "t2", [](ExportImages& i) { i.echo_ms = 90; }, 16);
  if (with.contains("prior examination"))
    beside(
        "prior", [](ExportImages& i) { i.study = "2.25.2"; }, 16);
  if (with.contains("equal series"))
    beside(
        "same", [](ExportImages&) {}, 16);
  return series_of(with).front().first;
}

bool compatible(const std::string& a, const std::string& b) {
  if (syntaxes().contains(a) && syntaxes().contains(b)) return false;
  const auto both = [&](const char* x, const char* y) {
    return (a == x && b == y) || (a == y && b == x);
  };
  return !both("enhanced", "missing slice") && !both("implicit", "private kinds") &&
         !both("sent twice", "missing slice");  // the second sending fills the gap
}

/// "read", or the refusal without the folder's name.
std::string outcome(const fs::path& folder, const ShortVolume& expected, const Features& with) {
  try {
    VolumeSource source;
    const Volume<float> read = read_volume(folder, ScanChoice(0, Side::left), &source);
    const bool gap_named =
        std::any_of(source.remarks.begin(), source.remarks.end(), [](const std::string& text) {
          return text.find("missing or duplicated") != std::string::npos;
        });
    if (gap_named) return "read, with the gap named";
    EXPECT_EQ(read.grid.size, expected.grid.size);
    const double tolerance = with.contains("rounded positions") ? 0.06 : 1e-3;
    EXPECT_LT((read.grid.origin - expected.grid.origin).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_LT((read.grid.direction - expected.grid.direction).cwiseAbs().maxCoeff(), 2e-3);
    EXPECT_TRUE(std::equal(read.voxels.begin(), read.voxels.end(), expected.voxels.begin(),
                           expected.voxels.end()));
    for (const char* kind :
         {"presentation state", "report", "localiser", "copy of another image"}) {
      const bool said = std::any_of(
          source.remarks.begin(), source.remarks.end(),
          [&](const std::string& text) { return text.find(kind) != std::string::npos; });
      const bool there =
          with.contains(kind == std::string("copy of another image") ? "sent twice" : kind);
      EXPECT_EQ(said, there) << kind << ": passed over without a word";
    }
    return "read";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(DicomExports, EveryTwoPeculiaritiesAreReadOrRefusedByName) {
  int count = 0;
  std::map<std::string, int> table;
  for (auto a = features().begin(); a != features().end(); ++a) {
    for (auto b = std::next(a); b != features().end(); ++b) {
      if (!compatible(a->first, b->first)) continue;
      const ScratchFolder folder;
      const Features with{a->first, b->first};
      const ShortVolume expected = written(with, folder / "export");
      SCOPED_TRACE(a->first + " and " + b->first);
      const std::string says = outcome(folder / "export", expected, with);
      ++count;
      EXPECT_EQ(says.find("damaged"), std::string::npos) << says;
      if (a->second.empty() && b->second.empty()) {
        EXPECT_EQ(says, "read");
        ++table["read"];
        continue;
      }
      // A whole series beside one with a gap is taken, and the gap is named.
      if (with.contains("missing slice") && says == "read, with the gap named") {
        ++table[says];
        continue;
      }
      const bool named = (!a->second.empty() && says.find(a->second) != std::string::npos) ||
                         (!b->second.empty() && says.find(b->second) != std::string::npos);
      EXPECT_TRUE(named) << says;
      ++table[named ? "refused by name" : says];
    }
  }
  EXPECT_GE(count, 200);
  for (const auto& [what, times] : table) std::printf("%4d  %s\n", times, what.c_str());
}

}  // namespace
}  // namespace breast
