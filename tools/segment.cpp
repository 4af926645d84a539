// SPDX-License-Identifier: GPL-3.0-or-later
// segment: labels of one breast from a prone or supine MR scan.
#include "segment/segment.hpp"

#include <algorithm>
#include <optional>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "core/sha256.hpp"
#include "core/table.hpp"
#include "core/text/lists.hpp"
#include "io/label_file.hpp"
#include "io/markups_file.hpp"
#include "io/segmentation_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"
#include "label_input.hpp"
#include "segment/measures.hpp"
#include "segment/overlay.hpp"
#include "segment/quality.hpp"
#include "segment/wall/wall_input.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path scan, labels, fat, also, wall, points, overlay, measures;
  std::string accept_other, side, interior = "threshold", contrast = "auto", posture = "prone";
  int series = 0, fat_series = 0, also_series = 0;
  bool list = false;
  double wall_shift = 0;
  std::vector<std::string> codes;
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Finds the body, the coil's uneven sensitivity, the chest wall (minimum cut), the "
      "breast's extent on it, fat, fibroglandular tissue, skin and nipple. Everything behind "
      "the chest wall is labelled muscle, and the rest of the body is labelled other.");
  tool.describe(
      "A supine scan (--posture supine) is the second posture for identify, which needs its skin "
      "and chest wall. --points then contains the skin of the whole side with normals, and the "
      "chest wall wherever it was found. A supine breast spreads over the side of the chest. It is "
      "labelled only where the chest wall was searched for, so that its border on the side of the "
      "rib cage is arbitrary.");
  tool.cite("Pathmanathan et al. 2008, section II-A; Li et al., IEEE TPAMI 28:119 (2006)");
  tool.input(c.scan, "MR",
             "scan: .nrrd, .nii, .nii.gz, .mha, a DICOM folder, or a DICOM file with all slices");
  tool.output(
      c.labels, "LABELS.vtkhdf",
      "tissue labels of the chosen breast; for other programs, a .nrrd, .nii, .nii.gz or .mha file "
      "holds the tissue codes only, a .seg.nrrd file is a segmentation of 3D Slicer, and a .dcm file is a "
      "DICOM segmentation, which names no patient but, of a DICOM scan, its study and series",
      {".nrrd", ".nii", ".nii.gz", ".mha", ".dcm"});
  tool.choice(c.side, "--side", {"left", "right"}, "the patient's left or right breast")
      .required("--side");
  tool.choice(c.posture, "--posture", {"prone", "supine"}, "how the patient lies");
  tool.integer(
      c.series, "--series", "N",
      "which series of a DICOM folder, numbered as in its list (0: the best, by the rule of `scan`)",
      0, 10000);
  tool.question(c.list, "--list",
                "print the table of the series of a DICOM folder, as `scan` does, and end");
  tool.input_file(
      c.wall, "--chest-wall", "FILE|POINTS",
      "use this chest wall, for example a corrected one. Any of these: a segmentation of 3D Slicer "
      "(.seg.nrrd, segment 'Chest wall'); a label map, whose muscle (code 4) begins at the wall; if it "
      "shows the muscle's back, that is kept, too; a surface (.vtp), or the chest-wall points of a file "
      "from --points; points clicked in 3D Slicer (.mrk.json, .fcsv); a table with columns x_mm y_mm "
      "z_mm (.tsv)");
  tool.texts(c.codes, "--code", "NUMBER=TISSUE|NAME=TISSUE|PRESET",
             "tissue of a value or of a segment in --chest-wall, such as wall=3 or "
             "'Pectoralis=wall', or a preset of these: " +
                 join(code_preset_names(), ", "));
  declare_accept_other(tool, "segment", c.accept_other);
  tool.choice(c.interior, "--interior", {"threshold", "region-growing"},
              "method that separates fat from fibroglandular tissue. threshold: a threshold "
              "midway between their intensities (closer to the known truth of phantoms); "
              "region-growing: the paper's 3-D confidence-connected growing of fat. The report "
              "compares both");
  tool.choice(
      c.contrast, "--contrast", {"auto", "fat-bright", "fat-suppressed", "dixon"},
      "which tissue is bright. auto: dixon with --fat; otherwise skin, fat, muscle and chest wall "
      "must show that fat is bright. A prone scan in which it is not is read as fat-suppressed if its "
      "muscle is bright enough to show the chest wall, and otherwise refused with the numbers. "
      "fat-bright: fat is bright, whatever the scan shows; doubts are warnings. fat-suppressed: fat is "
      "dark. dixon: MR is the water image, --fat the fat image");
  tool.input_file(c.fat, "--fat", "FILE",
                  "fat image of the Dixon scan whose water image is MR: body and chest wall are "
                  "found on their sum, gland by the share of fat; regions in which the scanner "
                  "exchanged the two are put right and reported");
  tool.integer(c.fat_series, "--fat-series", "N", "which series of --fat, if it is a DICOM folder",
               0, 10000);
  tool.input_file(
      c.also, "--also", "FILE",
      "second scan of the same examination, such as T1 beside suppressed fat, for an MR "
      "that does not show the chest wall: the skin is taken from MR, chest wall, muscle "
      "and gland are found on this one. It is aligned rigidly if the skins are more than "
      "4 mm apart (rms)");
  tool.integer(c.also_series, "--also-series", "N",
               "which series of --also, if it is a DICOM folder", 0, 10000);
  tool.output_file(c.points, "--points", "OUT.vtp", "data points of the skin and the chest wall");
  tool.output_file(c.overlay, "--overlay", "OUT.png",
                   "picture of slices with contours, for judging the segmentation");
  tool.output_file(c.measures, "--measures", "OUT.tsv", "table of all measured quantities");
  tool.number(c.wall_shift, "--chest-wall-shift", "SIGMAS",
              "move the chest wall by this many of its standard deviations (sigma_mm in --points), "
              "backwards if positive, to see the effect of its uncertainty",
              -3, 3);
  tool.topic("contrast", {"--contrast", "--fat", "--fat-series", "--also", "--also-series"});
  tool.topic("chest wall", {"--chest-wall", "--code", "--chest-wall-shift"});
  tool.topic("further outputs", {"--points", "--overlay", "--measures"});
  tool.basic({"--side", "--posture", "--series", "--list", "--contrast", "--fat", "--also",
              "--chest-wall", "--overlay", "--measures"});
  tool.check([&c] {
    parse_tissue_codes(c.codes);
    if (c.contrast == "dixon" && c.fat.empty())
      throw input_error(
          "--contrast dixon needs --fat, the fat image: water alone does not show the chest wall "
          "reliably");
    if (!c.fat.empty() && c.contrast != "auto" && c.contrast != "dixon")
      throw input_error("--fat is for --contrast dixon or auto, not ", c.contrast);
    if (c.contrast == "fat-suppressed" && (!c.also.empty() || c.posture != "prone"))
      throw input_error("--contrast fat-suppressed is for a prone scan alone, without --also");
    if (!c.fat.empty() && !c.also.empty())
      throw input_error(
          "--also is for an MR that does not show the chest wall; the sum of water "
          "and fat (--fat) does");
    if (!c.codes.empty() && c.wall.empty()) throw input_error("--code needs --chest-wall");
  });
  tool.example("segment scan.nrrd labels.vtkhdf --side left --overlay look.png",
               "the left breast, with a picture of the contours");
  tool.example(
      "segment supine.nrrd supine-labels.vtkhdf --side left --posture supine --points supine-skin.vtp",
      "the second posture, for identify");
  tool.example("segment water.nrrd labels.vtkhdf --side left --fat fat.nrrd", "a Dixon scan");
  tool.example("segment suppressed.nrrd labels.vtkhdf --side left --also t1.nrrd",
               "a scan with suppressed fat, whose chest wall a T1-weighted scan shows");
  tool.example("segment dicom/ labels.vtkhdf --side right --series 2 --chest-wall clicked.tsv",
               "the second series of a folder, with the chest wall corrected by clicked points");
}

