// SPDX-License-Identifier: GPL-3.0-or-later
// compress: a breast between two plates.
#include <optional>

#include "cli/mechanics_options.hpp"
#include "cli/tool.hpp"
#include "contact/options.hpp"
#include "core/error.hpp"
#include "dicom/like_mammogram.hpp"
#include "io/mesh_file.hpp"
#include "mechanics/estimate/second_solution.hpp"
#include "mechanics_run.hpp"
#include "mesh/muscle_front.hpp"

using namespace breast;

namespace {

struct Choices : CompressionChoices {
  std::filesystem::path reference, compressed, like;
  std::string gravity = "upright";
  std::optional<double> at_least;
  MechanicsChoices mechanics;
  std::string estimate = "step";
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Loads the stress-free breast with gravity, sets two rigid plates with rounded edges just "
      "touching it, and closes them to a thickness, a reduction, a force, a mean pressure or a contact area; of several to "
      "the one that is reached first. "
      "With --image-edge the plates stand as in the clinic: their edge near the chest wall and along "
      "it, faces kept out of them to 0.05 mm, friction holding the breast, which a hand lifts until they "
      "grip. Otherwise contact is exact at the nodes: no penalty, no penetration there; worst_gap_mm in "
      "the report says how deep faces cut across a rounded edge between them. Unless --detector says "
      "otherwise both plates move, about the mid-plane of the stress-free breast, so that it is not dragged along the "
      "chest wall. The stand-off runs from the most anterior chest-wall or cut point to the start "
      "of the plates' rounded edge; the force depends strongly on it.");
  tool.describe(
      "A path that stops early ends in a valid equilibrium: with --at-least it is written with "
      "status stopped_early when at least that reduction was reached.");
  tool.describe(
      "The report gives force, area and pressure of both plates, judges them against clinical "
      "ranges (judgement: an identifier and a sentence each; doubt_ids: those to read first), and "
      "says when the plates' forces differ by more than weight and a quarter of the smaller one: a "
      "plate then presses on the held chest wall or cut. When a path stops early, reason is an "
      "identifier (folds_at_plate_edge, folds_on_chest_wall, folds_between_edge_and_wall, "
      "folds_between_plates, folds_behind_plates, shrinks_... with the same endings, "
      "iteration_limit, indefinite_tangent, no_admissible_step, solve_limit, out_of_reach, "
      "gravity_not_carried, pull_not_carried, no_equilibrium_at_touch, ends_before_grip) and explanation a sentence.");
  tool.cite("Pathmanathan et al. 2008, section II-D, equations (7)-(8)");
  tool.example("compress reference.vtkhdf cc.vtkhdf --view CC --reduction 50",
               "cranio-caudal, half the thickness");
  tool.example(
      "compress reference.vtkhdf cc.vtkhdf --view CC --pressure 10 --wall spring:1,0.1 "
      "--friction 0.3",
      "to a mean pressure of 10 kPa, on a yielding chest wall, with friction");
  tool.example(
      "compress reference.vtkhdf cc.vtkhdf --view CC --reduction 50 --pressure 10 --image-edge auto",
      "with the plates where a mammograph has them, to half the thickness or 10 kPa");
  tool.example("compress reference.vtkhdf mlo.vtkhdf --view MLO --angle 50 --force 100",
               "mediolateral oblique at 50 degrees until the paddle presses with 100 N");
  tool.example("compress reference.vtkhdf mlo.vtkhdf --view MLO --like MG.dcm",
               "angle and thickness of the patient's own mammogram");
  tool.input(c.reference, "REFERENCE.vtkhdf", "stress-free mesh (backward)");
  tool.output(c.compressed, "COMPRESSED.vtkhdf", "the compressed mesh with contact forces");
  tool.choice(c.view, "--view", {"CC", "MLO", "ML"}, "mammographic view").required("--view");
  tool.number(c.angle, "--angle", "DEG", "beam angle; without it CC 0, MLO 45, ML 90", -90, 90);
  tool.number(c.thickness, "--thickness", "MM", "stop at this gap between the flats", 0.1, 1000);
  tool.number(c.reduction, "--reduction", "PERCENT", "stop at this reduction of the thickness", 1,
              95);
  tool.number(c.force, "--force", "N", "stop at this paddle force", 1e-6, 1e5);
  tool.number(c.pressure, "--pressure", "KPA", "stop at this paddle force per contact area", 1e-6,
              1e4);
  tool.number(c.area, "--area", "CM2", "stop at this contact area of the paddle", 1e-3, 1e4);
  tool.input_file(c.like, "--like", "MG.dcm",
                  "angle and target (thickness, else force) of this mammogram; options given win");
  tool.number(c.at_least, "--at-least", "PERCENT",
              "accept a path that stops early from this reduction on (default: the target)", 0,
              100);
  tool.number(
      c.plates.standoff, "--standoff", "MM",
      "from the most anterior chest-wall or cut point to the plate's rounded edge (default: "
      "a third of the breast's depth in front of that point, at most 25)",
      0, 500);
  tool.text(
      c.image_edge, "--image-edge", "auto|MM",
      "places the plates as in the clinic: from the most anterior point of the chest wall behind "
      "the breast, or of the muscle on it, to the edge of the image, where the rounded edge starts; auto is 5 for CC and "
      "0 for MLO and ML, or four fifths of the thickness of a layer of muscle behind its front. --turn, --edge-radius, --contact-points, --friction, --positioning and "
      "--pull then have the defaults that belong to it");
  tool.text(
      c.turn, "--turn", "auto|DEG",
      "turns the plates' edge towards the breast's side about the patient's long axis; auto lays "
      "it along the chest wall behind the breast (default: auto with --image-edge, otherwise 0)");
  tool.choice(
      c.contact_points, "--contact-points", {"surface", "nodes"},
      "keeps faces out of the plates (to 0.05 mm), or nodes, exactly (default: surface with "
      "--image-edge, otherwise nodes)");
  tool.choice(
      c.positioning, "--positioning", {"lifted", "hanging"},
      "a hand carries the breast's weight until the plates grip it, or the plates close on it "
      "as it hangs (default: lifted with --image-edge, otherwise hanging)");
  tool.number(
      c.pull, "--pull", "N",
      "pulls the lifted breast forwards with this force, which fades while the plates grip it "
      "(default: 30 with --image-edge on faces with friction, otherwise 0)",
      0, 500);
  tool.number(
      c.plates.edge_at, "--edge-at", "MM",
      "coordinate of the rounded edge's start along the plates' depth, instead of measuring it from the wall",
      -1e4, 1e4);
  tool.number(c.plates.middle_at, "--middle-at", "MM",
              "coordinate along the beam of the plane about which the plates close", -1e4, 1e4);
  tool.number(
      c.edge_radius, "--edge-radius", "MM",
      "of the plates' rounded edges, at least 1 (default: 3 with --image-edge, otherwise 15)", 0,
      100);
  tool.number(c.plates.tilt_deg, "--tilt", "DEG",
              "paddle about the lateral axis; positive narrows the gap at the nipple", -20, 20);
  tool.text(c.gravity, "--gravity", "upright|off|gx,gy,gz", "gravity during compression, mm/s2");
  tool.text(
      c.detector, "--detector", "raised|fixed|MM",
      "lifts the breast to its mid-plane, not at all, or by so much; the paddle does the rest");
  tool.number(c.friction, "--friction", "MU",
              "Coulomb's coefficient between skin and plates (default: 0.3 with --image-edge, "
              "otherwise 0)",
              0, 2);
  tool.number(c.plate_step, "--plate-step", "MM",
              "longest step of the plates on the way (default: 0.095 of the initial thickness)",
              0.1, 1000);
  tool.choice(c.contact, "--contact", {"active-set", "al"},
              "exact active set, or the paper's augmented Lagrangian");
  declare_mechanics(tool, c.mechanics);
  declare_estimate(tool, c.estimate);
  tool.check([&c] {
    if (c.stops().empty() && c.like.empty()) {
      throw input_error(
          "give at least one of --thickness, --reduction, --force, --pressure, --area, where the plates "
          "stop");
    }
    parse_gravity(c.gravity);
    parse_detector(c.detector);
    if (!c.turn.empty()) parse_turn(c.turn);
    if (!c.image_edge.empty()) parse_image_edge(c.image_edge, view_named(c.view), 0);
  });
}

