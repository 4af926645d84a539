// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces, curves and mammograms: what is written is read back, and what is not a file of that
// kind, cut, or not finite is refused with a typed error.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "fixtures/complaint.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/mammogram_file.hpp"
#include "io/surface_file.hpp"
#include "projection/display.hpp"

using namespace breast;

namespace {

History some_history() {
  return {{"segment", "0.1.0", "segment mr.nrrd \"l.vtkhdf\" --side left", {{"mr.nrrd", "ab12"}}},
          {"fit-hermite", "0.1.0", "fit-hermite l.vtkhdf g.vtkhdf", {}}};
}

TriMesh some_surface() {
  TriMesh surface;
  surface.points = {{0, 0, 0}, {1.25, 0, 1e-17}, {0, -3.1, 2}, {M_PI, 1e6, -7}};
  surface.triangles = {{0, 1, 2}, {2, 1, 3}};
  surface.normals = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}};
  surface.point_data["kind"] = {0, 1, 1, 0};
  surface.history = some_history();
  return surface;
}

PolyLines some_lines() {
  PolyLines lines;
  for (int i = 0; i < 40; ++i) lines.points.push_back({0.1 * i, std::sin(i), std::cos(i)});
  lines.lines = {{7}, {0, 1, 2, 3}, {30, 20, 10}};  // a marker of one point, two curves
  lines.line_names = {"true tumour", "curve", "arc"};
  lines.point_data["u_mm"].assign(40, 1.5);
  lines.point_vectors["imaged"].assign(40, Vec3(1, 2, 3));
  lines.history = some_history();
  return lines;
}

Mammogram some_mammogram(Side side = Side::right) {
  Mammogram image;
  image.pose = view_pose(side, 45);
  image.pose.origin = Vec3(1, 2, 3);
  image.view = View::mlo;
  image.side = side;
  image.width = 5;
  image.height = 3;
  image.pixel = 0.3;
  for (int i = 0; i < 15; ++i) {
    image.path.push_back(float(i));
    image.thickness.push_back(2.0f * float(i));
    image.fibroglandular.push_back(0.5f * float(i));
    image.through_back.push_back(0);
  }
  image.history = some_history();
  return image;
}

template <class Read>
void expect_input_error(const Read& read) {
  try {
    read();
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

// Every strict prefix that loses more than the final newline must be refused.
template <class Read>
void expect_cuts_refused(const std::filesystem::path& file, const Read& read) {
  const std::string whole = read_text(file);
  const std::filesystem::path cut = file.parent_path() / ("cut" + file.extension().string());
  for (std::size_t length = 0; length + 1 < whole.size(); length += 1 + whole.size() / 97) {
    std::ofstream(cut, std::ios::binary) << whole.substr(0, length);
    SCOPED_TRACE(length);
    expect_input_error([&] { read(cut); });
  }
}

// Damage anywhere is either refused or harmless (a comment, a name); it never crashes.
template <class Read>
void expect_damage_survived(const std::filesystem::path& file, const Read& read) {
  const std::string whole = read_text(file);
  const std::filesystem::path bad = file.parent_path() / ("bad" + file.extension().string());
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 211) {
    std::string text = whole;
    text[at] = char(text[at] ^ 0x15);
    std::ofstream(bad, std::ios::binary) << text;
    try {
      read(bad);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
    }
  }
}

std::string unsealed(const std::filesystem::path& file) {
  std::string text = read_text(file);
  const auto seal = text.find("<!-- sha256");
  return text.erase(seal, text.find("-->", seal) + 3 - seal);
}

// Under the seal, and without it: what VTK does with such a file must not end this process.
template <class Read>
void expect_all_damage_survived(const std::filesystem::path& file, const Read& read) {
  expect_damage_survived(file, read);
  write_text(file, unsealed(file));
  read(file);
  expect_damage_survived(file, read);
}

}  // namespace

TEST(SurfaceFile, RoundTripIsExact) {
  const ScratchFolder folder;
  const TriMesh surface = some_surface();
  write_surface(folder / "s.vtp", surface);
  const TriMesh back = read_surface(folder / "s.vtp");
  EXPECT_EQ(back.points, surface.points);
  EXPECT_EQ(back.triangles, surface.triangles);
  EXPECT_EQ(back.normals, surface.normals);
  EXPECT_EQ(back.point_data, surface.point_data);
  ASSERT_EQ(back.history.size(), 2u);
  EXPECT_EQ(back.history[0].command, surface.history[0].command);
  EXPECT_EQ(back.history[0].inputs[0].sha256, "ab12");
}