Contrast contrast_from_name(const std::string& name) {
  for (const Contrast one : {Contrast::fat_bright, Contrast::fat_suppressed, Contrast::dixon})
    if (name == contrast_name(one)) return one;
  return Contrast::automatic;
}

/// Refuses what its header says is no scan with bright fat, unless the user says more: T2, parts of a Dixon scan, and
/// what is computed from scans.
void check_stated_contrast(const Choices& c, const VolumeSource& source) {
  const std::string& stated = source.contrast;
  const bool may_be = stated.empty() || stated == "T1" || stated == "in phase" ||
                      stated == "not stated" || stated == "T1 fat-suppressed";
  if (may_be || c.contrast != "auto" || !c.fat.empty() || !c.also.empty() || !c.wall.empty())
    return;
  if (stated == "fat") {
    throw input_error(
        c.scan.string(),
        ": its header states 'fat': give the water image as MR and this one as --fat");
  }
  throw input_error(
      c.scan.string(), ": its header states '", stated,
      "', in which fat is not the one bright tissue that shows the chest wall: give a T1 "
      "series, as MR or beside this one as --also",
      stated == "water" ? ", or the fat image as --fat" : "",
      ", or say that fat is bright (--contrast fat-bright)");
}

/// One sentence on what was found to be bright, with the numbers it follows from.
std::string contrast_words(const Segmentation& result) {
  std::string words =
      message(result.also.used ? "contrast of --also " : "contrast ", contrast_name(result.kind));
  words +=
      message(": what lies behind the chest wall ", format_fixed(result.contrast.muscle_ratio, 2),
              " of fat, evidence of saturation ",
              format_fixed(saturation_evidence(result.contrast), 2), " of ", most_evidence);
  if (result.kind == Contrast::fat_suppressed)
    words += message(", muscle ", format_fixed(result.muscle_over_fat, 2),
                     " times as bright as suppressed fat, ",
                     format_fixed(result.muscle_over_fat_low, 2), " where least");
  if (result.kind == Contrast::dixon)
    words += message(", water and fat exchanged in ", format_fixed(result.exchanged_percent, 1),
                     " % of the breast");
  return words;
}

