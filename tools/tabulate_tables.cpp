// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of the paper and of studies.
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text/lists.hpp"
#include "evaluation/curve_distance.hpp"
#include "io/mesh_file.hpp"
#include "io/surface_file.hpp"
#include "study/cells.hpp"
#include "study/experiments/budget.hpp"
#include "study/experiments/compressions.hpp"
#include "study/experiments/cost.hpp"
#include "study/experiments/coverage.hpp"
#include "study/experiments/draws.hpp"
#include "study/experiments/leaveout.hpp"
#include "study/experiments/outcomes.hpp"
#include "study/experiments/pressed.hpp"
#include "study/paper/changed_set.hpp"
#include "study/paper/conclusions.hpp"
#include "study/paper/findings.hpp"
#include "study/paper/scaled_table.hpp"
#include "study/paper/slopes.hpp"
#include "tabulate_kinds.hpp"

namespace breast {

namespace {

using Request = TabulateRequest;

Shape read_shape(const std::filesystem::path& file) {
  const HexMesh mesh = read_mesh(file);
  Shape shape;
  for (const Landmark& landmark : mesh.landmarks)
    shape.push_back({landmark.name, landmark_position(mesh, mesh.imaged, landmark),
                     landmark_position(mesh, mesh.points, landmark)});
  return shape;
}

CurveGap curve_gap(const std::filesystem::path& curve, const std::filesystem::path& base) {
  const Distances both =
      compare_curves(read_polylines(curve), read_polylines(base), curve.string(), base.string())
          .both;
  return {both.mean_mm, both.max_mm};
}

std::string calibrated_words(const Request& request) {
  return request.calibrated.empty() ? "" : "calibrated to this row";
}

// NAME=FILE.
JudgedModel model_of(const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos) throw input_error("judge: '", word, "' is not NAME=VALUES.tsv");
  return {word.substr(0, equals), read_table(word.substr(equals + 1))};
}

std::string judged(const Request& r) {
  std::vector<JudgedModel> models;
  for (const std::string& word : r.rest(1)) models.push_back(model_of(word));
  return judge(r.table(0), models).text();
}

std::string conclusions_rows(const Request& r) {
  const bool printed = r.words.size() > 2;
  if (printed && r.word(2) != "as-printed")
    throw input_error("conclusions: '", r.word(2), "' is not as-printed");
  return judged_tables(r.table(0), r.word(1), printed).text();
}

std::string calibration(const Request& r) {
  const std::filesystem::path truth = r.word(1);
  const std::filesystem::path folder =
      truth.string().substr(0, truth.string().size() - truth.extension().string().size()) +
      "-truth";
  return calibration_table(r.word(0), truth, r.word(2), read_table(folder / "landmarks.tsv"))
      .text();
}

std::string accuracy(const Request& r) {
  const auto row = accuracy_row(r.word(0), r.word(1), r.words.size() > 3 ? r.word(3) : "",
                                parse_number(r.word(2), "accuracy: MM"), read_shape);
  if (!row) return "";
  std::vector<std::string> columns;
  for (std::size_t c = 0; c < row->size(); ++c) columns.push_back(std::to_string(c));
  const std::string with_header = Table{columns, {*row}}.text();
  return with_header.substr(with_header.find('\n') + 1);
}

std::string least(const Request& r) {
  std::vector<std::string> names;
  for (const PartChange& part :
       least_model(changes(r.table(0), r.word(1), r.rest(3)), parse_number(r.word(2), "least: MM")))
    names.push_back(part.part);
  return join(names, " ");
}

std::string coverage_rows(const Request& r) {
  std::vector<BandRows> files;
  for (const std::string& file : r.words)
    files.push_back(read_band_rows(read_text(file), std::filesystem::path(file).stem()));
  return coverage_table(files).text();
}

std::string identification(const Request& r) {
  std::vector<Table> studies;
  for (const std::string& file : r.words) studies.push_back(read_table(file));
  return identification_table(studies).text();
}

std::string pressed(const Request& r) {
  const auto number = [&](std::size_t i) { return parse_number(r.word(i), "pressed"); };
  return pressed_table({r.word(1), number(2), number(3), r.word(4), int(number(5)), number(6)},
                       r.table(0))
      .text();
}

}  // namespace

