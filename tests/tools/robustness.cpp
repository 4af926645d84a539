// SPDX-License-Identifier: GPL-3.0-or-later
// Damaged input never crashes a tool nor leaves an output: exit 2 and one line that names the file.
// A new tool adds one line a file it reads to `readings` below.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <random>
#include <set>
#include <sstream>

#include "core/atomic_file.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/samples.hpp"
#include "fixtures/scratch_folder.hpp"
#include "fixtures/words.hpp"
#include "io/geometry_file.hpp"
#include "io/label_file.hpp"
#include "io/mammogram_file.hpp"
#include "io/mesh_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;

constexpr int truncations = 20;
constexpr int nan_places = 6;

/// A tool reading one damaged file: `bad` is its name among the samples, `line` the arguments.
struct Reading {
  const char *tool, *bad, *line;
};
const Reading readings[] = {
    {"segment", "scan.nrrd", "scan.nrrd out.vtkhdf --side left"},
    {"fit-hermite", "labels.vtkhdf", "labels.vtkhdf out.vtkhdf"},
    {"hexmesh", "geometry.vtkhdf", "geometry.vtkhdf labels.vtkhdf out.vtkhdf --accept-mismatch"},
    {"hexmesh", "labels.vtkhdf", "geometry.vtkhdf labels.vtkhdf out.vtkhdf --accept-mismatch"},
    {"backward", "mesh.vtkhdf", "mesh.vtkhdf out.vtkhdf"},
    {"forward", "mesh.vtkhdf", "mesh.vtkhdf out.vtkhdf"},
    {"compress", "mesh.vtkhdf", "mesh.vtkhdf out.vtkhdf --view CC --reduction 30"},
    {"project-mammogram", "mesh.vtkhdf", "mesh.vtkhdf out.vti"},
    {"project-mammogram", "labels.vtkhdf", "mesh.vtkhdf out.vti --labels labels.vtkhdf"},
    {"cc2mlo", "cc.vtkhdf", "cc.vtkhdf mesh.vtkhdf out.vtp --landmark tumour"},
    {"cc2mlo", "mesh.vtkhdf", "cc.vtkhdf mesh.vtkhdf out.vtp --landmark tumour"},
    {"probe", "mesh.vtkhdf", "mesh.vtkhdf"},
    {"probe", "cc.vtkhdf", "mesh.vtkhdf --base cc.vtkhdf"},
    {"evaluate", "labels.vtkhdf", "labels.vtkhdf truth.nrrd"},
    {"evaluate", "truth.nrrd", "labels.vtkhdf truth.nrrd"},
    {"evaluate", "surface.vtp", "labels.vtkhdf surface.vtp"},
    {"render", "mesh.vtkhdf", "mesh.vtkhdf --figure mesh -o out.png"},
    {"render", "cc.vti", "cc.vti curve.vtp --figure mammogram -o out.png"},
    {"render", "curve.vtp", "cc.vti curve.vtp --figure mammogram -o out.png"},
};

std::vector<Reading> built() {
  std::vector<Reading> list;
  for (const Reading& reading : readings) {
    if (fs::exists(tool_path(reading.tool))) list.push_back(reading);
  }
  return list;
}

Mammogram mammogram() {
  Mammogram image;
  image.pose = view_pose(Side::left, 0);
  image.view = View::cc;
  image.width = 12;
  image.height = 10;
  image.path.resize(120);
  for (std::size_t n = 0; n < image.path.size(); ++n) image.path[n] = float(n * 31 % 50);
  image.thickness.assign(120, 50);
  image.fibroglandular = image.path;
  image.through_back.assign(120, 0);
  return image;
}

PolyLines curve() {
  PolyLines lines;
  lines.points = {{0, 0, 0}, {1, 0, 0.5}, {2, 0, 0.7}};
  lines.lines = {{0, 1, 2}};
  lines.line_names = {"curve"};
  lines.point_data["u_mm"] = {0, 1, 2};
  return lines;
}

void write_samples(const ScratchFolder& folder) {
  write_mesh(folder / "mesh.vtkhdf", samples::full_mesh());
  HexMesh cc = samples::full_mesh();
  cc.contact->view = View::cc;
  cc.contact->angle_deg = 0;
  write_mesh(folder / "cc.vtkhdf", cc);
  write_geometry(folder / "geometry.vtkhdf", samples::geometry());
  const LabelVolume labels = samples::labels();
  write_labels(folder / "labels.vtkhdf", labels);
  Volume<std::uint8_t> truth(labels.grid);
  truth.voxels = labels.tissue;
  write_volume(folder / "truth.nrrd", truth);
  Volume<std::int16_t> scan(labels.grid);
  for (std::size_t v = 0; v < scan.voxels.size(); ++v)
    scan.voxels[v] = std::int16_t(v * 7919 % 1000);
  write_volume(folder / "scan.nrrd", scan);
  TriMesh surface;
  surface.points = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}};
  surface.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}};
  write_surface(folder / "surface.vtp", surface);
  write_mammogram(folder / "cc.vti", mammogram());
  write_polylines(folder / "curve.vtp", curve());
}

