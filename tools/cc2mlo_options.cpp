// SPDX-License-Identifier: GPL-3.0-or-later
#include "cc2mlo_options.hpp"

#include "core/error.hpp"
#include "matching/band.hpp"

namespace breast {

void MatchChoices::check() const {
  question.check();
  if (!priors.empty() && !band) throw input_error("--priors is for --band");
  if (!materials.empty() && !band) throw input_error("--materials is for --band");
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

namespace {

void declare_images(Tool& tool, MatchChoices& choices) {
  tool.describe(
      "With --cc-image and --mlo-image, the patient's own mammograms, points are pixels of these "
      "(column,row from the centre of the top left one). Each simulated view is laid over its "
      "image by a similarity (rotation, translation, scale) that fits the breast's outline, the "
      "nipple and the chest-wall edge; what is left is added to the band. View, side and pixel "
      "spacing of the headers must fit the meshes; thickness and angle are compared (compress "
      "--like). The picture shows the simulated outline as laid over (magenta), curve and bands "
      "(yellow), arc (blue) and nipple (cross).");
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

}  // namespace

void declare_match(Tool& tool, MatchChoices& choices) {
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
  tool.text(choices.materials, "--materials", "NAME|FILE",
            "with --band: the set the files were made with, whose own covariance (identify) takes the place "
            "of the priors of stiffness and support");
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
      "812,1303 --picture where.png --curve-table where.tsv",
      "a pixel of the patient's CC mammogram, and where it may lie in the MLO one");
}

}  // namespace breast