TEST(SurfaceFile, ContentHashIgnoresHistoryAndSeesPoints) {
  const ScratchFolder folder;
  TriMesh surface = some_surface();
  write_surface(folder / "a.vtp", surface);
  surface.history.clear();
  write_surface(folder / "b.vtp", surface);
  surface.points[2].x() += 1e-12;
  write_surface(folder / "c.vtp", surface);
  const auto sha = [&](const char* name) { return read_surface(folder / name).content_sha256; };
  EXPECT_EQ(sha("a.vtp"), sha("b.vtp"));
  EXPECT_NE(sha("a.vtp"), sha("c.vtp"));
}

TEST(SurfaceFile, PointSetAndPolylinesRoundTrip) {
  const ScratchFolder folder;
  TriMesh points;
  points.points = {{1, 2, 3}, {4, 5, 6}};
  write_surface(folder / "p.vtp", points);
  EXPECT_EQ(read_surface(folder / "p.vtp").points, points.points);
  EXPECT_TRUE(read_surface(folder / "p.vtp").triangles.empty());

  const PolyLines lines = some_lines();
  write_polylines(folder / "l.vtp", lines);
  const PolyLines back = read_polylines(folder / "l.vtp");
  EXPECT_EQ(back.points, lines.points);
  EXPECT_EQ(back.lines, lines.lines);
  EXPECT_EQ(back.line_names, lines.line_names);
  EXPECT_EQ(back.point_data, lines.point_data);
  EXPECT_EQ(back.point_vectors, lines.point_vectors);
}

TEST(MammogramFile, RoundTripIsExact) {
  const ScratchFolder folder;
  Mammogram image = some_mammogram();
  image.through_back[3] = 1;
  write_mammogram(folder / "m.vti", image);
  const Mammogram back = read_mammogram(folder / "m.vti");
  EXPECT_EQ(back.path, image.path);
  EXPECT_EQ(back.thickness, image.thickness);
  EXPECT_EQ(back.fibroglandular, image.fibroglandular);
  EXPECT_EQ(back.through_back, image.through_back);
  EXPECT_EQ(back.pose.n, image.pose.n);
  EXPECT_EQ(back.pose.e_v, image.pose.e_v);
  EXPECT_EQ(back.pose.origin, image.pose.origin);
  EXPECT_EQ(back.pixel, image.pixel);
  EXPECT_EQ(back.view, View::mlo);
  EXPECT_EQ(back.side, Side::right);
  EXPECT_EQ(back.width, 5);
  EXPECT_EQ(back.height, 3);
}

TEST(MammogramFile, AnUnknownViewIsRefusedByName) {
  const ScratchFolder folder;
  write_mammogram(folder / "m.vti", some_mammogram());
  std::string text = read_text(folder / "m.vti");
  text = text.substr(0, text.find("<!-- sha256")) + "</VTKFile>\n";  // as another program writes it
  const auto at = text.find("Name=\"view\""), end = text.find("</Array>", at);
  ASSERT_LT(at, end);
  text.replace(at, end - at, "Name=\"view\" NumberOfTuples=\"1\" format=\"ascii\">76 77 0 ");
  write_text(folder / "m.vti", text);
  try {
    read_mammogram(folder / "m.vti");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("view 'LM'"), std::string::npos) << error.what();
    EXPECT_EQ(error.exit_code(), 2);
  }
}

TEST(MammogramFile, HungWithChestWallOutsideAndLateralOnTop) {
  const HungImage left = hang(some_mammogram(Side::left));
  const HungImage right = hang(some_mammogram(Side::right));
  // Stored pixel (u=4, v=2) is the brightest: anterior, and inferior on the left side.
  EXPECT_EQ(left.grey[14], 65535);
  EXPECT_EQ(left.grey[0], 0);
  EXPECT_EQ(right.grey[0], 65535);
  EXPECT_EQ(right.grey[14], 0);
}

// The same gland in fat shows alike between the plates (u >= 2 pixels) and in the thrice as thick
// tissue behind them.
TEST(MammogramFile, ThickTissueBehindThePlatesIsNotLostInWhite) {
  Mammogram image = some_mammogram(Side::left);
  image.plate_edge_u = 2 * image.pixel;
  for (int i = 0; i < 15; ++i) {
    const float thickness = i % 5 < 2 ? 120 : 40, gland = i / 5 == 1 ? 0.5f : 0.25f;
    image.thickness[i] = thickness;
    image.path[i] = thickness * (gland + 0.5f * (1 - gland));
  }
  const HungImage hung = hang(image);
  EXPECT_EQ(hung.grey[0], hung.grey[4]);
  EXPECT_EQ(hung.grey[5], hung.grey[9]);
  EXPECT_GT(hung.grey[5], 1.3 * hung.grey[0]);
  image.thickness[4] = image.path[4] = 2;  // a ray through skin only, beside tissue of 40 mm
  EXPECT_LT(hang(image).grey[4], hung.grey[4]);
}

