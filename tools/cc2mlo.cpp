// SPDX-License-Identifier: GPL-3.0-or-later
// cc2mlo: the curve in one mammogram on which a point of another must lie.
#include <algorithm>
#include <optional>

#include "cc2mlo_options.hpp"
#include "core/error.hpp"
#include "core/own_file.hpp"
#include "core/table.hpp"
#include "io/derivative_file.hpp"
#include "io/mammogram_dicom.hpp"
#include "io/mesh_file.hpp"
#include "io/picture_file.hpp"
#include "io/surface_file.hpp"
#include "matching/band_materials.hpp"
#include "matching/curve_lines.hpp"
#include "matching/point_pair.hpp"
#include "material/material_set.hpp"
#include "mesh/part.hpp"
#include "mesh/surroundings.hpp"
#include "tool_pairs.hpp"

using namespace breast;

namespace {

Origin origin_of(const std::filesystem::path& file, const MammogramHeader& header) {
  Origin origin{file};
  origin.side = header.side;
  origin.patient = header.patient_id;
  return origin;
}

// The patient's mammograms, in the order of the meshes.
std::optional<PatientViews> patient_views(const MatchChoices& choices, const Matcher& matcher,
                                          Pairs& pairs) {
  if (choices.cc_image.empty()) return std::nullopt;
  const auto image = [](const std::filesystem::path& file, const std::vector<double>& nipple) {
    PatientImage read{read_mammogram_dicom(file), file.string(), std::nullopt};
    if (!nipple.empty()) read.nipple = Vec2(nipple[0], nipple[1]);
    return read;
  };
  PatientImage cc = image(choices.cc_image, choices.cc_nipple),
               mlo = image(choices.mlo_image, choices.mlo_nipple);
  const Origin of_cc = origin_of(choices.cc_image, cc.scan.header),
               of_mlo = origin_of(choices.mlo_image, mlo.scan.header);
  pairs.check("CC", breast::origin_of(choices.from, matcher.from()), "--cc-image", of_cc);
  pairs.check("MLO", breast::origin_of(choices.to, matcher.to()), "--mlo-image", of_mlo);
  pairs.check("--cc-image", of_cc, "--mlo-image", of_mlo);
  const bool from_cc = matcher.from_frame().view == View::cc;
  return PatientViews(from_cc ? std::move(cc) : std::move(mlo),
                      from_cc ? std::move(mlo) : std::move(cc), matcher);
}

void report_pair(const MatchChoices& choices, const MatchQuery& query, const Matcher& matcher,
                 Beam beam, Pairs& pairs, Run& run) {
  const Matcher backward(matcher.to(), matcher.from(), beam);
  const PairPoint pair = locate_pair(matcher, backward, query.from_uv, *query.place);
  report_spot(pair, matcher, run.report());
  if (choices.supine.empty()) return;
  const HexMesh supine = restricted(read_mesh(choices.supine), breast_elements);
  pairs.check("CC", breast::origin_of(choices.from, matcher.from()), "--supine",
              breast::origin_of(choices.supine, supine));
  run.report().set("spot/supine", pair.position(supine, supine.points));
}

struct Derivatives {
  DerivativeFields from, to;
};

// The covariance of a material set, which replaces the priors of its stiffness and supports: of
// --materials, or without --priors of the set with which the first shape was solved. Empty if there is
// none.
SoftnessUncertainty known_softness(const MatchChoices& choices, const HexMesh& from, Run& run) {
  if (choices.materials.empty() && !choices.priors.empty()) return {};
  if (choices.materials.empty() && !from.model) {
    throw input_error(choices.from.string(),
                      ": does not state the model with which it was solved (group /breast/model); "
                      "with --band, give --materials NAME|FILE or --priors FILE");
  }
  const MaterialSet set =
      choices.materials.empty()
          ? read_materials(parse_table(from.model->materials,
                                       choices.from.string() + ", group /breast/model, materials"),
                           from.model->name)
          : load_materials(choices.materials);
  if (!set.uncertainty.parameters.empty()) {
    run.report().set("band/covariance_of", set.name);
  } else if (!choices.materials.empty()) {
    run.warn(
        "--materials " + choices.materials +
        ": the set has no covariance (identify and calibrate-softness write one); the priors of "
        "stiffness and supports stand");
  }
  return set.uncertainty;
}

std::optional<BandModel> band_model(const MatchChoices& choices, const Matcher& matcher,
                                    const PatientViews* patient, Derivatives& derivatives,
                                    Run& run) {
  if (!choices.band) return std::nullopt;
  derivatives.from = read_derivatives(choices.from, matcher.from()).position;
  derivatives.to = read_derivatives(choices.to, matcher.to()).position;
  std::vector<Prior> priors =
      choices.priors.empty() ? default_priors()
                             : priors_from(read_table(choices.priors), choices.priors.string());
  const SoftnessUncertainty known = known_softness(choices, matcher.from(), run);
  if (!known.parameters.empty())
    use_covariance(known.parameters, known.covariance, derivatives.from, derivatives.to, priors);
  if (patient != nullptr) priors = patient->with_alignment(std::move(priors));
  std::optional<BandModel> band(std::in_place, matcher, derivatives.from, derivatives.to,
                                std::move(priors));
  if (band->counts_marks_only()) {
    throw input_error("--band: ", choices.from.string(), " and ", choices.to.string(),
                      " have no derivatives in common, so that the band would only include "
                      "errors of marking; give the files that sensitivity writes for both "
                      "compressions, or omit --band");
  }
  return band;
}

// With a truth, a printed table ends with its statistics. A written table has them in a separate
// file, so that each of its columns contains one kind of value.
void print_or_write(Table table, const std::vector<MatchResult>& results,
                    const MatchChoices& choices, Run& run) {
  const bool judged = !choices.question.truth.empty();
  if (choices.table.empty()) {
    if (judged) add_statistics(truth_statistics(results), table);
    run.print(table.text());
    return;
  }
  write_table(choices.table, table);
  if (!judged) return;
  const std::filesystem::path summary =
      choices.table.parent_path() / (choices.table.stem().string() + "-summary.tsv");
  check_replaceable(summary, "--table");
  write_table(summary, truth_statistics(results));
}

// The patient's images without marks, as far as they are asked for.
void write_hung(const MatchChoices& choices, const PatientViews& patient, bool from_cc) {
  const AlignedView &cc = from_cc ? patient.from() : patient.to(),
                    &mlo = from_cc ? patient.to() : patient.from();
  if (!choices.cc_hung.empty()) write_picture_png(choices.cc_hung, cc.hung());
  if (!choices.mlo_hung.empty()) write_picture_png(choices.mlo_hung, mlo.hung());
}

void run_match(const MatchChoices& choices, Run& run) {
  const HexMesh from = read_mesh(choices.from, {.contact = true});
  const HexMesh to = read_mesh(choices.to, {.contact = true});
  const Beam beam = choices.geometry == "cone" ? Beam::cone : Beam::parallel;
  run.report().set("side", side_name(from.side));
  Pairs pairs = pairs_of("cc2mlo", run, choices.accept_other);
  pairs.check("CC", breast::origin_of(choices.from, from), "MLO",
              breast::origin_of(choices.to, to));
  if (!choices.question.truth.empty()) {
    const Table truth = read_table(choices.question.truth);
    pairs.check("CC", breast::origin_of(choices.from, from), "--truth",
                origin_of_truth(choices.question.truth, truth, from.side));
  }
  const Matcher matcher(from, to, beam);
  const std::optional<PatientViews> views = [&] {
    Timer::Scope phase(run.timer(), "align");
    return patient_views(choices, matcher, pairs);
  }();
  const PatientViews* patient = views ? &*views : nullptr;
  if (patient != nullptr) {
    patient->report(run.report());
    for (const std::string& remark : patient->remarks()) run.remark(remark);
    for (const std::string& doubt : patient->doubts()) run.warn(doubt);
  }
  Derivatives derivatives;
  const std::optional<BandModel> band = band_model(choices, matcher, patient, derivatives, run);
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
  if (!choices.question.pair.empty()) report_pair(choices, queries[0], matcher, beam, pairs, run);
  PolyLines lines = curve_lines(matcher, results);
  lines.history = run.history({{choices.from, from.content_sha256, &from.history},
                               {choices.to, to.content_sha256, &to.history}});
  print_or_write(curve_table(matcher, results), results, choices, run);
  if (!choices.curve_table.empty()) {
    write_table(choices.curve_table, curve_points_table(matcher, results, patient));
  }
  if (!choices.picture.empty()) {
    write_picture_png(choices.picture, patient->picture(matcher, results));
  }
  if (patient != nullptr) write_hung(choices, *patient, matcher.from_frame().view == View::cc);
  write_polylines(choices.curve, lines);
}

}  // namespace

int main(int argc, char** argv) {
  MatchChoices choices;
  Tool tool("cc2mlo", "where a point of one mammogram lies in another view");
  declare_match(tool, choices);
  return tool.main(argc, argv, [&](Run& run) { run_match(choices, run); });
}