std::set<std::string> listing(const ScratchFolder& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

class Damaged : public testing::TestWithParam<Reading> {
 protected:
  void SetUp() override {
    write_samples(folder_);
    before_ = listing(folder_);
  }
  // Exit 2, one line naming the damaged file, nothing on stdout, no new file.
  void expect_refusal(const std::string& damage) {
    const Reading& reading = GetParam();
    const ToolResult result = run_tool(reading.tool, words_of(reading.line), folder_.path());
    const std::string where = std::string(reading.tool) + ", " + damage + ": " + result.err;
    EXPECT_EQ(result.exit_code, 2) << where;
    EXPECT_EQ(result.error_lines(), 1) << where;
    EXPECT_NE(result.err.find(reading.bad), std::string::npos) << where;
    EXPECT_EQ(result.out, "") << where;
    EXPECT_EQ(listing(folder_), before_) << where;
  }
  ScratchFolder folder_;
  std::set<std::string> before_;
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Damaged);

TEST_P(Damaged, TruncatedAnywhere) {
  const fs::path bad = folder_ / GetParam().bad;
  const std::string good = read_text(bad);
  std::mt19937 random(20080301);
  for (int i = 0; i < truncations; ++i) {
    constexpr std::size_t harmless = 1;  // a text without its final newline is whole
    const std::size_t size = i < 3 ? good.size() - harmless - 1 - std::size_t(i) * 3
                                   : random() % (good.size() - harmless);
    write_text(bad, good.substr(0, size));
    expect_refusal("cut at byte " + std::to_string(size) + " of " + std::to_string(good.size()));
  }
}

std::string without_seal(const std::string& good, const fs::path& name) {
  if (name.extension() == ".vtkhdf") return good.substr(0, good.size() - 80);
  const auto seal = good.find("<!-- sha256");
  if (seal == std::string::npos) return good;
  return good.substr(0, seal) + good.substr(good.find("-->", seal) + 4);
}

// Damage that no seal tells of reaches the libraries; none of it may end a tool but in its own way.
TEST_P(Damaged, BytesFlippedBehindTheSeal) {
  const fs::path bad = folder_ / GetParam().bad;
  const std::string body = without_seal(read_text(bad), bad);
  const Reading& reading = GetParam();
  std::mt19937 random(20080304);
  constexpr int damages = 12;
  for (int i = 0; i < damages; ++i) {
    std::string damaged = body;
    damaged[random() % std::min<std::size_t>(body.size(), i % 2 ? 4000 : body.size())] ^=
        char(1 << random() % 8);
    write_text(bad, damaged);
    const ToolResult result = run_tool(reading.tool, words_of(reading.line), folder_.path());
    const std::string where =
        std::string(reading.tool) + ", damage " + std::to_string(i) + ": " + result.err;
    EXPECT_GE(result.exit_code, 0) << where;
    if (result.exit_code != 2) {  // harmless, or the sample is no case for this tool
      for (const auto& entry : fs::directory_iterator(folder_.path())) {
        if (!before_.contains(entry.path().filename().string())) fs::remove(entry.path());
      }
      continue;
    }
    EXPECT_EQ(result.error_lines(), 1) << where;
    EXPECT_EQ(listing(folder_), before_) << where;
  }
}

// Paths of the floating-point datasets of an HDF5 file.
std::vector<std::string> real_datasets(hid_t file) {
  std::vector<std::string> paths;
  const auto visit = [](hid_t object, const char* name, const H5O_info_t* info,
                        void* list) -> herr_t {
    if (info->type != H5O_TYPE_DATASET) return 0;
    const hid_t dataset = H5Dopen2(object, name, H5P_DEFAULT);
    const hid_t type = H5Dget_type(dataset), space = H5Dget_space(dataset);
    if (H5Tget_class(type) == H5T_FLOAT && H5Sget_simple_extent_npoints(space) > 0) {
      static_cast<std::vector<std::string>*>(list)->push_back(name);
    }
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(dataset);
    return 0;
  };
  H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, visit, &paths);
  return paths;
}

void write_nan(const fs::path& file, unsigned which, unsigned where) {
  const hid_t h5 = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(h5, 0);
  const std::vector<std::string> paths = real_datasets(h5);
  const hid_t dataset = H5Dopen2(h5, paths[which % paths.size()].c_str(), H5P_DEFAULT);
  const hid_t space = H5Dget_space(dataset);
  std::vector<double> values(std::size_t(H5Sget_simple_extent_npoints(space)));
  H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  values[where % values.size()] = where % 2 ? std::nan("") : HUGE_VAL;
  H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space);
  H5Dclose(dataset);
  H5Fclose(h5);
}

TEST_P(Damaged, NotANumber) {
  const fs::path bad = folder_ / GetParam().bad;
  if (bad.extension() != ".vtkhdf") {
    write_text(bad, "nan nan nan\n");
    return expect_refusal("nan as text");
  }
  const std::string good = read_text(bad);
  std::mt19937 random(1123);
  for (int i = 0; i < nan_places; ++i) {
    write_text(bad, good);
    write_nan(bad, unsigned(random()), unsigned(random()));
    expect_refusal("not finite, place " + std::to_string(i));
  }
}

TEST_P(Damaged, ForeignOrMissing) {
  const fs::path bad = folder_ / GetParam().bad;
  for (const std::string& content :
       {std::string(), std::string("not one of ours\n"), std::string(5000, '\0')}) {
    write_text(bad, content);
    expect_refusal("foreign content of " + std::to_string(content.size()) + " bytes");
  }
  fs::remove(bad);
  before_.erase(GetParam().bad);
  expect_refusal("missing");
}

std::string case_name(const Reading& reading, std::size_t index) {
  std::string name = std::string(reading.tool) + "_" + reading.bad + "_" + std::to_string(index);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); },
      '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Files, Damaged, testing::ValuesIn(built()), [](const auto& reading) {
  return case_name(reading.param, reading.index);
});

}  // namespace
}  // namespace breast
