// SPDX-License-Identifier: GPL-3.0-or-later
// compress: compresses a breast between two plates.
#include <limits>
#include <optional>

#include "cli/mechanics_options.hpp"
#include "cli/tool.hpp"
#include "contact/options.hpp"
#include "core/error.hpp"
#include "io/dicom/like_mammogram.hpp"
#include "io/mesh_file.hpp"
#include "mechanics/estimate/second_solution.hpp"
#include "mechanics_run.hpp"
#include "mesh/muscle_front.hpp"
#include "mesh/part.hpp"
#include "mesh/surroundings.hpp"
#include "tool_pairs.hpp"

using namespace breast;

namespace {

struct Choices : CompressionChoices {
  std::filesystem::path reference, compressed, like;
  std::string gravity = "upright";
  std::optional<double> at_least;
  MechanicsChoices mechanics;
  std::string estimate = "step";
  StatesChoice states;
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Loads the stress-free breast with gravity, places two rigid plates with rounded edges so "
      "that they just touch it, and closes them to a thickness, a reduction, a force, a mean "
      "pressure or a contact area; if several are given, the first one that is reached ends the "
      "compression. If none is given, the plates close as in screening, to a force of 110 N or to 35 "
      "mm, whichever comes first; a breast that covers less than 28 cm2 of the image is pressed with "
      "4 N for each cm2 that it covers, but with at least 50 N.");
  tool.describe(
      "With --image-edge, which is the default for a breast that slides on its chest "
      "wall, the plates are placed as in the clinic: their edge is close to the chest wall and "
      "along it, element faces penetrate the plates by at most 0.05 "
      "mm, and friction holds the breast, which a hand supports until the plates grip it. "
      "Otherwise contact is enforced exactly at the nodes, without a penalty; worst_gap_mm in "
      "the report is the depth to which faces penetrate a rounded edge between nodes. Unless "
      "--detector says otherwise, both plates move symmetrically about the mid-plane of the "
      "stress-free breast, so that the breast is not dragged along the chest wall; with --image-edge "
      "this plane then follows the breast along the beam until both plates press alike. The "
      "stand-off is the distance from the most anterior chest-wall or cut point to the start of "
      "the plates' rounded edge; the force depends strongly on it.");
  tool.describe(
      "Plates that are placed by the edge of the image must grip the breast: the paddle touches at "
      "least 40 % of the breast's projection, no hand pulls any more, and the rounded edge of neither "
      "plate carries 40 % of its force. A target that is reached without a grip ends with status "
      "not_gripped and exit code 3, and nothing is written unless --keep-unconverged is given. A "
      "compression that stops before its target ends in a valid equilibrium. It is written with status "
      "stopped_early and exit code 0 if it grips the breast and lies within the ranges of single "
      "mammograms (thickness 30 to 90 mm, force 50 to 180 N, mean pressure 5 to 30 kPa, at least 55 % of "
      "the breast in the image in CC and 90 % otherwise) with a scaled Jacobian of at least 0.1, and "
      "if it reached the reduction of --at-least. Between other plates --at-least alone decides.");
  tool.describe(
      "The report gives the force, area and pressure of both plates and compares them with "
      "clinical ranges (judgement: an identifier and a sentence each; doubt_ids: those to read "
      "first). It also says when the plates' forces differ by more than the weight and a "
      "quarter of the smaller force, which means that a plate presses on the chest wall or the "
      "cut. When a compression stops early, reason is an identifier (folds_at_plate_edge, "
      "folds_on_chest_wall, folds_between_edge_and_wall, folds_between_plates, "
      "folds_behind_plates; the same with shrinks_ for an element that shrinks too much "
      "without folding; iteration_limit, "
      "indefinite_tangent, no_admissible_step, solve_limit, cost_limit, out_of_reach, "
      "gravity_not_carried, pull_not_carried, no_equilibrium_at_touch, not_gripped) and explanation is a sentence.");
  tool.cite("Pathmanathan et al. 2008, section II-D, equations (7)-(8)");
  tool.example("compress reference.vtkhdf cc.vtkhdf --view CC",
               "craniocaudal, with the force of a screening mammogram");
  tool.example("compress reference.vtkhdf cc.vtkhdf --view CC --reduction 50",
               "craniocaudal, to half the thickness");
  tool.example(
      "compress reference.vtkhdf cc.vtkhdf --view CC --pressure 10 --wall spring:1,0.1 "
      "--friction 0.3",
      "to a mean pressure of 10 kPa, on a yielding chest wall, with friction");
  tool.example(
      "compress reference.vtkhdf cc.vtkhdf --view CC --reduction 50 --pressure 10 --image-edge auto",
      "with the plates placed as on a mammography machine, to half the thickness or 10 kPa");
  tool.example("compress reference.vtkhdf cc.vtkhdf --view CC --states 12",
               "and the closing of the plates in twelve steps, in cc-states");
  tool.example("compress reference.vtkhdf mlo.vtkhdf --view MLO --angle 50 --force 100",
               "mediolateral oblique at 50 degrees until the paddle presses with 100 N");
  tool.example("compress reference.vtkhdf mlo.vtkhdf --view MLO --like MG.dcm",
               "angle and thickness of the patient's own mammogram");
  tool.input(c.reference, "REFERENCE.vtkhdf", "stress-free mesh (backward)");
  tool.output(c.compressed, "COMPRESSED.vtkhdf", "the compressed mesh with contact forces");
  tool.choice(c.view, "--view", {"CC", "MLO", "ML"}, "mammographic view").required("--view");
  tool.number(c.angle, "--angle", "DEG",
              "angle of the beam (default: 0 for CC, 45 for MLO, 90 for ML)", -90, 90);
  tool.number(
      c.thickness, "--thickness", "MM",
      "stop at this compressed thickness: the distance between the flat parts of the plates", 0.1,
      1000);
  tool.number(c.reduction, "--reduction", "PERCENT", "stop at this reduction of the thickness", 1,
              95);
  tool.number(c.force, "--force", "N", "stop at this paddle force", 0.1, 1e5);
  tool.number(
      c.pressure, "--pressure", "KPA",
      "stop at this mean pressure: the paddle's force divided by its contact area. With "
      "--image-edge, the area counts as at least 25 cm2 and at least 40 % of the breast's projection",
      0.001, 1e4);
  tool.number(c.area, "--area", "CM2", "stop at this contact area of the paddle", 1e-3, 1e4);
  tool.input_file(c.like, "--like", "MG.dcm",
                  "take the angle and the target (thickness, or else force) from the header of "
                  "this mammogram; options given explicitly take precedence");
  tool.number(
      c.at_least, "--at-least", "PERCENT",
      "smallest reduction of the thickness at which a compression that stops early is accepted "
      "(default: with --image-edge any, otherwise the target's)",
      0, 100);
  tool.number(c.plates.standoff, "--standoff", "MM",
              "distance from the most anterior chest-wall or cut point to the plates' rounded edge "
              "(default: a third of the breast's depth in front of that point, at most 25)",
              0, 500);
  tool.text(
      c.image_edge, "--image-edge", "auto|MM",
      "place the plates as in the clinic: MM in front of the chest wall, or of the muscle if the "
      "model has a layer of it, the image ends and the plates' rounded edges start. MM counts from "
      "the most anterior point of wall or muscle behind the breast. auto in CC: 5; if the rounded "
      "edges then carry 40 % of a plate's force, 7.5; if they still do, 10. auto in MLO and ML: 0; "
      "with a layer of muscle, 1.25 times its thickness behind its front. Other options then have "
      "the defaults of the clinic, too: --turn, --lean, --bend, --edge-radius, --contact-points, "
      "--friction, --positioning and --pull (default:"
      " auto for a breast that slides on its chest wall, unless --standoff is given; otherwise "
      "--standoff places the plates)");
  tool.text(
      c.turn, "--turn", "auto|DEG",
      "turn the plates' edge by this angle towards the breast's side, about the patient's long "
      "axis; auto makes it parallel to the chest wall behind the breast, in CC turned by at most 15 "
      "degrees (default: auto with "
      "--image-edge, otherwise 0)");
  tool.text(
      c.lean, "--lean", "auto|DEG",
      "turn the plates' edge by this angle about the beam, with its upper end backwards, as when "
      "the upper corner of the detector lies in the axilla. auto is 0 for CC; for MLO and ML it "
      "makes the edge parallel to the chest wall and adds 4 degrees (default: auto with "
      "--image-edge, otherwise 0)");
  tool.text(
      c.bend, "--bend", "auto|DEG",
      "the patient bends forwards by this angle, and gravity turns with her; auto, from 0 to 20, brings the edges of "
      "both plates equally near to a chest wall that recedes upwards, and, when the plates of a CC view are placed anew, "
      "equally loaded (default: auto for CC and MLO with --image-edge, otherwise 0)");
  tool.choice(
      c.contact_points, "--contact-points", {"surface", "nodes"},
      "surface keeps the element faces out of the plates to within 0.05 mm; nodes keeps the "
      "nodes out exactly (default: surface with --image-edge, otherwise nodes)");
  tool.choice(
      c.positioning, "--positioning", {"lifted", "hanging"},
      "lifted: a hand carries the breast's weight until the plates grip it; hanging: the plates "
      "close on the breast as it hangs (default: lifted with --image-edge, otherwise hanging)");
  tool.number(
      c.pull, "--pull", "N",
      "pull the lifted breast forwards with this force, which decreases to zero as the plates "
      "grip it (default: 30 with --image-edge, if the breast is lifted and friction holds it; "
      "otherwise 0)",
      0, 500);
  tool.number(
      c.plates.edge_at, "--edge-at", "MM",
      "where the rounded edge starts, as a coordinate along the depth of the plates; replaces the "
      "distance from the chest wall",
      -1e4, 1e4);
  tool.number(
      c.plates.middle_at, "--middle-at", "MM",
      "the plane about which the plates close, as a coordinate along the beam (default: the "
      "mid-plane of the breast, which with --image-edge follows the breast)",
      -1e4, 1e4);
  tool.number(
      c.edge_radius, "--edge-radius", "MM",
      "radius of the plates' rounded edges, at least 1 (default: 3 for CC with --image-edge, otherwise "
      "15)",
      0, 100);
  tool.number(c.plates.tilt_deg, "--tilt", "DEG",
              "tilt of the paddle about the lateral axis; a positive tilt narrows the gap at "
              "the nipple",
              -20, 20);
  tool.text(c.gravity, "--gravity", "upright|off|gx,gy,gz",
            "gravity of a patient who stands upright, mm/s2; it turns with --bend");
  tool.text(c.detector, "--detector", "raised|fixed|MM",
            "raised: the detector rises so that both plates close about the breast's mid-plane; "
            "fixed: only the paddle moves; a number: the detector rises by so much and the paddle "
            "does the rest");
  tool.number(c.friction, "--friction", "MU",
              "coefficient of Coulomb friction between skin and plates (default: 0.3 with "
              "--image-edge, otherwise 0)",
              0, 2);
  declare_mechanics(tool, c.mechanics, "REFERENCE");
  tool.number(
      c.plate_step, "--plate-step", "MM",
      "longest step by which the plates close (default: 7 % of the initial thickness; in MLO and ML "
      "with friction, 0.6 % as long as the hand is being withdrawn)",
      0.1, 1000);
  tool.integer(
      c.most_iterations, "--most-iterations", "N",
      "no further step or placement of the plates begins after so many iterations of Newton's "
      "method; the exact end of the best placement is still sought (usually 160 to 600 are made)",
      1, 1000000);
  tool.choice(c.contact, "--contact", {"active-set", "al"},
              "contact algorithm: exact active set, or the paper's augmented Lagrangian");
  declare_estimate(tool, c.estimate);
  declare_states(tool, c.states,
                 "while the plates close from first contact, in equal steps of thickness");
  tool.topic("target", {"--thickness", "--reduction", "--force", "--pressure", "--area", "--like",
                        "--at-least"});
  tool.topic("plates", {"--standoff", "--image-edge", "--turn", "--lean", "--bend",
                        "--contact-points", "--positioning", "--pull", "--edge-at", "--middle-at",
                        "--edge-radius", "--tilt", "--detector", "--friction"});
  tool.topic("solver", {"--plate-step", "--most-iterations", "--contact"});
  tool.basic({"--view", "--angle", "--thickness", "--reduction", "--force", "--like",
              "--image-edge", "--friction", "--materials"});
  tool.check([&c] {
    parse_gravity(c.gravity);
    parse_detector(c.detector);
    if (!c.turn.empty()) parse_turn(c.turn);
    if (!c.lean.empty()) parse_lean(c.lean);
    if (!c.bend.empty()) parse_bend(c.bend);
    if (!c.image_edge.empty()) parse_image_edge(c.image_edge, view_named(c.view), 0);
  });
}

