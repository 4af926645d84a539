// SPDX-License-Identifier: GPL-3.0-or-later
// render as a user runs it: every figure, with and without DISPLAY, several at a
// time, nothing left behind.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <csignal>
#include <cstdlib>
#include <functional>
#include <thread>

#include "core/atomic_file.hpp"
#include "fixtures/chain_files.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/mesh_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"

using namespace breast;
namespace fs = std::filesystem;

namespace {

class Render : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ScratchFolder;
    fixtures::write_chain(folder_->path());
    TriMesh points;
    for (int i = 0; i < 60; ++i) {
      points.points.push_back(Vec3(30 * std::cos(i), i, 30 * std::sin(i)));
      points.point_data["surface"].push_back(i % 2);
    }
    write_surface(*folder_ / "points.vtp", points);
    // A scan of the same grid: bright fat, darker gland.
    const LabelVolume labels = fixtures::analytic_labels();
    Volume<std::int16_t> scan(labels.grid);
    for (std::size_t n = 0; n < scan.voxels.size(); ++n) {
      scan.voxels[n] = labels.fibroglandular_fraction[n] > 0.5f ? 300 : 900;
    }
    write_volume(*folder_ / "scan.nrrd", scan);
    for (const char* view : {"cc", "mlo"}) {
      const std::string name = view;
      run("project-mammogram", {name + ".vtkhdf", name + ".vti", "--pixel", "1"});
    }
    run("cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "curve.vtp", "--landmark", "tumour"});
  }
  static void TearDownTestSuite() { delete folder_; }
  static ToolResult run(const std::string& tool, const std::vector<std::string>& arguments) {
    return run_tool(tool, arguments, folder_->path());
  }
  static fs::path file(const std::string& name) { return *folder_ / name; }
  static const fs::path& folder() { return folder_->path(); }

 private:
  static inline ScratchFolder* folder_ = nullptr;
};

// X servers whose parent is (or was) this test or a child of it: those started by our renders.
int servers_of(pid_t parent) {
  int count = 0;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    std::ifstream stat(entry.path() / "stat");
    std::string id, name, state;
    pid_t owner = 0;
    if (stat >> id >> name >> state >> owner) count += name == "(Xvfb)" && owner == parent;
  }
  return count;
}

/// Pixels of the picture's part between the two fractions of its width that satisfy `wanted` (r, g, b).
int pixels_where(const fs::path& file, double left, double right,
                 const std::function<bool(int, int, int)>& wanted) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  const int* size = image->GetDimensions();
  int count = 0;
  for (int y = 0; y < size[1]; ++y) {
    for (int x = int(left * size[0]); x < int(right * size[0]); ++x) {
      const auto* p = static_cast<const unsigned char*>(image->GetScalarPointer(x, y, 0));
      count += wanted(p[0], p[1], p[2]);
    }
  }
  return count;
}

bool is_tumour_yellow(int r, int g, int b) {
  return r > 150 && g > 0.65 * r && b < 0.45 * r;
}
bool is_curve_green(int r, int g, int b) {
  return g > 150 && r < 0.5 * g && b < 0.7 * g;
}

bool is_png(const fs::path& file) {
  return fs::exists(file) && read_text(file).substr(1, 3) == "PNG";
}

}  // namespace

TEST_F(Render, EveryFigureIsDrawn) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> figures = {
      {"slices", {"mesh.vtkhdf", "--scan", "scan.nrrd", "--labels", "labels.vtkhdf"}},
      {"points", {"points.vtp"}},
      {"geometry", {"geometry.vtkhdf"}},
      {"mesh", {"mesh.vtkhdf"}},
      {"tissues", {"mesh.vtkhdf"}},
      {"outlines", {"reference.vtkhdf", "supine.vtkhdf"}},
      {"compression", {"cc.vtkhdf", "mlo.vtkhdf"}},
      {"pressure", {"cc.vtkhdf", "mlo.vtkhdf"}},
      {"force-thickness", {"cc.vtkhdf", "mlo.vtkhdf"}},
      {"mammogram", {"cc.vti", "mlo.vti", "curve.vtp"}},
      {"matching", {"cc.vtkhdf", "mlo.vtkhdf", "curve.vtp"}},
      {"matching", {"mlo.vtkhdf", "curve.vtp"}},
      {"summary",
       {"mesh.vtkhdf", "reference.vtkhdf", "supine.vtkhdf", "cc.vtkhdf", "mlo.vtkhdf", "cc.vti",
        "mlo.vti", "curve.vtp", "--scan", "scan.nrrd", "--labels", "labels.vtkhdf"}},
      {"summary",  // a case without a tumour has no curve
       {"mesh.vtkhdf", "reference.vtkhdf", "supine.vtkhdf", "cc.vtkhdf", "mlo.vtkhdf", "cc.vti",
        "mlo.vti"}}};
  for (const auto& [name, inputs] : figures) {
    std::vector<std::string> arguments = inputs;
    arguments.insert(arguments.end(), {"--figure", name, "-o", name + ".png"});
    const ToolResult result = run("render", arguments);
    EXPECT_EQ(result.exit_code, 0) << name << ": " << result.err;
    ASSERT_TRUE(is_png(file(name + ".png"))) << name;
    EXPECT_GT(fs::file_size(file(name + ".png")), 20000u) << name << " is all but empty";
  }
}

