// SPDX-License-Identifier: GPL-3.0-or-later
#include "cc2mlo_options.hpp"

#include "core/error.hpp"
#include "matching/band.hpp"
#include "tool_pairs.hpp"

namespace breast {

void MatchChoices::check() const {
  question.check();
  if (!priors.empty() && !band) throw input_error("--priors needs --band");
  if (!materials.empty() && !band) throw input_error("--materials needs --band");
  if (!supine.empty() && question.pair.empty()) throw input_error("--supine needs --pair");
  if (cc_image.empty() != mlo_image.empty()) {
    throw input_error("--cc-image and --mlo-image must be given together");
  }
  if (cc_image.empty() && !(picture.empty() && cc_nipple.empty() && mlo_nipple.empty() &&
                            cc_hung.empty() && mlo_hung.empty())) {
    throw input_error(
        "--picture, --cc-hung, --mlo-hung, --cc-nipple and --mlo-nipple need --cc-image and --mlo-image");
  }
  if (!cc_image.empty() && !question.truth.empty()) {
    throw input_error("--truth is in mm and cannot be combined with --cc-image");
  }
}

namespace {

void declare_images(Tool& tool, MatchChoices& choices) {
  tool.describe(
      "With the patient's own mammograms, --cc-image and --mlo-image, points are pixels of "
      "these images (column,row counted from the centre of the top left pixel). Each simulated "
      "view is registered to its image by a similarity (rotation, translation, scale) that fits "
      "the outline of the breast, the nipple and the chest-wall edge; the residual is added to "
      "the band. The view, side and pixel spacing in the headers must agree with the meshes; "
      "thickness and angle are compared (see compress --like). The picture shows the registered "
      "simulated outline (magenta), the curve and bands (yellow), the arc (blue) and the nipple "
      "(cross).");
  tool.input_file(choices.cc_image, "--cc-image", "CC.dcm", "the patient's CC mammogram");
  tool.input_file(choices.mlo_image, "--mlo-image", "MLO.dcm",
                  "the patient's mammogram of the other view");
  tool.numbers(choices.cc_nipple, "--cc-nipple", "x,y", 2,
               "nipple in the CC image in pixels (default: the most anterior point of the "
               "outline)");
  tool.numbers(
      choices.mlo_nipple, "--mlo-nipple", "x,y", 2,
      "nipple in the other image in pixels (default: the most anterior point of the outline)");
  tool.output_file(
      choices.cc_hung, "--cc-hung", "OUT.png",
      "the patient's CC mammogram without marks, hung as in the clinic, with pixels of at least 0.2 mm; the report says "
      "where (u,v) of the simulated view lie in it");
  tool.output_file(choices.mlo_hung, "--mlo-hung", "OUT.png", "the same of the other view");
  tool.output_file(choices.picture, "--picture", "OUT.png",
                   "the second image with the curve, bands, arc and nipple drawn over it");
  tool.output_file(choices.curve_table, "--curve-table", "OUT.tsv",
                   "table of all points of the curves: position in mm, standard deviation, "
                   "pixel of the second image");
}

}  // namespace

void declare_match(Tool& tool, MatchChoices& choices) {
  tool.describe(
      "A point of the CC mammogram is the projection of a column of tissue. The column is "
      "followed through the deformation to the MLO compression and projected there; the point "
      "must lie on the resulting curve. The views are read from the files: any two compressions "
      "of one mesh can be given, in either order. The rules that radiologists use are given "
      "beside the curve: the arc of equal distance from the nipple and the straight line of "
      "equal depth behind it. u and v are in mm from the origin stored in the mammogram. The "
      "table is written to stdout or to --table.");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), section IV-A, Figs 6 and 7");
  tool.input(choices.from, "CC.vtkhdf", "compression in which the point is marked");
  tool.input(choices.to, "MLO.vtkhdf", "compression of the same mesh in another view");
  tool.output(choices.curve, "CURVE.vtp",
              "curve, arc, line and chord, and the column in every shape");
  tool.numbers(choices.question.point, "--point", "u,v", 2, "point in the first image, mm");
  tool.numbers(choices.question.pair, "--pair", "u,v,u,v", 4,
               "the same spot marked in both images; its position in the body is given too, "
               "with residuals");
  tool.input_file(choices.supine, "--supine", "SUPINE.vtkhdf",
                  "with --pair, also give the position of the spot in this supine shape");
  tool.text(
      choices.question.landmark, "--landmark", "NAME",
      "use the projection of this landmark of the meshes, such as tumour; the curve is compared "
      "with its position in the second view");
  tool.input_file(choices.question.points, "--points", "FILE",
                  "TSV of points with columns u_mm, v_mm (with --cc-image: x_px, y_px) and "
                  "optionally name");
  tool.input_file(
      choices.question.truth, "--truth", "FILE",
      "TSV of true positions with columns landmark, side, cc_x_mm ... mlo_z_mm (truth-table). "
      "The table then has one row per landmark with the distances of its true position from the "
      "curve, chord, arc and line. Their mean, 95th percentile and maximum, and the share of landmarks "
      "inside the bands, are printed below it; with --table they are a table of their own, OUT-summary.tsv");
  tool.integer(choices.question.grid, "--grid", "N",
               "use N x N points over the tissue of the first image", 0, 200);
  tool.flag(choices.band, "--band",
            "draw 50 % and 95 % bands from the uncertainty of parameters, thickness, angle, "
            "chest wall and marking (the files must have derivatives from sensitivity and "
            "difference)");
  tool.input_file(choices.priors, "--priors", "FILE",
                  "standard deviations for --band: TSV with columns parameter and "
                  "standard_deviation (relative, degrees or mm)");
  tool.text(choices.materials, "--materials", "NAME|FILE",
            "with --band, the material set whose covariance (identify) replaces the priors of "
            "stiffness and supports (default: the set with which CC was solved, as the file states "
            "it, but none if --priors is given)");
  tool.choice(choices.geometry, "--geometry", {"parallel", "cone"},
              "X-ray beam, as in project-mammogram");
  tool.output_file(choices.table, "--table", "OUT.tsv", "one row per point");
  declare_accept_other(tool, "cc2mlo", choices.accept_other);
  declare_images(tool, choices);
  tool.describe(default_priors_text());
  tool.topic("the point",
             {"--point", "--pair", "--supine", "--landmark", "--points", "--truth", "--grid"});
  tool.topic("band", {"--band", "--priors", "--materials"});
  tool.topic("the patient's mammograms",
             {"--cc-image", "--mlo-image", "--cc-nipple", "--mlo-nipple", "--picture"});
  tool.topic("further outputs", {"--table", "--curve-table"});
  tool.basic({"--point", "--pair", "--landmark", "--points", "--band", "--cc-image", "--mlo-image",
              "--picture", "--table", "--curve-table"});
  tool.check([&] { choices.check(); });
  tool.example("cc2mlo cc.vtkhdf mlo.vtkhdf curve.vtp --landmark tumour --table curve.tsv",
               "where the tumour seen in CC lies in MLO");
  tool.example("cc2mlo cc.vtkhdf mlo.vtkhdf curve.vtp --pair 31,52,35,48 --supine supine.vtkhdf",
               "a spot marked in both views, and its position in the MR scan and supine");
  tool.example(
      "cc2mlo cc.vtkhdf mlo.vtkhdf curve.vtp --cc-image CC.dcm --mlo-image MLO.dcm --point "
      "812,1303 --picture where.png --curve-table where.tsv",
      "a pixel of the patient's CC mammogram, and where it may lie in the MLO one");
}

}  // namespace breast