// Fills what was not given from the mammogram to imitate.
void take_from_mammogram(Choices& c, const HexMesh& mesh, Run& run) {
  if (c.like.empty()) return;
  const LikeMammogram like = like_mammogram(c.like, view_named(c.view), c.angle);
  for (const std::string& remark : like.remarks) run.remark(remark);
  Origin image{c.like};
  image.side = like.side;
  pairs_of("compress", run).check("REFERENCE", origin_of(c.reference, mesh), "--like", image);
  Report& report = run.report();
  c.angle = like.angle_deg;
  if (like.force_N) report.set("like/force_N", *like.force_N);
  if (like.thickness_mm) report.set("like/thickness_mm", *like.thickness_mm);
  if (!c.stops().empty()) return;
  c.thickness = like.thickness_mm;
  if (!c.thickness) c.force = like.force_N;
}

/// Whether a compression that stopped early is accepted.
bool is_enough(const CompressionResult& found, const std::optional<double>& at_least) {
  if (found.record.status != SolveStatus::stopped_early) return false;
  const bool by_image = found.contact->ends_image;
  if (by_image ? !found.acceptable : !at_least) return false;
  return found.contact->reduction_percent >= at_least.value_or(0);
}

void add_states(const CompressionResult& result, MechanicsRun& mechanics, StateSeries& series) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  for (const ClosingState& state : result.states) {
    const auto force = [&](std::size_t plate) {
      return state.contact ? state.contact->plates[plate].force_N : unknown;
    };
    mechanics.add_state(series, state,
                        {{"closed_mm", result.states.front().thickness - state.thickness},
                         {"thickness_mm", state.thickness},
                         {"paddle_N", force(0)},
                         {"detector_N", force(1)},
                         {"hand_carries_percent", 100 * state.hand_carries},
                         {"hand_pulls_N", state.hand_pulls_N}});
  }
  mechanics.tell_states({result.states.begin(), result.states.end()});
}