// The fixture's tumour lies inside its gland: what the captions promise is seen all the same.
TEST_F(Render, TheTumourIsSeenThroughSkinAndGland) {
  ASSERT_EQ(run("render", {"mesh.vtkhdf", "--figure", "tissues", "-o", "seen.png"}).exit_code, 0);
  // A ball of 8 mm at about 0.25 mm a pixel covers 800.
  EXPECT_GT(pixels_where(file("seen.png"), 0, 0.5, is_tumour_yellow), 300);
  EXPECT_GT(pixels_where(file("seen.png"), 0.5, 1, is_tumour_yellow), 300);
  ASSERT_EQ(run("render", {"cc.vtkhdf", "mlo.vtkhdf", "curve.vtp", "--figure", "matching", "-o",
                           "column.png"})
                .exit_code,
            0);
  for (int k = 0; k < 3; ++k) {
    EXPECT_GT(pixels_where(file("column.png"), k / 3.0, (k + 1) / 3.0, is_tumour_yellow), 100) << k;
  }
  // Without a tumour there is nothing yellow to be seen.
  HexMesh none = read_mesh(file("mesh.vtkhdf"));
  std::erase_if(none.landmarks, [](const Landmark& landmark) { return landmark.name == "tumour"; });
  none.tumour_node = -1;
  write_mesh(file("none.vtkhdf"), none);
  ASSERT_EQ(run("render", {"none.vtkhdf", "--figure", "tissues", "-o", "none.png"}).exit_code, 0);
  EXPECT_EQ(pixels_where(file("none.png"), 0, 1, is_tumour_yellow), 0);
}

TEST_F(Render, MarksAreRingsThatHideNothing) {
  ASSERT_EQ(
      run("render", {"cc.vti", "curve.vtp", "--figure", "mammogram", "-o", "ring.png"}).exit_code,
      0);
  // The circumference of 13 pixels' radius by 2.6; a filled mark would have 530.
  const int ring = pixels_where(file("ring.png"), 0, 1, is_tumour_yellow);
  EXPECT_GT(ring, 120);
  EXPECT_LT(ring, 350);
  ASSERT_EQ(
      run("render", {"mlo.vti", "curve.vtp", "--figure", "mammogram", "-o", "curve.png"}).exit_code,
      0);
  EXPECT_GT(pixels_where(file("curve.png"), 0, 1, is_curve_green), 200);
}

