// SPDX-License-Identifier: GPL-3.0-or-later
// Segmentations and points of 3D Slicer: as written by us, as Slicer saves them, and what is refused.
#include <gtest/gtest.h>

#include <chrono>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/own_file.hpp"
#include "fixtures/samples.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/markups_file.hpp"
#include "io/segmentation_file.hpp"
#include "io/volume_file.hpp"

namespace breast {
namespace {

std::string reason(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The file with a piece of its header replaced; header and voxels need not agree in length.
void replace(const std::filesystem::path& from, const std::filesystem::path& to,
             const std::string& what, const std::string& by) {
  std::string text = read_text(from);
  const std::size_t at = text.find(what);
  ASSERT_NE(at, std::string::npos) << what;
  write_text(to, text.replace(at, what.size(), by));
}

TEST(Segmentations, RoundTripKeepsTissuesAndWhatTagsHold) {
  const ScratchFolder folder;
  const LabelVolume labels = samples::labels();
  const auto file = folder / "labels.seg.nrrd";
  write_segmentation(file, labels);
  EXPECT_TRUE(written_by_us(file));
  const SegmentedVolume read = read_segmentation(file);
  const LabelVolume back = labels_of(read, {}, std::nullopt, "labels.seg.nrrd");
  EXPECT_EQ(back.tissue, labels.tissue);
  EXPECT_EQ(back.side, labels.side);
  EXPECT_EQ(back.skin_thickness, labels.skin_thickness);
  EXPECT_EQ(back.midline_mm, labels.midline_mm);
  EXPECT_EQ(back.landmarks.at("nipple"), labels.landmarks.at("nipple"));
  EXPECT_LT((back.grid.origin - labels.grid.origin).norm(), 1e-9);
  EXPECT_LT((back.grid.direction - labels.grid.direction).norm(), 1e-9);
  const LabelVolume whole = completed_labels(back, labels, "labels.seg.nrrd");
  EXPECT_EQ(whole.tissue, labels.tissue);
  EXPECT_EQ(whole.fibroglandular_fraction, labels.fibroglandular_fraction);
  EXPECT_EQ(whole.chest_wall_confidence, labels.chest_wall_confidence);
}

// A segment that was deleted and added again, and the names of other programs.
TEST(Segmentations, PresetsKnowTheValuesAndNamesOfOtherPrograms) {
  const auto tissue = [](const std::string& name, const std::vector<std::string>& codes) {
    const std::vector<Segment> segments = {{name, 7, {}, {}}};
    return codes_of(segments, parse_tissue_codes(codes), "x").values.at(7);
  };
  EXPECT_EQ(tissue("Chest wall_1", {}), Tissue::muscle);
  EXPECT_EQ(tissue("Dense_2", {"duke-fgt"}), Tissue::fibroglandular);
  EXPECT_EQ(tissue("skeletal_muscle", {"totalsegmentator-tissues"}), Tissue::muscle);
  EXPECT_EQ(tissue("pectoralis_minor", {"totalsegmentator-muscles"}), Tissue::muscle);
  EXPECT_EQ(tissue("pectoralis_major_left", {"totalsegmentator-trunk"}), Tissue::muscle);
  EXPECT_EQ(tissue("left", {"breastdivider"}), Tissue::fat);
  EXPECT_EQ(tissue("Skin", {"duke-fgt"}), Tissue::skin);                 // its own name
  EXPECT_EQ(tissue("Dense", {"duke-fgt", "7=tumour"}), Tissue::tumour);  // the user's word
  EXPECT_THROW(tissue("Dense", {"totalsegmentator-tissues"}), Error);    // another program's
  Volume<float> volume;
  volume.grid.size = {4, 1, 1};
  volume.voxels = {0, 1, 3, 9};
  const TissueCodes codes = parse_tissue_codes({"totalsegmentator-tissues", "9=tumour"});
  const std::vector<std::uint8_t> expected = {std::uint8_t(Tissue::air), std::uint8_t(Tissue::fat),
                                              std::uint8_t(Tissue::muscle),
                                              std::uint8_t(Tissue::tumour)};
  EXPECT_EQ(translate_labels(volume, codes, "x").tissue, expected);
  volume.voxels = {0, 0, 70, 70};
  EXPECT_THROW(translate_labels(volume, codes, "x"), Error);
}

// The published lists number their classes from 1 without a gap.
TEST(Segmentations, PresetsHaveEveryValueOfTheirSource) {
  const std::map<std::string, int> classes = {{"totalsegmentator-tissues", 4},
                                              {"totalsegmentator-muscles", 18},
                                              {"totalsegmentator-trunk", 22},
                                              {"duke-fgt", 2},
                                              {"breastdivider", 2}};
  EXPECT_EQ(code_preset_names().size(), classes.size());
  for (const auto& [name, count] : classes) {
    const CodePreset preset = load_code_preset(name);
    ASSERT_EQ(preset.values.size(), std::size_t(count)) << name;
    EXPECT_EQ(preset.values.begin()->first, 1) << name;
    EXPECT_EQ(preset.values.rbegin()->first, count) << name;
    EXPECT_GE(preset.names.size(), preset.values.size()) << name;
  }
}

TEST(Segmentations, APresetMayBeATableOfTheUser) {
  const ScratchFolder folder;
  const std::string file = (folder / "mine.tsv").string();
  write_text(file, "value\tname\ttissue\n5\tParenchyma\tfibroglandular\n-\tRibs\twall\n");
  const CodePreset preset = load_code_preset(file);
  EXPECT_EQ(preset.values.at(5), Tissue::fibroglandular);
  EXPECT_EQ(preset.names.at("ribs"), Tissue::muscle);
  for (const char* row : {"5\tx\tbone", "5.5\tx\tfat", "-1\tx\tfat"}) {
    write_text(file, std::string("value\tname\ttissue\n") + row + "\n");
    EXPECT_THROW(load_code_preset(file), Error) << row;
  }
  try {
    load_code_preset("duke-fgd");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("duke-fgt"), std::string::npos) << error.what();
  }
}

TEST(Segmentations, SegmentsAreKnownByTagNameOrCode) {
  const auto tissue = [](const std::string& name, const TissueCodes& codes) {
    return codes_of({{name, 7, {}, {}}}, codes, "x.seg.nrrd").values.at(7);
  };
  EXPECT_EQ(tissue("Chest wall", {}), Tissue::muscle);
  EXPECT_EQ(tissue("  SKIN_ ", {}), Tissue::skin);
  EXPECT_EQ(tissue("Tumor", {}), Tissue::tumour);
  EXPECT_EQ(tissue("Segment_1", parse_tissue_codes({"wall=7"})), Tissue::muscle);
  EXPECT_EQ(tissue("Segment_1", parse_tissue_codes({"7=wall"})), Tissue::muscle);
  EXPECT_EQ(tissue("Pectoralis left", parse_tissue_codes({"Pectoralis left=wall"})),
            Tissue::muscle);
  EXPECT_EQ(tissue("Skin", parse_tissue_codes({"7=fat"})),
            Tissue::fat);  // what the user says counts
  Segment renamed = segment_of(Tissue::fat);
  renamed.name = "my own name";
  EXPECT_EQ(codes_of({renamed}, {}, "x").values.at(int(Tissue::fat)), Tissue::fat);
}

TEST(Segmentations, UnknownSegmentsAreRefusedByName) {
  const std::vector<Segment> one = {{"Ribs", 5, {}, {}}};
  const std::string unknown = reason([&] { codes_of(one, {}, "x.seg.nrrd"); });
  EXPECT_TRUE(says(unknown, "x.seg.nrrd") && says(unknown, "'Ribs'") && says(unknown, "value 5") &&
              says(unknown, "'Chest wall'") && says(unknown, "--code 5="))
      << unknown;
  const std::string absent = reason([&] { codes_of(one, parse_tissue_codes({"Wal=wall"}), "x"); });
  EXPECT_TRUE(says(absent, "'Wal'") && says(absent, "'Ribs'")) << absent;
  EXPECT_TRUE(says(reason([&] { codes_of(one, parse_tissue_codes({"3=wall"}), "x"); }), "value 3"));
  for (const char* text : {"wall", "=3", "wall=", "wal=3", "3=gland", "70000=fat"})
    EXPECT_TRUE(says(reason([&] { parse_tissue_codes({text}); }), "--code")) << text;
}

TEST(Segmentations, FilesThatAreNoneAreRefused) {
  const ScratchFolder folder;
  const auto file = folder / "a.seg.nrrd", bad = folder / "b.seg.nrrd";
  write_segmentation(file, samples::labels());
  replace(file, bad, "dimension: 3", "dimension: 4");
  EXPECT_TRUE(says(reason([&] { read_segmentation(bad); }), "layers"));
  replace(file, bad, "Segment0_LabelValue:=1", "Segment0_LabelValue:=x");
  EXPECT_TRUE(says(reason([&] { read_segmentation(bad); }), "Segment0_LabelValue"));
  replace(file, bad, "Segment1_LabelValue:=", "Segment1_LabelNumber:=");
  EXPECT_TRUE(says(reason([&] { read_segmentation(bad); }), "Segment1_LabelValue is missing"));
  const std::string second =
      "Segment1_LabelValue:=" + std::to_string(segments_of(samples::labels())[1].value);
  replace(file, bad, second, "Segment1_LabelValue:=1");
  EXPECT_TRUE(
      says(reason([&] { read_segmentation(bad); }), "Segment1_LabelValue 1: is that of segment"));
  Volume<std::uint8_t> plain(samples::labels().grid);
  write_volume(bad, plain);
  EXPECT_TRUE(says(reason([&] { read_segmentation(bad); }), "names no segment"));
  Segment foreign{"Fat", 1, {}, {}};
  SegmentedVolume volume{Volume<float>(plain.grid, 1), {foreign}, "x", ""};
  EXPECT_TRUE(says(reason([&] { labels_of(volume, {}, std::nullopt, "f"); }), "--side"));
  EXPECT_EQ(labels_of(volume, {}, Side::right, "f").side, Side::right);
  LabelVolume far = labels_of(volume, {}, Side::left, "f");
  far.grid.origin += Vec3(1e4, 0, 0);
  EXPECT_TRUE(
      says(reason([&] { completed_labels(far, samples::labels(), "f"); }), "different region"));
}

TEST(MarkupFiles, RoundTripIsExact) {
  const ScratchFolder folder;
  const auto file = folder / "p.mrk.json";
  const Markups list{
      "points", false, {1, 0, 0}, {{"tumour", {0.1, -2.5, 1e3 / 3}}, {"né", {1, 2, 3}}}};
  write_markups(file, list);
  EXPECT_TRUE(written_by_us(file));
  const auto read = read_markups(file);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].at, list.points[0].at);
  EXPECT_EQ(read[1].label, "né");
  EXPECT_EQ(point_named(read, "TUMOUR", "p").at, list.points[0].at);
  EXPECT_TRUE(says(reason([&] { point_named(read, "nipple", "p"); }), "'tumour', 'né'"));
}