/// Reads clicked points: those of 3D Slicer, or a table with columns x_mm y_mm z_mm (or x y z),
/// patient LPS.
std::vector<Vec3> read_points(const std::filesystem::path& file) {
  std::vector<Vec3> points;
  if (is_markups_name(file)) {
    for (const MarkupPoint& point : read_markups(file)) points.push_back(point.at);
    return points;
  }
  const Table table = read_table(file);
  for (std::size_t row = 0; row < table.rows.size(); ++row) points.push_back(table.point(row, ""));
  if (points.empty()) throw input_error(file.string(), ": no points");
  return points;
}

bool holds_points(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  return ending == ".tsv" || ending == ".txt" || is_markups_name(file);
}

/// Muscle is the chest wall; a map without muscle is refused before the scan is read.
LabelVolume read_wall_labels(const std::filesystem::path& file, const TissueCodes& codes,
                             Run& run) {
  // Only the code of the chest wall matters: a map without names may have other codes of its own.
  const auto unnamed = [&](const Volume<float>&) {
    TissueCodes wall = codes;
    if (codes.empty()) wall.values[int(Tissue::muscle)] = Tissue::muscle;
    return wall;
  };
  LabelVolume labels = read_tissues(file, codes, run, unnamed);
  if (std::find(labels.tissue.begin(), labels.tissue.end(), std::uint8_t(Tissue::muscle)) ==
      labels.tissue.end()) {
    throw input_error(
        "--chest-wall ", file.string(),
        ": no voxel is chest wall (code 4, or a segment 'Chest wall'); name its value with "
        "--code wall=NUMBER");
  }
  return labels;
}

/// A corrected chest wall: points, a surface, or labels.
struct GivenWall {
  std::vector<Vec3> points;
  std::optional<TriMesh> surface;
  std::optional<LabelVolume> labels;
};

GivenWall read_wall(const std::filesystem::path& file, const TissueCodes& codes, Run& run) {
  if (holds_points(file)) return {read_points(file), {}, {}};
  if (file.extension() == ".vtp") return {{}, read_surface(file), {}};
  return {{}, {}, read_wall_labels(file, codes, run)};
}

Origin origin_of(const std::filesystem::path& file, const GivenWall& wall) {
  if (wall.surface) return breast::origin_of(file, *wall.surface);
  if (wall.labels) return breast::origin_of(file, *wall.labels, file.extension() == ".vtkhdf");
  Origin origin = origin_of_points(file, wall.points);
  Sha256 hash;
  for (const Vec3& point : wall.points) hash.update(point.data(), 3 * sizeof(double));
  origin.content_sha256 = hash.hex();
  return origin;
}

/// Puts the corrected chest wall into the options.
void take_wall(const std::filesystem::path& file, const GivenWall& wall, SegmentOptions& options) {
  if (wall.labels) {
    Volume<float> volume(wall.labels->grid);
    volume.voxels.assign(wall.labels->tissue.begin(), wall.labels->tissue.end());
    options.wall_labels = std::move(volume);
    return;
  }
  options.wall_points =
      wall.surface ? wall_surface_points(*wall.surface, file.string()) : wall.points;
  options.wall_points_of_surface = wall.surface.has_value();
}

// A scan in another posture than the one asked for would be given gravity in the wrong direction.
void check_posture(const std::string& position, const std::string& posture, Run& run) {
  if (position.empty()) return;  // not a DICOM series, or not stated
  const char expected = posture == "prone" ? 'P' : 'S';
  if (position.size() == 3 && position.back() == expected) return;
  run.warn(message("the scanner recorded the patient position ", position, ", but --posture is ",
                   posture, ": check how the patient lay"));
}

/// Another scan of the same examination, if one is given.
std::optional<Volume<float>> read_other(const std::string& option,
                                        const std::filesystem::path& file, const ScanChoice& choice,
                                        const Origin& mr, Pairs& pairs,
                                        std::vector<Run::Input>& inputs, Run& run) {
  if (file.empty()) return {};
  VolumeSource source;
  Volume<float> scan = read_volume(file, choice, &source);
  for (const std::string& remark : source.remarks) run.remark(remark);
  Origin other = origin_of_scan(file, source.content_sha256, scan.grid);
  other.patient = source.patient_id;
  if (!mr.patient.empty() || !other.patient.empty()) pairs.check("MR", mr, option, other);
  inputs.push_back({file, source.content_sha256, nullptr});
  return scan;
}

