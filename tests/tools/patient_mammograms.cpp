// SPDX-License-Identifier: GPL-3.0-or-later
// cc2mlo on a patient's mammograms: our own DICOM files, moved by a known similarity and sampled
// with other pixels, must be found where they are, and what does not fit is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "core/table.hpp"
#include "fixtures/chain_files.hpp"
#include "fixtures/dicom_elements.hpp"
#include "fixtures/moved_mammogram.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/derivative_file.hpp"
#include "io/mammogram_dicom.hpp"
#include "io/mammogram_file.hpp"
#include "matching/correspondence.hpp"
#include "matching/similarity.hpp"

using namespace breast;
namespace fs = std::filesystem;

namespace {

class PatientMammograms : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ScratchFolder;
    fixtures::write_chain(folder_->path());
    for (const std::string view : {"cc", "mlo"}) {  // a band asks for some derivative of the model
      const HexMesh mesh = read_mesh(file(view + ".vtkhdf"), {.contact = true});
      Derivatives derivatives;
      derivatives.position["fat"].assign(std::size_t(mesh.nodes()), Vec3(0, 0.5, 0));
      write_mesh(file(view + ".vtkhdf"), mesh, derivatives);
    }
    for (const std::string view : {"cc", "mlo"}) {
      const ToolResult result =
          run("project-mammogram", {view + ".vtkhdf", view + ".vti", "--pixel", "0.25", "--labels",
                                    "labels.vtkhdf", "--energy", "W/Rh:28"});
      ASSERT_EQ(result.exit_code, 0) << result.err;
      const Mammogram image = read_mammogram(file(view + ".vti"));
      const Mammogram real = fixtures::moved(image, map(view), pixel(view), int(145 / pixel(view)),
                                             int(190 / pixel(view)));
      const HexMesh mesh = read_mesh(file(view + ".vtkhdf"));
      write_mammogram_dicom(file(view + ".dcm"), real, {true, mesh.contact->thickness_mm, 90, {}});
      Mammogram magnified = real;
      magnified.pixel *= 1.8;
      write_mammogram_dicom(file(view + "-magnified.dcm"), magnified, {true, {}, {}, {}});
      write_text(file(view + "-magnified.dcm"),
                 fixtures::with_elements(read_text(file(view + "-magnified.dcm")),
                                         DatasetBuilder().number(0x00181114, 1.8)));
    }
  }
  static void TearDownTestSuite() { delete folder_; }
  static ToolResult run(const std::string& tool, const std::vector<std::string>& arguments) {
    return run_tool(tool, arguments, folder_->path());
  }
  static fs::path file(const std::string& name) { return *folder_ / name; }
  /// The known misalignment, about the image's origin.
  static Similarity map(const std::string& view) {
    return view == "cc" ? Similarity{1.02, 3, Vec2(4, 12)} : Similarity{0.985, -2.5, Vec2(-3, 18)};
  }
  static double pixel(const std::string& view) { return view == "cc" ? 0.2 : 0.3; }
  /// Pixel of a simulated place in the moved image; our DICOM of a left breast is not flipped.
  static Vec2 true_pixel(const std::string& view, const Vec2& uv) {
    return map(view).apply(uv) / pixel(view);
  }

  static inline ScratchFolder* folder_ = nullptr;
};

std::string pair_of(const Vec2& at) {
  return format_number(at.x()) + "," + format_number(at.y());
}

}  // namespace