// As 3D Slicer 4.11 and 4.10 write it.
std::string fcsv(const std::string& system, const std::string& rows) {
  return "# Markups fiducial file version = 4.11\n# CoordinateSystem = " + system +
         "\n# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n" + rows;
}

TEST(FiducialFiles, AreReadInTheirCoordinateSystem) {
  const ScratchFolder folder;
  const std::string rows =
      "vtkMRMLMarkupsFiducialNode_0,10.5,-20,30,0,0,0,1,1,1,0,clip,,\r\n"
      "vtkMRMLMarkupsFiducialNode_1,1,2,3e1,0,0,0,1,1,1,0,\"a, \"\"b\"\"\",\"note, too\",node\n";
  for (const auto& [system, sign] :
       {std::pair<const char*, double>{"LPS", 1}, {"1", 1}, {"RAS", -1}, {"0", -1}}) {
    write_text(folder / "P.FCSV", fcsv(system, rows));
    ASSERT_TRUE(is_markups_name(folder / "P.FCSV"));
    const auto points = read_markups(folder / "P.FCSV");
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points[0].label, "clip");
    EXPECT_EQ(points[0].at, Vec3(sign * 10.5, sign * -20, 30)) << system;
    EXPECT_EQ(points[1].label, "a, \"b\"");
  }
}

