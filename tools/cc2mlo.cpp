// cc2mlo: the curve in the MLO mammogram on which a point of the CC mammogram must lie.
#include <algorithm>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "io/mesh_file.hpp"
#include "io/surface_file.hpp"
#include "mammo/curve_lines.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path cc, mlo, curve, table;
  std::vector<double> point;
  std::string landmark;
  int grid = 0;

  void check() const {
    if (int(!point.empty()) + int(!landmark.empty()) + int(grid > 0) != 1) {
      throw input_error("give exactly one of --point u,v, --landmark NAME and --grid N");
    }
  }
};

std::vector<MatchQuery> queries_of(const Choices& choices, const Matcher& matcher,
                                   const HexMesh& mesh) {
  if (choices.grid > 0) return grid_queries(matcher, choices.grid);
  if (!choices.point.empty()) return {{Vec2(choices.point[0], choices.point[1]), ""}};
  const auto uv = matcher.cc_landmark(choices.landmark);
  if (!uv) {
    std::string names;
    for (const Landmark& landmark : mesh.landmarks) names += " " + landmark.name;
    throw input_error(choices.cc.string(), ": no landmark \"", choices.landmark,
                      "\"; it has:", names.empty() ? " none" : names);
  }
  return {{*uv, choices.landmark}};
}

void report_result(const MatchResult& result, Run& run) {
  Report& report = run.report();
  const auto pair = [](const Vec2& uv) { return std::vector<double>{uv.x(), uv.y()}; };
  report.set("cc_uv_mm", pair(result.query.cc_uv));
  report.set("column_mm", result.curve.points.back().depth);
  report.set("curve_points", result.curve.points.size());
  report.set("curve_mm", result.curve.length);
  report.set("chord_mm", result.curve.chord);
  report.set("max_bend_mm", result.curve.max_deviation);
  if (result.nipple_distance > 0) report.set("nipple_distance_mm", result.nipple_distance);
  if (result.truth) {
    report.set("true_uv_mm", pair(*result.truth));
    report.set("true_to_curve_mm", result.truth_to_curve);
    report.set("true_to_chord_mm", result.truth_to_chord);
    report.set("true_to_arc_mm", result.truth_to_arc);
  }
}

void judge(const std::vector<MatchResult>& results, const Matcher& matcher, Run& run) {
  if (results.empty())
    throw input_error("no point of the grid lies on tissue; use a larger --grid");
  const auto is = [](const char* status) {
    return [status](const MatchResult& result) { return result.status() == status; };
  };
  if (results.size() == 1 && results[0].curve.in_air()) {
    const Vec2& uv = results[0].query.cc_uv;
    throw input_error("CC point (", format_fixed(uv.x(), 2), ", ", format_fixed(uv.y(), 2),
                      ") mm lies in air; the image spans 0-",
                      format_fixed(matcher.cc_frame().width, 1), " x 0-",
                      format_fixed(matcher.cc_frame().height, 1), " mm");
  }
  const auto back = std::count_if(results.begin(), results.end(), is("through_chest_wall"));
  if (back > 0) {
    run.warn(message(back, " of ", results.size(),
                     " columns leave the mesh through the chest wall:"
                     " their curves end there though the tissue does not"));
  }
  if (!matcher.cc_landmark("nipple") || !matcher.mlo_landmark("nipple")) {
    run.warn("the meshes have no nipple landmark: no equal-distance arc");
  }
  run.report().set("queries", results.size());
  run.report().set("matched",
                   std::size_t(std::count_if(results.begin(), results.end(), is("matched"))));
}

void run_match(const Choices& choices, Run& run) {
  const HexMesh cc = read_mesh(choices.cc, {.contact = true});
  const HexMesh mlo = read_mesh(choices.mlo, {.contact = true});
  const Matcher matcher(cc, mlo);
  std::vector<MatchResult> results;
  {
    Timer::Scope phase(run.timer(), "match");
    for (const MatchQuery& query : queries_of(choices, matcher, cc)) {
      results.push_back(match_query(matcher, query));
    }
  }
  judge(results, matcher, run);
  if (results.size() == 1) report_result(results[0], run);
  PolyLines lines = curve_lines(matcher, results);
  lines.history = run.history({{choices.cc, cc.content_sha256, &cc.history},
                               {choices.mlo, mlo.content_sha256, &mlo.history}});
  const Table table = curve_table(results);
  if (choices.table.empty()) {
    run.print(table.text());
  } else {
    write_table(choices.table, table);
  }
  write_polylines(choices.curve, lines);
}

}  // namespace

int main(int argc, char** argv) {
  Choices choices;
  Tool tool("cc2mlo", "the MLO curve of a point in the CC mammogram");
  tool.describe(
      "A point of the CC mammogram is the shadow of a column of tissue. The column is followed "
      "through the material to the MLO compression and projected there: the point must lie on that "
      "curve. Beside it the arc of equal distance from the nipple, which radiologists use. u and v "
      "are mm from the origin stored in the mammogram. The table goes to stdout or --table.");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), section IV-A, Figs 6 and 7");
  tool.input(choices.cc, "CC.vtkhdf", "craniocaudal compression (compress --view CC)");
  tool.input(choices.mlo, "MLO.vtkhdf",
             "oblique compression of the same mesh (compress --view MLO)");
  tool.output(choices.curve, "CURVE.vtp", "curve, arc, chord and the column in every shape");
  tool.numbers(choices.point, "--point", "u,v", 2, "point of the CC image in mm");
  tool.text(choices.landmark, "--landmark", "NAME",
            "projection of this landmark of the meshes, such as tumour; its true MLO position is "
            "compared");
  tool.integer(choices.grid, "--grid", "N", "N x N points over the tissue of the CC image", 0, 200);
  tool.output_file(choices.table, "--table", "OUT.tsv", "one row per point");
  tool.check([&] { choices.check(); });
  tool.example("cc2mlo cc.vtkhdf mlo.vtkhdf curve.vtp --landmark tumour --table curve.tsv",
               "where the tumour seen in CC lies in MLO");
  tool.example("cc2mlo cc.vtkhdf mlo.vtkhdf curves.vtp --point 42.5,61", "any point of the image");
  return tool.main(argc, argv, [&](Run& run) { run_match(choices, run); });
}