void list_series_of(const Choices& c, Run& run) {
  ScanChoice choice;
  if (!c.side.empty()) choice.side = side_from_name(c.side);
  std::vector<std::string> remarks;
  run.print(list_series(c.scan, choice, remarks).text());
  for (const std::string& remark : remarks) run.remark(remark);
}

void run_segment(const Choices& c, Run& run) {
  SegmentOptions options;
  options.side = side_from_name(c.side);
  options.posture = posture_from_name(c.posture);
  options.wall_shift = c.wall_shift;
  if (c.interior == "region-growing") options.interior = Interior::region_growing;
  options.contrast = contrast_from_name(c.contrast);
  std::optional<GivenWall> wall;  // before the scan: what is wrong with it is said at once
  if (!c.wall.empty()) {
    wall = read_wall(c.wall, parse_tissue_codes(c.codes), run);
    take_wall(c.wall, *wall, options);
  }
  VolumeSource source;
  Volume<float> scan = [&] {
    const Timer::Scope phase(run.timer(), "read");
    return read_volume(c.scan, ScanChoice(c.series, options.side), &source);
  }();
  for (const std::string& remark : source.remarks) run.remark(remark);
  check_stated_contrast(c, source);
  check_posture(source.patient_position, c.posture, run);
  std::vector<Run::Input> inputs{{c.scan, source.content_sha256, nullptr}};
  Origin mr = origin_of_scan(c.scan, source.content_sha256, scan.grid);
  mr.side = options.side;
  mr.patient = source.patient_id;
  Pairs pairs = pairs_of("segment", run, c.accept_other);
  options.fat =
      read_other("--fat", c.fat, ScanChoice(c.fat_series, options.side), mr, pairs, inputs, run);
  options.also =
      read_other("--also", c.also, ScanChoice(c.also_series, options.side), mr, pairs, inputs, run);
  if (wall) {
    const Origin given = origin_of(c.wall, *wall);
    pairs.check("MR", mr, "--chest-wall", given);
    inputs.push_back({c.wall, given.content_sha256, nullptr});
  }
  std::optional<Volume<float>> drawn;  // a second copy of the scan is kept only for its picture
  if (!c.overlay.empty()) drawn = scan;
  Segmentation result = segment_breast(std::move(scan), options, run.progress(), run.timer());
  run.progress().note(contrast_words(result));
  if (options.also) run.progress().note("--also: " + result.also.change);
  for (const std::string& doubt : result.doubts) run.warn(doubt);
  const bool guessed = options.posture != Posture::prone;
  run.report().set("nipple", guessed ? "guessed" : "found");
  if (guessed)
    run.progress().note(
        "the nipple of a breast that lies flat is a guess; identify does not use it");
  for (const StageQuality& quality : quality_of(result)) {
    if (quality.score >= least_quality) continue;
    run.warn(message("quality of ", quality.stage, " ", format_fixed(quality.score, 2), " (",
                     quality.worst, "; at least ", least_quality, " expected); see --overlay"));
  }
  result.labels.history = result.points.history = run.history(inputs);
  Table measures{{"quantity", "value"}, {}};
  tell(measures_of(result), measures, run.report());
  run.report().set("side", side_name(result.labels.side));
  run.report().set("landmarks/nipple/imaged", result.labels.landmarks.at("nipple"));
  run.report().set("nipple_base", result.nipple_base);
  run.report().set("posture", c.posture);
  run.report().set("interior", c.interior);
  run.report().set("contrast", contrast_name(result.kind));
  if (options.also) run.report().set("also/change", result.also.change);
  const Timer::Scope phase(run.timer(), "write");
  if (drawn) write_overlay(c.overlay, *drawn, result.labels);
  if (!c.points.empty()) write_surface(c.points, result.points);
  if (!c.measures.empty()) write_table(c.measures, measures);
  if (is_segmentation_name(c.labels)) {
    write_segmentation(c.labels, result.labels, source.dicom);
  } else if (is_volume_name(c.labels)) {
    Volume<std::uint8_t> codes(result.labels.grid);
    codes.voxels = result.labels.tissue;
    write_volume(c.labels, codes);
  } else {
    write_labels(c.labels, result.labels);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("segment", "labels of one breast from a prone or supine T1 MR scan");
  declare(tool, c);
  return tool.main(argc, argv,
                   [&c](Run& run) { c.list ? list_series_of(c, run) : run_segment(c, run); });
}
