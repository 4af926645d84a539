// cc2mlo: the curve in one mammogram on which a point of another must lie.
#include <algorithm>
#include <optional>

#include "align/match_question.hpp"
#include "cli/tool.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "io/derivative_file.hpp"
#include "io/mammogram_dicom.hpp"
#include "io/mesh_file.hpp"
#include "io/picture_file.hpp"
#include "io/surface_file.hpp"
#include "mammo/curve_lines.hpp"
#include "mammo/point_pair.hpp"

using namespace breast;

namespace {

struct Choices {
  MatchQuestion question;
  std::filesystem::path from, to, curve, table, supine, priors;
  std::filesystem::path cc_image, mlo_image, picture, curve_table;
  std::vector<double> cc_nipple, mlo_nipple;
  std::string geometry = "parallel";
  bool band = false;

  void check() const {
    question.check();
    if (!priors.empty() && !band) throw input_error("--priors is for --band");
    if (!supine.empty() && question.pair.empty()) throw input_error("--supine is for --pair");
    if (cc_image.empty() != mlo_image.empty()) {
      throw input_error("--cc-image and --mlo-image go together");
    }
    if (cc_image.empty() && !(picture.empty() && cc_nipple.empty() && mlo_nipple.empty())) {
      throw input_error("--picture, --cc-nipple and --mlo-nipple are for --cc-image, --mlo-image");
    }
    if (!cc_image.empty() && !question.truth.empty()) {
      throw input_error("--truth is in mm: no --cc-image");
    }
  }
};

// The patient's mammograms, in the order of the meshes.
std::optional<PatientViews> patient_views(const Choices& choices, const Matcher& matcher) {
  if (choices.cc_image.empty()) return std::nullopt;
  const auto image = [](const std::filesystem::path& file, const std::vector<double>& nipple) {
    PatientImage read{read_mammogram_dicom(file), file.string(), std::nullopt};
    if (!nipple.empty()) read.nipple = Vec2(nipple[0], nipple[1]);
    return read;
  };
  PatientImage cc = image(choices.cc_image, choices.cc_nipple),
               mlo = image(choices.mlo_image, choices.mlo_nipple);
  const bool from_cc = matcher.from_frame().view == "CC";
  return PatientViews(from_cc ? std::move(cc) : std::move(mlo),
                      from_cc ? std::move(mlo) : std::move(cc), matcher);
}

void report_pair(const Choices& choices, const MatchQuery& query, const Matcher& matcher, Beam beam,
                 Run& run) {
  const Matcher backward(matcher.to(), matcher.from(), beam);
  const PairPoint pair = locate_pair(matcher, backward, query.from_uv, *query.truth);
  report_spot(pair, matcher, run.report());
  if (choices.supine.empty()) return;
  const HexMesh supine = read_mesh(choices.supine);
  if (supine.connectivity != matcher.from().connectivity) {
    throw input_error(choices.supine.string(), ": not a shape of the same mesh");
  }
  run.report().set("spot/supine", pair.position(supine, supine.points));
}

struct Derivatives {
  DerivativeFields from, to;
};

std::optional<BandModel> band_model(const Choices& choices, const Matcher& matcher,
                                    const PatientViews* patient, Derivatives& derivatives) {
  if (!choices.band) return std::nullopt;
  derivatives.from = read_derivatives(choices.from, matcher.from()).position;
  derivatives.to = read_derivatives(choices.to, matcher.to()).position;
  std::vector<Prior> priors =
      choices.priors.empty() ? default_priors()
                             : priors_from(read_table(choices.priors), choices.priors.string());
  if (patient != nullptr) priors = patient->with_alignment(std::move(priors));
  return std::optional<BandModel>(std::in_place, matcher, derivatives.from, derivatives.to,
                                  std::move(priors));
}

void run_match(const Choices& choices, Run& run) {
  const HexMesh from = read_mesh(choices.from, {.contact = true});
  const HexMesh to = read_mesh(choices.to, {.contact = true});
  const Beam beam = choices.geometry == "cone" ? Beam::cone : Beam::parallel;
  const Matcher matcher(from, to, beam);
  const std::optional<PatientViews> views = [&] {
    Timer::Scope phase(run.timer(), "align");
    return patient_views(choices, matcher);
  }();
  const PatientViews* patient = views ? &*views : nullptr;
  if (patient != nullptr) {
    patient->report(run.report());
    for (const std::string& doubt : patient->doubts()) run.warn(doubt);
  }
  Derivatives derivatives;
  const std::optional<BandModel> band = band_model(choices, matcher, patient, derivatives);
  int behind = 0;
  const auto queries = choices.question.queries(matcher, patient, behind);
  if (behind > 0) run.report().set("truth/behind_first_image", behind);
  const double start = run.seconds();
  const auto results = match_queries(matcher, queries, band ? &*band : nullptr);
  run.report().set("milliseconds_per_curve", 1e3 * (run.seconds() - start) /
                                                 double(std::max<std::size_t>(queries.size(), 1)));
  for (const std::string& doubt : match_doubts(matcher, results)) run.warn(doubt);
  if (band && !band->without().empty()) run.warn(band->what_is_missing());
  if (results.size() == 1) report_match(results[0], run.report());
  report_truth(results, run.report());
  if (!choices.question.pair.empty()) report_pair(choices, queries[0], matcher, beam, run);
  PolyLines lines = curve_lines(matcher, results);
  lines.history = run.history({{choices.from, from.content_sha256, &from.history},
                               {choices.to, to.content_sha256, &to.history}});
  Table table = curve_table(matcher, results);
  if (!choices.question.truth.empty()) add_truth_summary(results, table);
  choices.table.empty() ? run.print(table.text()) : write_table(choices.table, table);
  if (!choices.curve_table.empty()) {
    write_table(choices.curve_table, curve_points_table(matcher, results, patient));
  }
  if (!choices.picture.empty()) {
    write_picture_png(choices.picture, patient->picture(matcher, results));
  }
  write_polylines(choices.curve, lines);
}

void declare_images(Tool& tool, Choices& choices) {
  tool.describe(
      "With --cc-image and --mlo-image, the patient's own mammograms, points are pixels of these "
      "(column,row from the centre of the top left one). Each simulated view is laid over its "
      "image "
      "by a similarity (rotation, translation, scale) that fits the breast's outline, the nipple "
      "and the chest-wall edge; what is left is added to the band. View, side and pixel spacing of "
      "the headers must fit the meshes; thickness and angle are compared (compress --like). The "
      "picture shows the simulated outline as laid over (magenta), curve and bands (yellow), arc "
      "(blue) and nipple (cross).");
  tool.input_file(choices.cc_image, "--cc-image", "CC.dcm", "the patient's CC mammogram");
  tool.input_file(choices.mlo_image, "--mlo-image", "MLO.dcm",
                  "the patient's mammogram of the other view");
  tool.numbers(choices.cc_nipple, "--cc-nipple", "x,y", 2,
               "nipple in the CC image in pixels; without, its most anterior part");
  tool.numbers(choices.mlo_nipple, "--mlo-nipple", "x,y", 2, "the same in the other image");
  tool.output_file(choices.picture, "--picture", "OUT.png", "the second image with what was found");
  tool.output_file(choices.curve_table, "--curve-table", "OUT.tsv",
                   "every point of the curves: mm, deviation, pixels of the second image");
}

void declare(Tool& tool, Choices& choices) {
  tool.describe(
      "A point of the CC mammogram is the shadow of a column of tissue. The column is followed "
      "through the material to the MLO compression and projected there: the point must lie on that "
      "curve. Views follow from the files: any two compressions of one mesh will do, in either "
      "order. Beside the curve the rules radiologists use: the arc of equal distance from the "
      "nipple and the straight line of equal depth behind it. u and v are mm from the origin "
      "stored in the mammogram. The table goes to stdout or --table.");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), section IV-A, Figs 6 and 7");
  tool.input(choices.from, "CC.vtkhdf", "compression in which the point is marked");
  tool.input(choices.to, "MLO.vtkhdf", "compression of the same mesh in another view");
  tool.output(choices.curve, "CURVE.vtp", "curve, arc, line, chord and the column in every shape");
  tool.numbers(choices.question.point, "--point", "u,v", 2, "point of the first image in mm");
  tool.numbers(choices.question.pair, "--pair", "u,v,u,v", 4,
               "the same spot in both images: also its place in the body, with residuals");
  tool.input_file(choices.supine, "--supine", "SUPINE.vtkhdf", "with --pair: the spot there too");
  tool.text(
      choices.question.landmark, "--landmark", "NAME",
      "projection of this landmark of the meshes, such as tumour; its own place in the second "
      "view is compared");
  tool.input_file(choices.question.points, "--points", "FILE",
                  "TSV with u_mm, v_mm (with --cc-image x_px, y_px) and perhaps name");
  tool.input_file(
      choices.question.truth, "--truth", "FILE",
      "TSV of true positions: landmark, side, cc_x_mm ... mlo_z_mm (truth-table): distances of the "
      "true place from curve, chord, arc and line, a row a landmark, then mean, 95 % and largest, "
      "and the part of them in the bands");
  tool.integer(choices.question.grid, "--grid", "N",
               "N x N points over the tissue of the first image", 0, 200);
  tool.flag(choices.band, "--band",
            "50 % and 95 % bands from parameters, thickness, angle, chest wall and marking "
            "(derivatives in the "
            "files by sensitivity and difference)");
  tool.input_file(choices.priors, "--priors", "FILE",
                  "TSV parameter, standard_deviation (1: relative, degree or mm) for --band");
  tool.choice(choices.geometry, "--geometry", {"parallel", "cone"},
              "beam, as in project-mammogram");
  tool.output_file(choices.table, "--table", "OUT.tsv", "one row per point");
  declare_images(tool, choices);
  tool.describe(default_priors_text());
  tool.check([&] { choices.check(); });
  tool.example("cc2mlo cc.vtkhdf mlo.vtkhdf curve.vtp --landmark tumour --table curve.tsv",
               "where the tumour seen in CC lies in MLO");
  tool.example("cc2mlo cc.vtkhdf mlo.vtkhdf curve.vtp --pair 31,52,35,48 --supine supine.vtkhdf",
               "a spot marked in both views: its place in the MR scan and supine");
  tool.example(
      "cc2mlo cc.vtkhdf mlo.vtkhdf curve.vtp --cc-image CC.dcm --mlo-image MLO.dcm --point "
      "812,1303 "
      "--picture where.png --curve-table where.tsv",
      "a pixel of the patient's CC mammogram, and where it may lie in the MLO one");
}

}  // namespace

int main(int argc, char** argv) {
  Choices choices;
  Tool tool("cc2mlo", "where a point of one mammogram lies in another view");
  declare(tool, choices);
  return tool.main(argc, argv, [&](Run& run) { run_match(choices, run); });
}
