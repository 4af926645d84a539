// SPDX-License-Identifier: GPL-3.0-or-later
// Mammograms as DICOM: they read back as written, pass a standard validator, and what does not fit
// is refused by name.
#include <gtest/gtest.h>

#include <fstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "fixtures/chain_files.hpp"
#include "fixtures/dicom_elements.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/dicom/like_mammogram.hpp"
#include "io/dicom/mammogram_header.hpp"
#include "io/dicom/mammogram_view.hpp"
#include "io/mammogram_dicom.hpp"
#include "io/mammogram_file.hpp"
#include "projection/display.hpp"

using namespace breast;
namespace fs = std::filesystem;

namespace {

class MammogramDicomFile : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ScratchFolder;
    fixtures::write_chain(folder_->path());
    for (const std::string view : {"cc", "mlo"}) {
      const ToolResult result =
          run_tool("project-mammogram",
                   {view + ".vtkhdf", view + ".vti", "--labels", "labels.vtkhdf", "--pixel", "0.5",
                    "--energy", "W/Rh:28", "--dicom", view + ".dcm"},
                   folder_->path());
      ASSERT_EQ(result.exit_code, 0) << result.err;
    }
  }
  static void TearDownTestSuite() { delete folder_; }
  static fs::path file(const std::string& name) { return *folder_ / name; }
  /// The file with the first occurrence of a text replaced by one of the same length.
  static fs::path changed(const std::string& name, const std::string& from, const std::string& to) {
    std::string bytes = read_text(file("mlo.dcm"));
    const auto at = bytes.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    EXPECT_EQ(from.size(), to.size());
    bytes.replace(at, from.size(), to);
    write_text(file(name), bytes);
    return file(name);
  }

  static inline ScratchFolder* folder_ = nullptr;
};

std::string refusal(const fs::path& file) {
  try {
    read_mammogram_header(file);
  } catch (const Error& error) {
    return error.kind() == ErrorKind::input ? error.what() : "";
  }
  return "";
}

}  // namespace

TEST_F(MammogramDicomFile, GeometryAndGreysReadBack) {
  for (const std::string view : {"cc", "mlo"}) {
    const Mammogram image = read_mammogram(file(view + ".vti"));
    const HexMesh mesh = read_mesh(file(view + ".vtkhdf"));
    const MammogramScan scan = read_mammogram_dicom(file(view + ".dcm"));
    const MammogramHeader& header = scan.header;
    EXPECT_EQ(header.view, image.view);
    EXPECT_EQ(header.side, image.side);
    EXPECT_EQ(header.columns, image.width);
    EXPECT_EQ(header.rows, image.height);
    EXPECT_DOUBLE_EQ(header.pixel_mm, 0.5);
    EXPECT_NEAR(*header.angle_deg, image.pose.angle_deg, 1e-9);
    EXPECT_NEAR(*header.thickness_mm, mesh.contact->thickness_mm, 1e-6);
    EXPECT_FALSE(header.force_N);  // 0 N, which no plate presses with
    EXPECT_EQ(header.magnification, 1);
    // Axes as a radiologist hangs the image.
    const double way = image.side == Side::left ? 1 : -1;
    EXPECT_GT(way * header.right.dot(image.pose.e_u), 0.9);
    EXPECT_GT(way * header.down.dot(image.pose.e_v), 0.9);
    const HungImage hung = hang(image);
    const auto [low, high] = std::minmax_element(hung.grey.begin(), hung.grey.end());
    for (std::size_t i = 0; i < hung.grey.size(); i += 17) {
      ASSERT_NEAR(scan.grey[i], double(hung.grey[i] - *low) / double(*high - *low), 1e-6);
    }
  }
}

TEST_F(MammogramDicomFile, PassesTheValidator) {
  // dciodvfy, of the Debian package dicom3tools, is the usual judge of DICOM conformance.
  ASSERT_EQ(run_tool("project-mammogram",
                     {"cc.vtkhdf", "raw.vti", "--pixel", "0.5", "--energy", "Mo/Mo:28", "--dicom",
                      "raw.dcm", "--dicom-for", "processing", "--geometry", "cone"},
                     folder_->path())
                .exit_code,
            0);
  for (const char* name : {"cc.dcm", "mlo.dcm", "raw.dcm"}) {
    const std::string log = file("verdict.txt").string();
    const std::string command = "dciodvfy '" + file(name).string() + "' > '" + log + "' 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    const std::string verdict = read_text(log);
    EXPECT_NE(verdict.find("MammographyImage"), std::string::npos) << verdict;
    EXPECT_EQ(verdict.find("Error"), std::string::npos) << verdict;
  }
}

