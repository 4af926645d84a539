// cc2mlo: the curve in one mammogram on which a point of another must lie.
#include <algorithm>
#include <optional>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "io/derivative_file.hpp"
#include "io/mesh_file.hpp"
#include "io/surface_file.hpp"
#include "mammo/curve_lines.hpp"
#include "mammo/point_pair.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path from, to, curve, table, points, truth, supine, priors;
  std::vector<double> point, pair;
  std::string landmark, geometry = "parallel";
  int grid = 0;
  bool band = false;

  void check() const {
    const int questions = int(!point.empty()) + int(!pair.empty()) + int(!landmark.empty()) +
                          int(grid > 0) + int(!points.empty()) + int(!truth.empty());
    if (questions != 1) {
      throw input_error(
          "give exactly one of --point u,v, --pair u,v,u,v, --landmark NAME, --points FILE, "
          "--truth "
          "FILE and --grid N");
    }
    if (!priors.empty() && !band) throw input_error("--priors is for --band");
    if (!supine.empty() && pair.empty()) throw input_error("--supine is for --pair");
  }
};

std::vector<MatchQuery> queries_of(const Choices& choices, const Matcher& matcher) {
  if (choices.grid > 0) return grid_queries(matcher, choices.grid);
  if (!choices.points.empty()) {
    return point_queries(read_table(choices.points), choices.points.string());
  }
  if (!choices.truth.empty()) {
    return truth_queries(matcher, read_table(choices.truth), choices.truth.string());
  }
  const std::vector<double>& mark = choices.pair.empty() ? choices.point : choices.pair;
  if (mark.size() >= 2) {
    MatchQuery query{{mark[0], mark[1]}, "", std::nullopt};
    if (mark.size() == 4) query.truth = Vec2(mark[2], mark[3]);
    return {query};
  }
  return {landmark_query(matcher, choices.landmark)};
}

void report_pair(const Choices& choices, const Matcher& matcher, Beam beam, Run& run) {
  const Matcher backward(matcher.to(), matcher.from(), beam);
  const PairPoint pair = locate_pair(matcher, backward, {choices.pair[0], choices.pair[1]},
                                     {choices.pair[2], choices.pair[3]});
  report_spot(pair, matcher, run.report());
  if (choices.supine.empty()) return;
  const HexMesh supine = read_mesh(choices.supine);
  if (supine.connectivity != matcher.from().connectivity) {
    throw input_error(choices.supine.string(), ": not a shape of the same mesh");
  }
  run.report().set("spot/supine", pair.position(supine, supine.points));
}

void run_match(const Choices& choices, Run& run) {
  const HexMesh from = read_mesh(choices.from, {.contact = true});
  const HexMesh to = read_mesh(choices.to, {.contact = true});
  const Beam beam = choices.geometry == "cone" ? Beam::cone : Beam::parallel;
  const Matcher matcher(from, to, beam);
  std::optional<BandModel> band;
  DerivativeFields from_derivatives, to_derivatives;
  if (choices.band) {
    from_derivatives = read_derivatives(choices.from, from).position;
    to_derivatives = read_derivatives(choices.to, to).position;
    band.emplace(matcher, from_derivatives, to_derivatives,
                 choices.priors.empty()
                     ? default_priors()
                     : priors_from(read_table(choices.priors), choices.priors.string()));
  }
  const std::vector<MatchQuery> queries = queries_of(choices, matcher);
  std::vector<MatchResult> results(queries.size());
  {
    Timer::Scope phase(run.timer(), "match");
    const double start = run.seconds();
#pragma omp parallel for schedule(dynamic, 4)
    for (std::size_t q = 0; q < queries.size(); ++q) {
      results[q] = match_query(matcher, queries[q], band ? &*band : nullptr);
    }
    run.report().set(
        "milliseconds_per_curve",
        1e3 * (run.seconds() - start) / double(std::max<std::size_t>(queries.size(), 1)));
  }
  for (const std::string& doubt : match_doubts(matcher, results)) run.warn(doubt);
  if (band && !band->without().empty()) run.warn(band->what_is_missing());
  if (results.size() == 1) report_match(results[0], run.report());
  report_truth(results, run.report());
  if (!choices.pair.empty()) report_pair(choices, matcher, beam, run);
  PolyLines lines = curve_lines(matcher, results);
  lines.history = run.history({{choices.from, from.content_sha256, &from.history},
                               {choices.to, to.content_sha256, &to.history}});
  const Table table = curve_table(matcher, results);
  choices.table.empty() ? run.print(table.text()) : write_table(choices.table, table);
  write_polylines(choices.curve, lines);
}

}  // namespace

int main(int argc, char** argv) {
  Choices choices;
  Tool tool("cc2mlo", "where a point of one mammogram lies in another view");
  tool.describe(
      "A point of the CC mammogram is the shadow of a column of tissue. The column is followed "
      "through the material to the MLO compression and projected there: the point must lie on that "
      "curve. Views follow from the files: any two compressions of one mesh will do, in either "
      "order. Beside the curve the rules radiologists use: the arc of equal distance from the "
      "nipple and the straight line of equal depth behind it. u and v are mm from the origin "
      "stored "
      "in the mammogram. The table goes to stdout or --table.");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), section IV-A, Figs 6 and 7");
  tool.input(choices.from, "CC.vtkhdf", "compression in which the point is marked");
  tool.input(choices.to, "MLO.vtkhdf", "compression of the same mesh in another view");
  tool.output(choices.curve, "CURVE.vtp", "curve, arc, line, chord and the column in every shape");
  tool.numbers(choices.point, "--point", "u,v", 2, "point of the first image in mm");
  tool.numbers(choices.pair, "--pair", "u,v,u,v", 4,
               "the same spot in both images: also its place in the body, with residuals");
  tool.input_file(choices.supine, "--supine", "SUPINE.vtkhdf", "with --pair: the spot there too");
  tool.text(
      choices.landmark, "--landmark", "NAME",
      "projection of this landmark of the meshes, such as tumour; its own place in the second "
      "view is compared");
  tool.input_file(choices.points, "--points", "FILE", "TSV with u_mm, v_mm and perhaps name");
  tool.input_file(
      choices.truth, "--truth", "FILE",
      "TSV of true positions: landmark, side, cc_x_mm ... mlo_z_mm; errors are reported");
  tool.integer(choices.grid, "--grid", "N", "N x N points over the tissue of the first image", 0,
               200);
  tool.flag(choices.band, "--band",
            "50 % and 95 % bands from parameters, thickness, angle and marking (derivatives in the "
            "files by sensitivity)");
  tool.input_file(choices.priors, "--priors", "FILE",
                  "TSV parameter, standard_deviation (1: relative, degree or mm) for --band");
  tool.choice(choices.geometry, "--geometry", {"parallel", "cone"},
              "beam, as in project-mammogram");
  tool.output_file(choices.table, "--table", "OUT.tsv", "one row per point");
  tool.check([&] { choices.check(); });
  tool.example("cc2mlo cc.vtkhdf mlo.vtkhdf curve.vtp --landmark tumour --table curve.tsv",
               "where the tumour seen in CC lies in MLO");
  tool.example("cc2mlo cc.vtkhdf mlo.vtkhdf curve.vtp --pair 31,52,35,48 --supine supine.vtkhdf",
               "a spot marked in both views: its place in the MR scan and supine");
  return tool.main(argc, argv, [&](Run& run) { run_match(choices, run); });
}