// White is the densest tissue of the breast, with muscle behind it as without.
TEST(MammogramFile, MuscleAtTheBackDoesNotDarkenTheBreast) {
  Mammogram image = some_mammogram(Side::left);
  std::fill(image.thickness.begin(), image.thickness.end(), 50.0f);
  for (int i = 0; i < 15; ++i) image.path[i] = i % 5 < 2 ? 25 : i % 5 < 4 ? 30 : 38;
  const HungImage without = hang(image);
  for (int i = 0; i < 15; i += 5) {
    image.path[i] = 50;
    image.through_back[i] = 1;
  }
  const HungImage with = hang(image);
  for (int i = 0; i < 15; ++i) EXPECT_EQ(with.grey[i], i % 5 == 0 ? 65535 : without.grey[i]) << i;
}

// Rays that graze the skin stay in it for centimetres: they may show, but less than what is inside.
TEST(MammogramFile, TheSkinFadesAndTheUnknownPartEndsSoftly) {
  Mammogram image = some_mammogram(Side::left);
  image.width = 40;
  image.height = 5;
  image.plate_edge_u = 0;
  image.path.assign(200, 0);
  image.thickness.assign(200, 0);
  image.fibroglandular.assign(200, 0);
  image.through_back.assign(200, 0);
  for (std::size_t i = 0; i < 200; ++i) {
    const std::size_t u = i % 40;
    if (u < 10) {
      image.through_back[i] = 1;
    } else if (u < 30) {
      image.thickness[i] = 50;
      image.path[i] = i < 40 && u >= 20 ? 48 : 22;  // gland in the first row, else fat
    } else if (u < 36) {                            // mostly skin, as along a tangent
      image.thickness[i] = float(36 - u) * 5;
      image.path[i] = image.thickness[i] * 0.72f;
    }
  }
  const HungImage hung = hang(image);
  const auto grey = [&](std::size_t u) { return int(hung.grey[80 + u]); };
  for (std::size_t u = 30; u < 36; ++u) EXPECT_LE(grey(u + 1), grey(u)) << u;
  EXPECT_LT(grey(30), 1.45 * grey(25));
  EXPECT_GT(grey(34), 0);
  // Between even grey and tissue no step of one pixel.
  const int step = std::abs(grey(25) - grey(4));
  EXPECT_GT(step, 0);
  for (std::size_t u = 5; u < 17; ++u) EXPECT_LT(std::abs(grey(u + 1) - grey(u)), 0.25 * step) << u;
}

TEST(MammogramFile, PngIsSixteenBitGrey) {
  const ScratchFolder folder;
  write_mammogram_png(folder / "m.png", some_mammogram());
  const std::string png = read_text(folder / "m.png");
  ASSERT_GT(png.size(), 33u);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(int(png[19]), 5);   // width
  EXPECT_EQ(int(png[23]), 3);   // height
  EXPECT_EQ(int(png[24]), 16);  // bits
  EXPECT_EQ(int(png[25]), 0);   // grey
}

TEST(VtkFiles, NonFiniteValuesAreRefusedByPlace) {
  const ScratchFolder folder;
  TriMesh surface = some_surface();
  surface.points[3].y() = std::numeric_limits<double>::quiet_NaN();
  write_surface(folder / "s.vtp", surface);
  try {
    read_surface(folder / "s.vtp");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("Points, tuple 3"), std::string::npos) << error.what();
  }
  Mammogram image = some_mammogram();
  image.thickness[7] = std::numeric_limits<float>::infinity();
  write_mammogram(folder / "m.vti", image);
  expect_input_error([&] { read_mammogram(folder / "m.vti"); });
  PolyLines lines = some_lines();
  lines.point_vectors["imaged"][5].z() = NAN;
  write_polylines(folder / "l.vtp", lines);
  expect_input_error([&] { read_polylines(folder / "l.vtp"); });
}

TEST(VtkFiles, ForeignFilesAreRefused) {
  const ScratchFolder folder;
  write_text(folder / "empty.vtp", "");
  write_text(folder / "text.vtp", "a,b,c\n1,2,3\n");
  write_mammogram(folder / "m.vti", some_mammogram());
  write_surface(folder / "s.vtp", some_surface());
  expect_input_error([&] { read_surface(folder / "absent.vtp"); });
  expect_input_error([&] { read_surface(folder / "empty.vtp"); });
  expect_input_error([&] { read_surface(folder / "text.vtp"); });
  expect_input_error([&] { read_surface(folder / "m.vti"); });
  expect_input_error([&] { read_mammogram(folder / "s.vtp"); });
  expect_input_error([&] { read_polylines(folder / "s.vtp"); });
}