TEST_F(MammogramDicomFile, TheSameImageGivesTheSameFile) {
  const Mammogram image = read_mammogram(file("cc.vti"));
  write_mammogram_dicom(file("one.dcm"), image, {});
  write_mammogram_dicom(file("two.dcm"), image, {});
  EXPECT_EQ(read_text(file("one.dcm")), read_text(file("two.dcm")));
}

TEST_F(MammogramDicomFile, HeadersThatDoNotFitAreRefusedByName) {
  using namespace std::string_literals;
  // Elements as stored: tag, type and length before the value.
  const auto says = [](const fs::path& file, const char* what) {
    EXPECT_NE(refusal(file).find(what), std::string::npos) << refusal(file);
  };
  says(changed("view.dcm", "CS\4\0MLO "s, "CS\4\0XCC "s), "XCC");
  says(changed("side.dcm", "\x20\0\x62\0CS\2\0"s, "\x20\0\x63\0CS\2\0"s), "laterality");
  says(changed("pixel.dcm", "\x18\0\x64\x11"s, "\x18\0\x66\x11"s), "pixel spacing is missing");
  says(changed("modality.dcm", "CS\2\0MG"s, "CS\2\0MR"s), "MR");
  const std::string whole = read_text(file("mlo.dcm"));
  write_text(file("cut.dcm"), whole.substr(0, whole.size() - 100));
  says(file("cut.dcm"), "truncated");
  write_text(file("text.dcm"), "no DICOM");
  says(file("text.dcm"), "not a DICOM file");
}

TEST_F(MammogramDicomFile, ViewsThatAreNotSimulatedAreRefusedByName) {
  const std::string whole = read_text(file("mlo.dcm"));
  const auto says = [&](const DatasetBuilder& more, const char* what) {
    write_text(file("other.dcm"), fixtures::with_elements(whole, more));
    EXPECT_NE(refusal(file("other.dcm")).find(what), std::string::npos)
        << what << ": " << refusal(file("other.dcm"));
  };
  for (const char* code : {"399055006", "R-102D7"})
    says(fixtures::view_modifier(code), "spot compression");
  for (const char* code : {"399209000", "R-102D5"}) says(fixtures::view_modifier(code), "implant");
  says(DatasetBuilder().text(0x00281300, "CS", "YES"), "implant");
  for (const char* code : {"399163009", "R-102D6"})
    says(fixtures::view_modifier(code), "does not state its factor");
  write_text(file("other.dcm"),
             fixtures::with_elements(whole, fixtures::view_modifier("399161006")));
  EXPECT_EQ(refusal(file("other.dcm")), "");  // cleavage
}

TEST_F(MammogramDicomFile, APixelOfAMagnifiedViewIsSmallerInTheBreast) {
  const std::string magnified = fixtures::with_elements(
      fixtures::with_elements(read_text(file("mlo.dcm")), DatasetBuilder().number(0x00181114, 1.8)),
      fixtures::view_modifier("399163009"));
  write_text(file("magnified.dcm"), magnified);
  const MammogramHeader header = read_mammogram_header(file("magnified.dcm"));
  EXPECT_DOUBLE_EQ(header.magnification, 1.8);
  EXPECT_DOUBLE_EQ(header.pixel_mm, 0.5 / 1.8);
}

TEST_F(MammogramDicomFile, AnglesAreFoldedToThoseOfTheView) {
  const auto angle = [&](const char* view, double stated) {
    DatasetBuilder more;
    more.number(0x00181510, stated);
    write_text(file("turned.dcm"),
               fixtures::with_elements(read_text(file(std::string(view) + ".dcm")), more));
    const View shown = view == std::string("cc") ? View::cc : View::mlo;
    return *like_mammogram(file("turned.dcm"), shown).angle_deg;
  };
  EXPECT_NEAR(angle("cc", 180), 0, 1e-9);
  EXPECT_NEAR(angle("mlo", 135), 45, 1e-9);
  EXPECT_NEAR(angle("mlo", -50), 50, 1e-9);
  EXPECT_THROW(angle("mlo", 180), Error);
  EXPECT_THROW(angle("cc", 90), Error);
  EXPECT_EQ(like_mammogram(file("turned.dcm"), View::cc, 5.0).angle_deg, 5);  // the user's
}