TEST(FiducialFiles, WhatIsAmbiguousIsRefused) {
  const ScratchFolder folder;
  const auto refusal = [&](const std::string& text) {
    write_text(folder / "p.fcsv", text);
    return reason([&] { read_markups(folder / "p.fcsv"); });
  };
  const std::string row = "n0,1,2,3,0,0,0,1,1,1,0,clip,,\n";
  EXPECT_TRUE(says(refusal(fcsv("2", row)), "CoordinateSystem '2'"));
  EXPECT_TRUE(says(refusal(fcsv("LPS", "")), "no points"));
  EXPECT_TRUE(says(refusal(fcsv("LPS", "n0,1,two,3,0,0,0,1,1,1,0,clip,,\n")), "line 4"));
  EXPECT_TRUE(says(refusal(fcsv("LPS", "n0,1,2,3\n")), "has 4 cells"));
  EXPECT_TRUE(
      says(refusal("# columns = id,x,y,z,label\nn0,1,2,3,clip\n"), "states no CoordinateSystem"));
  EXPECT_TRUE(says(refusal("# CoordinateSystem = LPS\n" + row), "no column 'x'"));
}

std::string points_json(const std::string& list) {
  return "{\"@schema\":\"s\",\"markups\":[" + list + "]}";
}

TEST(MarkupFiles, BothCoordinateSystemsAreHonoured) {
  const ScratchFolder folder;
  const auto at = [&](const std::string& space) {
    write_text(
        folder / "a.mrk.json",
        points_json("{\"type\":\"Fiducial\"," + space +
                    "\"controlPoints\":[{\"label\":\"F-1\",\"position\":[1,2,3]},"
                    "{\"label\":\"F-2\",\"positionStatus\":\"undefined\",\"position\":[0,0,0]}]}"));
    const auto points = read_markups(folder / "a.mrk.json");
    EXPECT_EQ(points.size(), 1u);  // F-2 was never placed
    return points.at(0).at;
  };
  EXPECT_EQ(at("\"coordinateSystem\":\"LPS\","), Vec3(1, 2, 3));
  EXPECT_EQ(at("\"coordinateSystem\":\"RAS\","), Vec3(-1, -2, 3));
  EXPECT_EQ(at(""), Vec3(1, 2, 3));
}

