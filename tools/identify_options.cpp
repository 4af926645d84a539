// SPDX-License-Identifier: GPL-3.0-or-later
#include "identify_options.hpp"

#include <sstream>

#include "core/error.hpp"

namespace breast {

void IdentifyChoices::check() const {
  if (landmarks.empty() && surface.empty() && nipple.empty() && forces.empty()) {
    throw input_error(
        "no data of a second posture are given; use --landmarks, --nipple, --surface or "
        "--force-thickness");
  }
  if (labels.empty() != second_labels.empty())
    throw input_error(
        "--labels and --second-labels must be given together, because the chest "
        "walls of both scans are compared");
  if (!second_landmarks.empty() && landmarks.empty())
    throw input_error("--second-landmarks needs --landmarks");
  if (!seen.empty() && surface.empty()) throw input_error("--seen needs --surface");
  if (!align && labels.empty() && align_deviation != std::vector<double>{4, 2})
    throw input_error("--align-deviation needs --align or --labels");
  for (const double one : align_deviation)
    if (!(one > 0 && one <= 100))
      throw input_error("--align-deviation ", one, " must lie above 0 and up to 100");
}

std::vector<std::string> IdentifyChoices::names() const {
  std::vector<std::string> list;
  std::istringstream words(parameters);
  for (std::string word; std::getline(words, word, ',');) list.push_back(word);
  return list;
}

namespace {

void declare_data(Tool& tool, IdentifyChoices& c) {
  tool.input_file(
      c.landmarks, "--landmarks", "PAIRS.tsv|MARKS.mrk.json",
      "material points marked in both postures: columns prone_x_mm ... supine_z_mm, optionally "
      "landmark, observer_mm and side; or marks of 3D Slicer (.mrk.json, .fcsv), paired by their labels (prone-3 with supine-3)");
  tool.input_file(c.second_landmarks, "--second-landmarks", "MARKS.mrk.json",
                  "marks of the second posture, if --landmarks contains only those of the scan");
  tool.numbers(c.nipple, "--nipple", "x,y,z", 3,
               "position of the nipple in the second posture, mm LPS");
  tool.input_file(c.surface, "--surface", "SKIN.vtp",
                  "skin observed in the second posture: triangles, or points with normals as "
                  "written by segment --posture supine --points");
  tool.input_file(c.labels, "--labels", "LABELS.vtkhdf",
                  "segmentation of the first scan; its chest wall is registered with that of "
                  "--second-labels");
  tool.input_file(c.second_labels, "--second-labels", "LABELS.vtkhdf",
                  "segmentation of the second scan (segment --posture supine); its nipple is "
                  "compared, not fitted");
  tool.input_file(c.judge, "--judge", "PAIRS.tsv",
                  "landmarks in the format of --landmarks that are not fitted; their predicted "
                  "positions are compared with the marks");
  tool.input_file(
      c.forces, "--force-thickness", "FILE.tsv",
      "forces of a paddle: columns thickness_mm, force_N, optionally sd_N (default: a tenth of "
      "the force plus 0.5 N); each row costs one compression per trial");
  tool.number(c.observer, "--observer-error", "MM",
              "rms distance in space between an observer's mark of a landmark and its position",
              0.01, 100);
  tool.number(c.surface_error, "--surface-error", "MM",
              "standard deviation of the skin's distance at one of the sample points, which are "
              "12 mm apart",
              0.01, 100);
  tool.number(c.outside, "--outside", "MM",
              "largest distance by which a landmark may lie outside the body in the scan", 0.1,
              100);
  tool.choice(c.view, "--view", {"CC", "MLO", "ML"},
              "mammographic view in which the forces were measured");
  tool.number(c.standoff, "--standoff", "MM",
              "stand-off of the plates with which the forces were measured", 0, 500);
  tool.number(c.edge_radius, "--edge-radius", "MM", "radius of the rounded edges of these plates",
              1, 100);
}

}  // namespace

void declare_identify(Tool& tool, IdentifyChoices& c) {
  tool.describe(
      "Finds a patient's own stiffness: the material set with which her breast, imaged prone, "
      "moves to its position observed in a second posture.");
  tool.describe(
      "The unknowns are factors (in "
      "logarithms) on parts of the material set: low_order (constants linear in the "
      "invariants, of fat and fibroglandular tissue alike), quadratic (the other constants), "
      "gland (additional factor for fibroglandular tissue, that is, the ratio of gland to fat), "
      "skin, wall (resistance to sliding) and cut. With --align, the shift and rotation of the "
      "rib cage between the postures are unknowns as well. Gravity keeps its direction in the "
      "frame of the scan.");
  tool.describe(
      "The method is weighted least squares with a trust region and exact derivatives of backward "
      "and forward. If a trial set has no stable body, the step is shortened, and the trial is "
      "reported. The prior is the covariance of the set itself (invivo has one). For a set "
      "without a covariance it is a factor of three, for gland a factor of two; with --prior none "
      "it is a factor of twenty for each, which only keeps undetermined parameters finite.");
  tool.describe(
      "The tool prints the parameters, then in words the combinations of parameters that the data "
      "determine. --table contains, for each landmark, the residual, the distance from its "
      "position predicted without this landmark, and the observer's error. The misfit test "
      "compares the sum of squares with its distribution; if it fails at 1 %, the errors of the "
      "data are enlarged accordingly. OUT.tsv contains the covariance: --materials OUT.tsv runs "
      "the chain with this set, and cc2mlo --band --materials OUT.tsv draws the band for the "
      "remaining uncertainty.");
  tool.describe(
      "With --labels and --second-labels, the motion of the rib cage between the scans is first "
      "found from their chest walls (a rigid motion; places that do not fit are left out). The "
      "components that the walls do not determine are reported and remain unknowns. The table of "
      "landmarks is then in the frame of the mesh. For every landmark it gives the error of this "
      "solution, that of a solution without this landmark, and those of the sets in --compare.");
  tool.input(c.mesh, "MESH.vtkhdf",
             "mesh of the breast imaged prone, with its wall surface (hexmesh)");
  tool.output(c.set, "OUT.tsv", "the material set found, with its covariance");
  declare_data(tool, c);
  tool.text(
      c.parameters, "--parameters", "LIST",
      "parameters to identify, from low_order, quadratic, gland, skin, those of the supports (wall, cut, "
      "sternum), and stiffness for the first two together (default: all that the model has, except "
      "stiffness)");
  tool.choice(c.prior, "--prior", {"set", "none"},
              "prior: the covariance of the material set, or nearly none");
  tool.flag(c.align, "--align", "allow for a motion of the rib cage between the postures");
  tool.texts(c.compare, "--compare", "NAME|FILE",
             "another material set whose errors at the landmarks are tabulated for comparison");
  tool.numbers(c.align_deviation, "--align-deviation", "MM,DEGREES", 2,
               "expected rms shift and rotation of the rib cage");
  tool.integer(c.pairs, "--max-pairs", "N",
               "largest number of trials, each of which solves backward and forward", 2, 500);
  tool.output_file(c.table, "--table", "OUT.tsv", "table with one row per landmark");
  tool.output_file(c.seen, "--seen", "OUT.vtp",
                   "surface of --surface in the frame of --second, for figures");
  tool.output_file(c.second, "--second", "OUT.vtkhdf",
                   "shape in the second posture, solved with the set found");
  declare_gravity(tool, c.gravity,
                  "direction of gravity in the second posture, in the frame of the scan");
  declare_mechanics(tool, c.mechanics, "MESH");
  tool.cite("Moré 1978, the Levenberg-Marquardt algorithm: implementation and theory");
  tool.topic("what was observed",
             {"--landmarks", "--second-landmarks", "--nipple", "--surface", "--labels",
              "--second-labels", "--judge", "--observer-error", "--surface-error", "--outside"});
  tool.topic("a compression", {"--force-thickness", "--view", "--standoff", "--edge-radius"});
  tool.topic("parameters", {"--parameters", "--prior", "--align", "--align-deviation", "--compare",
                            "--max-pairs"});
  tool.topic("further outputs", {"--table", "--seen", "--second"});
  tool.basic({"--landmarks", "--second-landmarks", "--nipple", "--surface", "--labels",
              "--second-labels", "--force-thickness", "--align", "--materials", "--table"});
  tool.check([&c] { c.check(); });
  tool.example(
      "identify mesh.vtkhdf patient.tsv --materials invivo --landmarks pairs.tsv --align "
      "--table landmarks.tsv",
      "from landmarks marked prone and supine");
  tool.example(
      "identify mesh.vtkhdf patient.tsv --materials invivo --surface supine-skin.vtp --labels "
      "labels.vtkhdf --second-labels supine-labels.vtkhdf --compare seed2008 --compare invivo --table landmarks.tsv",
      "from the skin of a supine scan, with rib cages registered by their chest walls");
  tool.example("identify mesh.vtkhdf patient.tsv --materials invivo --nipple 158,-9,13",
               "from the nipple alone; as the output says, the result is mostly determined by the "
               "prior");
}

}  // namespace breast