std::vector<TabulateKind> table_kinds() {
  return {
      {"scaled", "PAPER.tsv PREFIX BASE.vtkhdf",
       "one of Tables III to VI: our results from PREFIX-PERCENT/supine.vtkhdf beside the paper's",
       3, 3,
       [](const Request& r) {
         return scaled_table(r.table(0), r.word(1), r.word(2), read_shape, calibrated_words(r))
             .text();
       }},
      {"constants", "PAPER.tsv MATERIALS.tsv", "Table II: the constants used beside the paper's", 2,
       2, [](const Request& r) { return constants_table(r.table(0), r.table(1)).text(); }},
      {"set", "fat-only|columns MATERIALS.tsv", "a material set as a study changes it", 2, 2,
       [](const Request& r) { return changed_set(r.table(1), r.word(0)).text(); }},
      {"slopes", "SUPINE.json SCALED SLOPES.tsv TUMOUR-SLOPES.tsv",
       "Table VII: slopes from one solve compared with solving again", 4, 4,
       [](const Request& r) {
         return slopes_table(r.word(0), r.word(1), r.table(2), r.table(3)).text();
       }},
      {"conclusions", "CONCLUSIONS.tsv TABLES [as-printed]",
       "whether the paper's conclusions hold for its own rows of Tables III to VI in the folder "
       "TABLES, for ours as printed, and for ours",
       2, 3, conclusions_rows},
      {"judge", "CONCLUSIONS.tsv NAME=VALUES.tsv...",
       "whether the conclusions hold for each of these sets of values", 2, any_number, judged},
      {"survival", "CONCLUSIONS.tsv RUN SET...",
       "Table VIII: the conclusions with the material sets of RUN/studies/table8", 3, any_number,
       [](const Request& r) {
         return survival_table(
                    r.table(0),
                    {read_table(r.own("paper/table3.tsv")), read_table(r.own("paper/table6.tsv"))},
                    r.word(1), read_shape, r.rest(2), calibrated_words(r))
             .text();
       }},
      {"findings", "RUN VARIANT...",
       "effect of numerical choices on the paper's results; the last variant is the finest", 2,
       any_number, [](const Request& r) { return findings_table(r.word(0), r.rest(1)).text(); }},
      {"calibration", "RUN PHANTOM.json SIDE",
       "values to which the preset was fitted, beside the motion of its truth", 3, 3, calibration},
      {"budget", "RUN ROW...",
       "errors that remain when one stage is replaced by the truth (RUN/budget/ROW)", 2, any_number,
       [](const Request& r) { return budget_table(r.word(0), r.rest(1)).text(); }},
      {"convergence", "FOLDER N...",
       "distances of the compressed shapes FOLDER/N-CC and N-MLO from those of the last N", 2,
       any_number,
       [](const Request& r) { return convergence_table(r.word(0), r.rest(1), read_shape).text(); }},
      {"compressions", "REPORT.json...",
       "breasts between plates, one row per report of compress: forces, pressure, coverage and "
       "penetration",
       1, any_number,
       [](const Request& r) {
         const std::vector<std::string> reports = r.rest(0);
         return compressions_table({reports.begin(), reports.end()}).text();
       }},
      {"plates", "FOLDER BASE|next VARIANT...",
       "the same for variants of one compression, FOLDER/VARIANT/{cc,mlo}, with the distances of "
       "tumour and nipple from those of the variant BASE or of the next one",
       3, any_number,
       [](const Request& r) {
         return plates_table(r.word(0), r.word(1), r.rest(2), read_shape).text();
       }},
      {"cost", "FOLDER FINEST POINT...",
       "error against run time for the points ELEMENT-TEMPLATE-N[-SOLVER]", 3, any_number,
       [](const Request& r) {
         return cost_table(r.word(0), r.word(1), r.rest(2), read_shape).text();
       }},
      {"accuracy", "FOLDER POINT MM [COARSER]",
       "row of one discretisation tried by ACCURACY, without header; nothing if it has no "
       "solution",
       3, 4, accuracy},
      {"leaveout", "RUN VARIANT...",
       "change in mm and time saved in s by each variant of "
       "RUN/studies/leaveout",
       2, any_number,
       [](const Request& r) {
         return leaveout_table(r.word(0), r.rest(1), read_shape, curve_gap).text();
       }},
      {"least", "TABLE.tsv surgery|matching MM PART...",
       "parts of the model that can be left out while their changes add up to no more than MM", 4,
       any_number, least},
      {"recommendation", "RUN MM PART...",
       "those parts, the sum of their changes, and the change in RUN/studies/leaveout/least-QUESTION",
       3, any_number,
       [](const Request& r) {
         return recommendation(r.word(0), parse_number(r.word(1), "recommendation: MM"), r.rest(2),
                               read_shape, curve_gap)
             .text();
       }},
      {"wall", "RUN VARIANT...",
       "motion of positions when the chest wall moves by its own standard deviation "
       "(RUN/studies/wall/VARIANT)",
       2, any_number, [](const Request& r) { return wall_table(r.word(0), r.rest(1)).text(); }},
      {"coverage", "ROWS.tsv...",
       "percentage of true positions inside the band, with its 95 % interval", 1, any_number,
       coverage_rows},
      {"identification", "ROWS.tsv...",
       "results of identify for known truths, one row per study and truth", 1, any_number,
       identification},
      {"pressed", "OURS.tsv SCENE GAP REACHED FORCE ITERATIONS SECONDS",
       "block pressed between plates: CalculiX (results given as arguments) beside ours", 7, 7,
       pressed},
      {"study", "FOLDER LANDMARK,... VARIANT...",
       "outcome of every stage in the variants FOLDER/VARIANT", 3, any_number,
       [](const Request& r) {
         return outcomes_table(r.word(0), split(r.word(1), ','), r.rest(2), read_shape).text();
       }},
      {"stability", "MECHANICS.tsv CONTACT.tsv", "one page with the outcome of every extreme case",
       2, 2, [](const Request& r) { return stability_table(r.table(0), r.table(1)).text(); }},
  };
}

}  // namespace breast