void run_compress(Choices c, Run& run) {
  MechanicsRun mechanics(run, c.mechanics, c.estimate, c.reference,
                         restricted(read_mesh(c.reference, {.reference = true}), breast_elements));
  const HexMesh& mesh = mechanics.mesh();
  take_from_mammogram(c, mesh, run);
  std::optional<StateSeries> states = c.states.series(c.compressed, mesh);
  CompressionOptions options = compression_options(
      c, parse_gravity(c.gravity), {mechanics.options().wall->slides(), muscle_thickness(mesh)});
  options.states = c.states.number;
  CompressionResult found = compress(mesh, options, mechanics.options(), run.progress());
  if (mechanics.options().estimate == Estimate::q2 && found.contact) {
    CompressionOptions same_gap = options;
    same_gap.stops = {{StopAt::thickness, found.contact->thickness_mm}};
    same_gap.plates.middle_at = found.plates.middle();
    same_gap.plates.edge_at = found.plates.paddle.edge_start;
    same_gap.must_grip = false;
    same_gap.states = 0;
    estimate_by_second_solution(mesh, mechanics.options(), found,
                                [&](const HexMesh& richer, const MechanicsOptions& same) {
                                  return compress(richer, same_gap, same, run.progress());
                                });
  }
  write_report(found, mesh, mechanics.options(), run.report());
  const bool enough = is_enough(found, c.at_least);
  run.report().set("accepted", found.converged() || enough);
  const bool on_the_way = states && (found.converged() || enough);
  if (on_the_way) add_states(found, mechanics, *states);
  mechanics.finish(found, c.compressed, enough, plate_lines(run.report()),
                   on_the_way ? &*states : nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("compress", "compress a breast between two mammography plates");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_compress(c, run); });
}