// Fills what was not given from the mammogram to imitate.
void take_from_mammogram(Choices& c, Side side, Report& report) {
  if (c.like.empty()) return;
  const LikeMammogram like = like_mammogram(c.like, view_named(c.view), side);
  if (!c.angle) c.angle = like.angle_deg;
  if (like.force_N) report.set("like/force_N", *like.force_N);
  if (like.thickness_mm) report.set("like/thickness_mm", *like.thickness_mm);
  if (!c.stops().empty()) return;
  c.thickness = like.thickness_mm;
  if (!c.thickness) c.force = like.force_N;
}

void run_compress(Choices c, Run& run) {
  MechanicsRun mechanics(run, c.mechanics, c.estimate, c.reference,
                         read_mesh(c.reference, {.reference = true}));
  const HexMesh& mesh = mechanics.mesh();
  take_from_mammogram(c, mesh.side, run.report());
  const CompressionOptions options = compression_options(c, parse_gravity(c.gravity), muscle_thickness(mesh));
  if (c.plates.standoff) {
    run.progress().note("--standoff will go in a later version: --image-edge places the plates' edge");
  }
  CompressionResult found = compress(mesh, options, mechanics.options(), run.progress());
  if (mechanics.options().estimate == Estimate::q2 && found.contact) {
    CompressionOptions same_gap = options;
    same_gap.stop_at = StopAt::thickness;
    same_gap.target = found.thickness_mm;
    same_gap.or_at.clear();
    estimate_by_second_solution(mesh, mechanics.options(), found,
                                [&](const HexMesh& richer, const MechanicsOptions& same) {
                                  return compress(richer, same_gap, same, run.progress());
                                });
  }
  write_report(found, mesh, mechanics.options(), run.report());
  const bool enough = found.record.status == SolveStatus::stopped_early && c.at_least &&
                      found.reduction_percent >= *c.at_least;
  mechanics.finish(found, c.compressed, enough, plate_lines(run.report()));
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("compress", "compress a breast between two mammography plates");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_compress(c, run); });
}