TEST(MarkupFiles, DamagedFilesAreRefused) {
  const ScratchFolder folder;
  const auto refusal = [&](const std::string& text) {
    write_text(folder / "a.mrk.json", text);
    return reason([&] { read_markups(folder / "a.mrk.json"); });
  };
  EXPECT_TRUE(says(refusal("not json"), "markups"));
  EXPECT_TRUE(says(refusal("[1]"), "markups"));
  EXPECT_TRUE(says(refusal("{\"markups\": 3}"), "markups"));
  EXPECT_TRUE(says(refusal(points_json("3")), "markups"));
  EXPECT_TRUE(says(refusal(points_json("")), "no points"));
  EXPECT_TRUE(
      says(refusal(points_json("{\"coordinateSystem\":\"XYZ\",\"controlPoints\":[]}")), "XYZ"));
  EXPECT_TRUE(
      says(refusal(points_json("{\"coordinateUnits\":\"um\",\"controlPoints\":[]}")), "um"));
  const std::string deep = std::string(100, '[') + std::string(100, ']');
  EXPECT_TRUE(says(refusal(points_json("{\"controlPoints\":" + deep + "}")), "nested"));
  std::string keys;
  for (int n = 0; n < 200000; ++n) keys += "\"k" + std::to_string(n) + "\":0,";
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(says(refusal(points_json("{" + keys + "\"controlPoints\":[]}")), "no points"));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_LT(seconds.count(), 10);  // sought one by one, they take minutes
  for (const char* position : {"[1,2]", "[1,2,\"x\"]", "[1,2,1e300]", "3", "null"}) {
    EXPECT_TRUE(says(
        refusal(points_json("{\"controlPoints\":[{\"position\":" + std::string(position) + "}]}")),
        "position"))
        << position;
  }
}

}  // namespace
}  // namespace breast
