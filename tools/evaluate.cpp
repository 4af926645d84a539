// SPDX-License-Identifier: GPL-3.0-or-later
// evaluate: the distance of a segmentation or a surface from the truth.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "core/text/lists.hpp"
#include "evaluation/curve_distance.hpp"
#include "evaluation/foreign_labels.hpp"
#include "evaluation/label_surface.hpp"
#include "evaluation/quantities.hpp"
#include "evaluation/surface_distance.hpp"
#include "io/segmentation_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"
#include "label_input.hpp"

using namespace breast;

namespace {

bool is_surface(const std::filesystem::path& file) {
  return file.extension() == ".vtp";
}

/// `volume` (may be null) receives a volume of another program unchanged.
LabelVolume read_any_labels(const std::filesystem::path& file, const TissueCodes& codes,
                            Volume<float>* volume, Run& run) {
  if (file.extension() == ".vtkhdf" || is_segmentation_file(file))
    return read_tissues(file, codes, run);
  VolumeSource source;
  const Volume<float> foreign = read_volume(file, 0, &source);
  if (volume != nullptr) *volume = foreign;
  LabelVolume labels = translate_labels(foreign, codes, file.string());
  labels.content_sha256 = source.content_sha256;
  return labels;
}

// Distance between curves of cc2mlo on the MLO detector.
void evaluate_curves(Run& run, Pairs& pairs, Table& table, const std::filesystem::path& given,
                     const std::filesystem::path& truth) {
  const PolyLines first = read_polylines(given), second = read_polylines(truth);
  pairs.check("GIVEN", breast::origin_of(given, first), "TRUTH", breast::origin_of(truth, second));
  const CurveComparison comparison = compare_curves(first, second, given.string(), truth.string());
  table.rows.push_back({"curves", std::to_string(comparison.curves)});
  tell(distance_quantities("curve", comparison.both), table, run.report());
}

/// The origin of labels or, where there are none, of a surface.
Origin origin_of(const std::filesystem::path& file, const std::optional<LabelVolume>& labels,
                 const TriMesh& surface) {
  return labels ? breast::origin_of(file, *labels, file.extension() == ".vtkhdf")
                : breast::origin_of(file, surface);
}

/// The voxels of a code, one entry a voxel; empty without a code.
std::vector<bool> voxels_of(const Volume<float>& volume, int code) {
  std::vector<bool> has;
  if (code == 0) return has;
  for (const float value : volume.voxels) has.push_back(std::lround(value) == code);
  if (std::find(has.begin(), has.end(), true) == has.end())
    throw input_error("--half-code ", code, ": TRUTH has no voxel of this code");
  return has;
}

/// A volume that goes with the truth, at its place.
Volume<float> read_beside(const std::filesystem::path& file, const std::string& option,
                          const Origin& truth, Pairs& pairs) {
  VolumeSource source;
  Volume<float> volume = read_volume(file, 0, &source);
  pairs.check("TRUTH", truth, option, origin_of_scan(file, source.content_sha256, volume.grid));
  return volume;
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path given_file, truth_file, region_file, fraction_file;
  std::vector<std::string> code_texts;
  int region_code = 0, nipple_code = 0, half_code = 0;
  std::string accept_other;
  bool curves = false, own_side = false;
  Tool tool("evaluate", "agreement of a segmentation or a surface with the truth");
  tool.describe(
          "Compares two label volumes, two surfaces or point sets (.vtp), or a label volume and a "
          "surface, and prints a table of quantities and values to stdout.")
      .describe(
          "For two label volumes, "
          "the table contains the Dice coefficient and the volume of every tissue, of the breast "
          "(fat, fibroglandular tissue, skin and tumour together) and of the body (everything "
          "except air, where both volumes have voxels). It also contains the distance between the "
          "chest walls along y, where the true breast has muscle behind it, and the distances "
          "between the breasts' surfaces (accurate to half a voxel) and between the nipples. "
          "fibroglandular_in_breast and wall_on_breast count only what lies within the breast of "
          "GIVEN, since some true labels do not say where the breast ends. "
          "Of other inputs, the table contains the distances between the surfaces.")
      .cite("Dice 1945, Ecology 26(3):297-302");
  tool.input(given_file, "GIVEN",
             "label volume (.vtkhdf, .seg.nrrd, .nrrd, .nii, .mha) or surface (.vtp)");
  tool.input(truth_file, "TRUTH", "label volume or surface that is taken as true");
  tool.texts(code_texts, "--code", "NUMBER=TISSUE|NAME=TISSUE|PRESET",
             "tissue of a code, or of a named segment, in a label volume that was not made by "
             "libbreast, or a preset of these: " +
                 join(code_preset_names(), ", "));
  tool.input_file(region_file, "--region", "FILE",
                  "volume of a region; the true breast is ignored outside it");
  tool.integer(region_code, "--region-code", "CODE",
               "value of the region's voxels; 0 takes every value but 0", 0, 65535);
  tool.flag(
      own_side, "--own-side",
      "the true breast is ignored beyond the midline of GIVEN, labels of one breast: TRUTH shows "
      "both");
  tool.flag(curves, "--curves",
            "both files are curves of cc2mlo; print the distance between the matched curves on "
            "the MLO detector");
  tool.example("evaluate no-skin/curve.vtp curve.vtp --curves",
               "how far a change of the model moves the curve");
  tool.integer(nipple_code, "--nipple-code", "CODE",
               "code of the nipple in TRUTH; the point of the skin nearest to the centre of its "
               "voxels is taken as the true nipple",
               1, 65535);
  tool.integer(half_code, "--half-code", "CODE",
               "code of voxels of TRUTH that are half fibroglandular tissue: each counts as half a "
               "voxel in fibroglandular_in_breast_dice",
               1, 65535);
  tool.input_file(fraction_file, "--fraction", "FILE",
                  "true fibroglandular fraction of every voxel (0-1 or 0-255); prints also the "
                  "Dice coefficient of the fractions and the highest one that any labelling of "
                  "these voxels could reach");
  tool.example("evaluate labels.vtkhdf truth/labels-left.vtkhdf", "a segmentation of the phantom");
  tool.example(
      "evaluate labels.vtkhdf labels_mr.nrrd --code 1=fat --code 29=fibroglandular --code 2=skin "
      "--region side.nrrd --region-code 1",
      "comparison with a volume that has its own codes and shows both breasts");
  declare_accept_other(tool, "evaluate", accept_other);
  tool.check([&] { parse_tissue_codes(code_texts); });
  return tool.main(argc, argv, [&](Run& run) {
    const TissueCodes codes = parse_tissue_codes(code_texts);
    Table table;
    table.columns = {"quantity", "value"};
    Pairs pairs = pairs_of("evaluate", run, accept_other);
    if (curves) {
      evaluate_curves(run, pairs, table, given_file, truth_file);
      run.print(table.text());
      return;
    }
    TriMesh given, truth;
    Volume<float> foreign;
    std::optional<LabelVolume> given_labels, truth_labels;
    run.progress().update("reading", 0, "");
    if (is_surface(given_file))
      given = read_surface(given_file);
    else
      given_labels = read_any_labels(given_file, codes, nullptr, run);
    if (is_surface(truth_file))
      truth = read_surface(truth_file);
    else
      truth_labels = read_any_labels(truth_file, codes, &foreign, run);
    const Origin of_truth = origin_of(truth_file, truth_labels, truth);
    pairs.check("GIVEN", origin_of(given_file, given_labels, given), "TRUTH", of_truth);
    if (truth_labels && !region_file.empty())
      restrict_breast(*truth_labels, read_beside(region_file, "--region", of_truth, pairs),
                      region_code);
    if (truth_labels && own_side) {
      if (!given_labels || !given_labels->midline_mm)
        throw input_error("--own-side: ", given_file.string(),
                          " has no midline of the body; give labels of segment, or --region");
      restrict_to_side(*truth_labels, given_labels->side, *given_labels->midline_mm);
    }
    if (truth_labels && nipple_code > 0) {
      const auto centre = skin_over_code(foreign, nipple_code, *truth_labels);
      if (!centre)
        throw input_error("--nipple-code ", nipple_code, ": the breast has no voxel of this code");
      truth_labels->landmarks["nipple"] = *centre;
    }
    if (given_labels && truth_labels) {
      const std::vector<bool> half = voxels_of(foreign, half_code);
      tell(label_quantities(*given_labels, *truth_labels, half), table, run.report());
    }
    if (given_labels && truth_labels && !fraction_file.empty()) {
      const Volume<float> fraction = read_beside(fraction_file, "--fraction", of_truth, pairs);
      tell(fraction_quantities(compare_fractions(*given_labels, *truth_labels, fraction)), table,
           run.report());
    }
    run.progress().update("distances", -1, "");
    if (given_labels) given = breast_surface(*given_labels);
    if (truth_labels) truth = breast_surface(*truth_labels);
    if (given.points.empty()) throw input_error(given_file.string(), ": shows no breast");
    if (truth.points.empty()) throw input_error(truth_file.string(), ": shows no breast");
    const SurfaceComparison comparison = compare_surfaces(given, truth);
    tell(distance_quantities("surface", comparison.both), table, run.report());
    tell(distance_quantities("surface_to_truth", comparison.to_truth), table, run.report());
    tell(distance_quantities("surface_from_truth", comparison.from_truth), table, run.report());
    run.print(table.text());
  });
}