TEST_F(Render, SlicesNeedScanAndLabelsOfOneBreast) {
  const ToolResult result = run("render", {"mesh.vtkhdf", "--figure", "slices", "-o", "no.png"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("--scan"), std::string::npos) << result.err;
  EXPECT_EQ(run("render", {"mesh.vtkhdf", "--figure", "slices", "--scan", "scan.nrrd", "-o", "no.png"})
                .exit_code,
            2);
  ASSERT_EQ(run("render", {"mesh.vtkhdf", "--figure", "slices", "--scan", "scan.nrrd", "--labels",
                           "labels.vtkhdf", "-o", "planes.png"})
                .exit_code,
            0);
  // The tumour's ring stands in each of the three planes.
  for (int k = 0; k < 3; ++k) {
    EXPECT_GT(pixels_where(file("planes.png"), k / 3.0, (k + 1) / 3.0, is_tumour_yellow), 100) << k;
  }
}

TEST_F(Render, DisplayMakesNoDifference) {
  const char* before = std::getenv("DISPLAY");
  const std::string kept = before != nullptr ? before : "";
  setenv("DISPLAY", ":987", 1);  // nobody there
  ASSERT_EQ(run("render", {"mesh.vtkhdf", "-o", "a.png"}).exit_code, 0);
  unsetenv("DISPLAY");
  ASSERT_EQ(run("render", {"mesh.vtkhdf", "-o", "b.png"}).exit_code, 0);
  if (before != nullptr) setenv("DISPLAY", kept.c_str(), 1);
  EXPECT_EQ(read_text(file("a.png")), read_text(file("b.png")));
}

TEST_F(Render, TwoAtATimeGiveTheSamePicture) {
  ScratchFolder other;
  fs::copy_file(file("mesh.vtkhdf"), other / "mesh.vtkhdf");
  ToolResult second;
  std::thread beside([&] {
    second = run_tool("render", {"mesh.vtkhdf", "-o", "c.png"}, other.path());
  });
  const ToolResult first = run("render", {"mesh.vtkhdf", "-o", "c.png"});
  beside.join();
  ASSERT_EQ(first.exit_code, 0) << first.err;
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(read_text(file("c.png")), read_text(other / "c.png"));
}

TEST_F(Render, AKilledRenderLeavesNoServerAndNoPicture) {
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(folder().c_str()) == 0) {
      execl(tool_path("render").c_str(), "render", "cc.vtkhdf", "mlo.vtkhdf", "--figure",
            "compression", "-o", "killed.png", "--quiet", static_cast<char*>(nullptr));
    }
    _exit(127);
  }
  for (int wait = 0; wait < 500 && servers_of(child) == 0; ++wait) usleep(20000);
  ASSERT_EQ(servers_of(child), 1);
  pid_t server = 0;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::ifstream stat(entry.path() / "stat");
    std::string name, state;
    pid_t id = 0, owner = 0;
    if (stat >> id >> name >> state >> owner && name == "(Xvfb)" && owner == child) server = id;
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  bool gone = false;
  for (int wait = 0; wait < 500 && !gone; ++wait) {
    usleep(20000);
    // A zombie waits for its reaper only: it serves nobody any more.
    std::ifstream stat("/proc/" + std::to_string(server) + "/stat");
    std::string id, name, state;
    gone = !(stat >> id >> name >> state) || state == "Z";
  }
  EXPECT_TRUE(gone);
  EXPECT_FALSE(fs::exists(file("killed.png")));
}

TEST_F(Render, MissingServerIsSaidWithThePackages) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const ToolResult result = run("render", {"mesh.vtkhdf", "-o", "no.png"});
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.error_lines(), 1) << result.err;
  EXPECT_NE(result.err.find("xvfb xauth libgl1-mesa-dri"), std::string::npos) << result.err;
}

TEST_F(Render, APictureIsOfOneBreastExceptForOutlines) {
  HexMesh other = read_mesh(file("mlo.vtkhdf"), {.contact = true});
  other.side = other.geometry->side = other.side == Side::left ? Side::right : Side::left;
  write_mesh(file("other.vtkhdf"), other);
  const ToolResult mixed =
      run("render", {"cc.vtkhdf", "other.vtkhdf", "--figure", "compression", "-o", "no.png"});
  EXPECT_EQ(mixed.exit_code, 2);
  EXPECT_NE(mixed.err.find("give files that belong together"), std::string::npos) << mixed.err;
  EXPECT_FALSE(fs::exists(file("no.png")));
  const ToolResult outlines =
      run("render", {"cc.vtkhdf", "other.vtkhdf", "--figure", "outlines", "-o", "both.png"});
  EXPECT_EQ(outlines.exit_code, 0) << outlines.err;
}

TEST_F(Render, MissingInputsAreNamed) {
  const ToolResult result =
      run("render", {"mesh.vtkhdf", "curve.vtp", "--figure", "matching", "-o", "no.png"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("compressed"), std::string::npos) << result.err;
  EXPECT_EQ(run("render", {"mesh.vtkhdf", "--figure", "heatmap", "-o", "no.png"}).exit_code, 2);
  EXPECT_EQ(run("render", {"mesh.vtkhdf", "--figure", "compression", "-o", "no.png"}).exit_code, 2);
  EXPECT_FALSE(fs::exists(file("no.png")));
}
