// evaluate: how far a segmentation or a surface is from the truth.
#include <optional>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "evaluation/curve_distance.hpp"
#include "evaluation/foreign_labels.hpp"
#include "evaluation/label_surface.hpp"
#include "evaluation/overlap.hpp"
#include "evaluation/surface_distance.hpp"
#include "io/label_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"

using namespace breast;

namespace {

bool is_surface(const std::filesystem::path& file) {
  return file.extension() == ".vtp";
}

LabelVolume read_any_labels(const std::filesystem::path& file, const TissueCodes& codes) {
  if (file.extension() == ".vtkhdf") return read_labels(file);
  return translate_labels(read_volume(file), codes, file.string());
}

void report_distances(Run& run, Table& table, const std::string& name, const Distances& d) {
  table.rows.push_back({name + "_mean_mm", format_fixed(d.mean_mm, 3)});
  table.rows.push_back({name + "_p95_mm", format_fixed(d.p95_mm, 3)});
  table.rows.push_back({name + "_max_mm", format_fixed(d.max_mm, 3)});
  run.report().set(name + "/mean_mm", d.mean_mm);
  run.report().set(name + "/p95_mm", d.p95_mm);
  run.report().set(name + "/max_mm", d.max_mm);
}

void report_overlap(Run& run, Table& table, const std::string& name, const Overlap& overlap) {
  if (overlap.given_ml == 0 && overlap.truth_ml == 0) return;
  table.rows.push_back({name + "_dice", format_fixed(overlap.dice, 4)});
  table.rows.push_back({name + "_ml", format_fixed(overlap.given_ml, 2)});
  table.rows.push_back({name + "_truth_ml", format_fixed(overlap.truth_ml, 2)});
  run.report().set("dice/" + name, overlap.dice);
  run.report().set("volumes_ml/" + name, overlap.given_ml);
  run.report().set("truth_volumes_ml/" + name, overlap.truth_ml);
}

void report_nipple(Run& run, Table& table, const LabelVolume& given, const LabelVolume& truth) {
  const auto a = given.landmarks.find("nipple"), b = truth.landmarks.find("nipple");
  if (a == given.landmarks.end() || b == truth.landmarks.end()) return;
  const double distance = (a->second - b->second).norm();
  table.rows.push_back({"nipple_mm", format_fixed(distance, 3)});
  run.report().set("nipple_mm", distance);
}

// Curves of cc2mlo: how far apart they are on the MLO detector.
void evaluate_curves(Run& run, Table& table, const std::filesystem::path& given,
                     const std::filesystem::path& truth) {
  const CurveComparison comparison =
      compare_curves(read_polylines(given), read_polylines(truth), given.string(), truth.string());
  table.rows.push_back({"curves", std::to_string(comparison.curves)});
  report_distances(run, table, "curve", comparison.both);
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path given_file, truth_file, region_file;
  std::vector<std::string> code_texts;
  int region_code = 0;
  bool curves = false;
  Tool tool("evaluate", "agreement of a segmentation or a surface with the truth");
  tool.describe(
          "Two label volumes: Dice and volumes of every tissue and of the breast (fat, "
          "fibroglandular, skin "
          "and tumour together), distances between the breasts' surfaces (good to half a voxel) "
          "and "
          "between the nipples. Two surfaces or point sets (.vtp), or a label volume and a "
          "surface: "
          "distances. Prints a table of quantity and value to stdout.")
      .cite("Dice 1945, Ecology 26(3):297-302");
  tool.input(given_file, "GIVEN", "label volume (.vtkhdf, .nrrd, .nii, .mha) or surface (.vtp)");
  tool.input(truth_file, "TRUTH", "the same, taken as true");
  tool.texts(code_texts, "--code", "NUMBER=TISSUE",
             "meaning of a foreign code in a volume not of ours");
  tool.input_file(region_file, "--region", "FILE",
                  "volume outside which the truth's breast is ignored");
  tool.integer(region_code, "--region-code", "CODE", "value of the region; 0 takes any but 0", 0,
               65535);
  tool.flag(curves, "--curves",
            "both files are curves of cc2mlo: distance of the matched curves on the MLO detector");
  tool.example("evaluate no-skin/curve.vtp curve.vtp --curves", "what a change of model moves");
  tool.example("evaluate labels.vtkhdf truth/labels-left.vtkhdf", "a segmentation of the phantom");
  tool.example(
      "evaluate labels.vtkhdf labels_mr.nrrd --code 1=fat --code 29=fibroglandular --code 2=skin "
      "--region side.nrrd --region-code 1",
      "against a volume with codes of its own and both breasts");
  tool.check([&] { parse_tissue_codes(code_texts); });
  return tool.main(argc, argv, [&](Run& run) {
    const TissueCodes codes = parse_tissue_codes(code_texts);
    Table table;
    table.columns = {"quantity", "value"};
    if (curves) {
      evaluate_curves(run, table, given_file, truth_file);
      run.print(table.text());
      return;
    }
    TriMesh given, truth;
    std::optional<LabelVolume> given_labels, truth_labels;
    run.progress().update("reading", 0, "");
    if (is_surface(given_file))
      given = read_surface(given_file);
    else
      given_labels = read_any_labels(given_file, codes);
    if (is_surface(truth_file))
      truth = read_surface(truth_file);
    else
      truth_labels = read_any_labels(truth_file, codes);
    if (truth_labels && !region_file.empty())
      restrict_breast(*truth_labels, read_volume(region_file), region_code);
    if (given_labels && truth_labels) {
      const LabelOverlap overlap = compare_labels(*given_labels, *truth_labels);
      for (int t = int(Tissue::fat); t < n_tissues; ++t) {
        const auto tissue = static_cast<Tissue>(t);
        report_overlap(run, table, std::string(tissue_name(tissue)),
                       overlap.tissue[std::size_t(t)]);
      }
      report_overlap(run, table, "breast", overlap.breast);
      report_nipple(run, table, *given_labels, *truth_labels);
    }
    run.progress().update("distances", -1, "");
    if (given_labels) given = breast_surface(*given_labels);
    if (truth_labels) truth = breast_surface(*truth_labels);
    if (given.points.empty()) throw input_error(given_file.string(), ": holds no breast");
    if (truth.points.empty()) throw input_error(truth_file.string(), ": holds no breast");
    const SurfaceComparison comparison = compare_surfaces(given, truth);
    report_distances(run, table, "surface", comparison.both);
    report_distances(run, table, "surface_to_truth", comparison.to_truth);
    report_distances(run, table, "surface_from_truth", comparison.from_truth);
    run.print(table.text());
  });
}