TEST(VtkFiles, CutFilesAreRefused) {
  const ScratchFolder folder;
  write_surface(folder / "s.vtp", some_surface());
  write_polylines(folder / "l.vtp", some_lines());
  write_mammogram(folder / "m.vti", some_mammogram());
  expect_cuts_refused(folder / "s.vtp", [](const auto& file) { read_surface(file); });
  expect_cuts_refused(folder / "l.vtp", [](const auto& file) { read_polylines(file); });
  expect_cuts_refused(folder / "m.vti", [](const auto& file) { read_mammogram(file); });
}

// A test a kind of file, since each read takes a process of its own.
TEST(VtkFiles, DamageOfASurfaceNeverCrashes) {
  const ScratchFolder folder;
  write_surface(folder / "s.vtp", some_surface());
  expect_all_damage_survived(folder / "s.vtp", [](const auto& file) { read_surface(file); });
}
TEST(VtkFiles, DamageOfPolylinesNeverCrashes) {
  const ScratchFolder folder;
  write_polylines(folder / "l.vtp", some_lines());
  expect_all_damage_survived(folder / "l.vtp", [](const auto& file) { read_polylines(file); });
}
TEST(VtkFiles, DamageOfAMammogramNeverCrashes) {
  const ScratchFolder folder;
  write_mammogram(folder / "m.vti", some_mammogram());
  expect_all_damage_survived(folder / "m.vti", [](const auto& file) { read_mammogram(file); });
}

using fixtures::complaint;

// VTK would allocate what the header of a compressed array states: here 2^32 - 1 blocks, a block that exceeds the file,
// one that its few bytes cannot become, and one with fewer bytes than the points take.
TEST(VtkFiles, ImpossibleCompressionHeadersAreRefusedBeforeVtk) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder / "surface.vtp";
  write_surface(file, some_surface());
  std::string text = unsealed(file);
  const auto points = text.find("<DataArray", text.find("<Points>"));
  const auto at = text.find_first_not_of(" \n", text.find('>', points) + 1);
  const auto refusal = [&](const std::string& header) {
    write_text(file, text.substr(0, at) + header + text.substr(at + header.size()));
    return complaint([&] { read_surface(file); });
  };
  EXPECT_EQ(refusal(text.substr(at, 4)), "accepted");  // the seal alone is gone
  EXPECT_NE(refusal("/////wCAAABgAAAAQAAAAA==").find("more blocks than it has bytes"),
            std::string::npos);
  EXPECT_NE(refusal("AQAAAACAAABgAAAA/////w==").find("blocks longer than its text"),
            std::string::npos);
  EXPECT_NE(refusal("AQAAAACAAP8AAAAAMAAAAA==").find("larger than their bytes can become"),
            std::string::npos);
  EXPECT_NE(refusal("AQAAAACAAAAQAAAAMAAAAA==").find("fewer bytes than values"), std::string::npos);
}

// VTK 9.1 would store the second text beyond the end of an array of one.
TEST(VtkFiles, MoreTextsThanDeclaredAreRefusedBeforeVtk) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder / "mammogram.vti";
  Mammogram image = some_mammogram();
  image.history = {{"project-mammogram", "1.0", "first", {}},
                   {"project-mammogram", "1.0", "second", {}}};
  write_mammogram(file, image);
  std::string text = unsealed(file);
  const std::string declared = "Name=\"history\" NumberOfTuples=\"";
  const auto refusal = [&](char texts) {
    text.at(text.find(declared) + declared.size()) = texts;
    write_text(file, text);
    return complaint([&] { read_mammogram(file); });
  };
  EXPECT_EQ(refusal('2'), "accepted");
  EXPECT_NE(refusal('1').find("more texts than it declares"), std::string::npos);
}

TEST(VtkFiles, AFailedWriteLeavesTheOldFile) {
  const ScratchFolder folder;
  write_mammogram(folder / "m.vti", some_mammogram());
  const std::string before = read_text(folder / "m.vti");
  Mammogram broken = some_mammogram();
  broken.path.pop_back();
  EXPECT_THROW(write_mammogram(folder / "m.vti", broken), Error);
  EXPECT_EQ(read_text(folder / "m.vti"), before);
  EXPECT_THROW(write_surface(folder / "no" / "s.vtp", some_surface()), Error);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    EXPECT_EQ(entry.path().filename(), "m.vti");
  }
}