TEST_F(PatientMammograms, AKnownMisalignmentIsFoundAndTheCurveLiesWhereItBelongs) {
  const HexMesh cc = read_mesh(file("cc.vtkhdf"), {.contact = true}),
                mlo = read_mesh(file("mlo.vtkhdf"), {.contact = true});
  const Matcher matcher(cc, mlo);
  const Vec2 tumour = *matcher.from_landmark("tumour");
  const ToolResult result =
      run("cc2mlo", {"cc.vtkhdf",     "mlo.vtkhdf",  "curve.vtp",
                     "--cc-image",    "cc.dcm",      "--mlo-image",
                     "mlo.dcm",       "--point",     pair_of(true_pixel("cc", tumour)),
                     "--band",        "--picture",   "where.png",
                     "--curve-table", "where.tsv",   "--report",
                     "where.json",    "--cc-hung",   "cc-hung.png",
                     "--mlo-hung",    "mlo-hung.png"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Report report = Report::parse(read_text(file("where.json")), "where.json");
  for (const std::string view : {"cc", "mlo"}) {
    const std::string key = "aligned/" + std::string(view == "cc" ? "CC" : "MLO") + "/";
    EXPECT_NEAR(report.number(key + "scale"), map(view).scale, 0.006) << view;
    EXPECT_NEAR(report.number(key + "rotation_deg"), map(view).rotation_deg, 0.3) << view;
    EXPECT_LT(report.number(key + "residual_mm"), 0.2) << view;
    EXPECT_LT(report.number(key + "pose_mm"), 0.3) << view;
    EXPECT_NEAR(report.number(key + "hung/pixel_mm"), pixel(view), 1e-9) << view;
    // The header of a PNG states its width in bytes 16 to 19.
    const std::string png = read_text(file(view + "-hung.png")).substr(16, 4);
    int width = 0;
    for (const char byte : png) width = 256 * width + static_cast<unsigned char>(byte);
    EXPECT_EQ(width, int(145 / pixel(view))) << view;
  }
  // Every point of the curve in pixels against the truth's: the simulated curve of the true point,
  // carried by the known similarity.
  const MatchedCurve truth = matcher.match(tumour, 0.001);
  MatchedCurve seen = truth;
  for (ColumnPoint& point : seen.points) {
    point.to_uv = pixel("mlo") * true_pixel("mlo", point.to_uv);
  }
  const Table table = read_table(file("where.tsv"));
  const int x = table.column("mlo_x_px"), y = table.column("mlo_y_px");
  const int deviation = table.column("deviation_mm");
  ASSERT_GE(table.rows.size(), 64u);
  for (const auto& row : table.rows) {
    const Vec2 at(parse_number(row[std::size_t(x)], "x"), parse_number(row[std::size_t(y)], "y"));
    EXPECT_LT(distance_to_curve(seen, pixel("mlo") * at), 0.5);
    EXPECT_GT(parse_number(row[std::size_t(deviation)], "deviation"), 0);
  }
  // The residual is in the band.
  EXPECT_NEAR(
      report.number("band/deviation_mm/alignment in MLO"),
      std::hypot(report.number("aligned/MLO/residual_mm"), report.number("aligned/MLO/pose_mm")),
      1e-9);
  EXPECT_GT(report.number("band/deviation_mm/alignment in CC"), 0);
}

// Its pixels are 1.8 times as large at the detector, and the same in the breast.
TEST_F(PatientMammograms, AMagnifiedImageIsRegisteredAtItsOwnScale) {
  const ToolResult result =
      run("cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "curve.vtp", "--cc-image", "cc-magnified.dcm",
                     "--mlo-image", "mlo.dcm", "--point", "200,300", "--report", "magnified.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Report report = Report::parse(read_text(file("magnified.json")), "magnified.json");
  EXPECT_NEAR(report.number("aligned/CC/scale"), map("cc").scale, 0.006);
  EXPECT_LT(report.number("aligned/CC/residual_mm"), 0.2);
  EXPECT_NEAR(report.number("aligned/CC/header/magnification"), 1.8, 1e-9);
}

TEST_F(PatientMammograms, APairOfPixelsGivesTheSpot) {
  const HexMesh cc = read_mesh(file("cc.vtkhdf"), {.contact = true}),
                mlo = read_mesh(file("mlo.vtkhdf"), {.contact = true});
  const Matcher matcher(cc, mlo);
  const ToolResult result =
      run("cc2mlo", {"mlo.vtkhdf", "cc.vtkhdf", "pair.vtp", "--cc-image", "cc.dcm", "--mlo-image",
                     "mlo.dcm", "--pair",
                     pair_of(true_pixel("mlo", *matcher.to_landmark("tumour"))) + "," +
                         pair_of(true_pixel("cc", *matcher.from_landmark("tumour"))),
                     "--cc-nipple", pair_of(true_pixel("cc", *matcher.from_landmark("nipple"))),
                     "--mlo-nipple", pair_of(true_pixel("mlo", *matcher.to_landmark("nipple"))),
                     "--report", "pair.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Report report = Report::parse(read_text(file("pair.json")), "pair.json");
  EXPECT_LT(report.number("spot/residual_mm"), 0.5);
  EXPECT_LT(report.number("aligned/CC/nipple_mm"), 0.5);
}

TEST_F(PatientMammograms, ImagesThatDoNotFitAreRefused) {
  using namespace std::string_literals;
  const auto changed = [&](const std::string& name, const std::string& from,
                           const std::string& to) {
    std::string bytes = read_text(file("cc.dcm"));
    const auto at = bytes.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    bytes.replace(at, from.size(), to);
    write_text(file(name), bytes);
  };
  changed("side.dcm", "\x20\0\x62\0CS\2\0L"s, "\x20\0\x62\0CS\2\0R"s);
  changed("spacing.dcm", "\x18\0\x64\x11"s, "\x18\0\x66\x11"s);
  changed("turned.dcm", "CS\4\0A\\R "s, "CS\4\0R\\A "s);
  Mammogram dark = read_mammogram(file("cc.vti"));
  std::fill(dark.path.begin(), dark.path.end(), 0);
  std::fill(dark.thickness.begin(), dark.thickness.end(), 0);
  dark.path[0] = dark.thickness[0] = 1;
  write_mammogram_dicom(file("dark.dcm"), dark, {});
  const auto refused = [&](const std::string& cc_image, const std::string& mlo_image,
                           const char* says) {
    const ToolResult result =
        run("cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "no.vtp", "--cc-image", cc_image, "--mlo-image",
                       mlo_image, "--point", "200,300", "--picture", "no.png"});
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_EQ(result.error_lines(), 1) << result.err;
    EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(file("no.vtp")) || fs::exists(file("no.png")));
  };
  refused("side.dcm", "mlo.dcm", "right");
  refused("mlo.dcm", "cc.dcm", "shows MLO");
  refused("spacing.dcm", "mlo.dcm", "pixel spacing is missing");
  refused("turned.dcm", "mlo.dcm", "orientation");
  refused("dark.dcm", "mlo.dcm", "no breast");
  refused("cc.vti", "mlo.dcm", "not a DICOM file");
  const ToolResult alone = run("cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "no.vtp", "--cc-image",
                                          "cc.dcm", "--point", "200,300"});
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_EQ(alone.error_lines(), 1) << alone.err;
}