TEST_F(MammogramDicomFile, ImpossibleValuesAreIgnoredWithARemark) {
  const auto like = [&](const DatasetBuilder& more) {
    write_text(file("odd.dcm"), fixtures::with_elements(read_text(file("mlo.dcm")), more));
    return like_mammogram(file("odd.dcm"), View::mlo);
  };
  DatasetBuilder by_force;
  by_force.number(0x001811a0, 0).number(0x001811a2, 90);
  const LikeMammogram found = like(by_force);
  EXPECT_FALSE(found.thickness_mm);
  EXPECT_EQ(found.force_N, 90);
  ASSERT_EQ(found.remarks.size(), 1u);
  EXPECT_NE(found.remarks[0].find("body part thickness 0"), std::string::npos) << found.remarks[0];
  DatasetBuilder neither;
  neither.number(0x001811a0, 0).number(0x001811a2, 1100);
  EXPECT_THROW(like(neither), Error);
}

TEST(MammogramView, IsFoundInFreeText) {
  const auto view = [](const char* text) {
    const auto found = view_in_text(text);
    return found ? view_name(*found) : "";
  };
  for (const char* text : {"L CC", "RCC", "cc", "R-CC 2D", "Cranio-caudal", "LCCID"})
    EXPECT_EQ(view(text), "CC") << text;
  for (const char* text : {"LMLO", "R MLO", "mediolateral oblique", "MLO_L"})
    EXPECT_EQ(view(text), "MLO") << text;
  for (const char* text : {"LML", "ML", "medio-lateral"}) EXPECT_EQ(view(text), "ML") << text;
  for (const char* text :
       {"", "XCCL", "LM", "CC and MLO", "accession", "cranio-caudal exaggerated"})
    EXPECT_EQ(view(text), "") << text;
  EXPECT_EQ(side_in_text("RMLO"), Side::right);
  EXPECT_EQ(side_in_text("left breast, CC"), Side::left);
  EXPECT_FALSE(side_in_text("L and R"));
}

TEST_F(MammogramDicomFile, ATissueFractionImageHasNoDetectorSignal) {
  const ToolResult result = run_tool(
      "project-mammogram",
      {"cc.vtkhdf", "f.vti", "--pixel", "1", "--dicom", "f.dcm", "--dicom-for", "processing"},
      folder_->path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.error_lines(), 1) << result.err;
  EXPECT_FALSE(fs::exists(file("f.dcm")));
}

TEST_F(MammogramDicomFile, CompressionLikeAMammogram) {
  const Side side = read_mesh(file("reference.vtkhdf")).side;
  const LikeMammogram like = like_mammogram(file("mlo.dcm"), View::mlo);
  EXPECT_EQ(like.side, side);
  EXPECT_NEAR(*like.angle_deg, 45, 1e-9);
  EXPECT_NEAR(*like.thickness_mm, read_mesh(file("mlo.vtkhdf")).contact->thickness_mm, 1e-6);
  EXPECT_THROW(like_mammogram(file("mlo.dcm"), View::cc), Error);
  // The tool: a header that does not fit is one line and exit 2, before anything is solved.
  for (const std::vector<std::string>& fit :
       {std::vector<std::string>{"--view", "CC", "--like", "mlo.dcm"},
        {"--view", "MLO", "--like", "cc.vti"}}) {
    std::vector<std::string> arguments{"reference.vtkhdf", "no.vtkhdf", "--materials", "seed2008"};
    arguments.insert(arguments.end(), fit.begin(), fit.end());
    const ToolResult result = run_tool("compress", arguments, folder_->path());
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_EQ(result.error_lines(), 1) << result.err;
    EXPECT_FALSE(fs::exists(file("no.vtkhdf")));
  }
}
