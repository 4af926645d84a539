# SPDX-License-Identifier: GPL-3.0-or-later
"""The words of the report: captions of its figures, notes above its tables, names of quantities."""
from __future__ import annotations

_FIGURE_4, _FIGURE_5 = "Figure 4: from data points to the mesh", "Figure 5: mammographic compression"
_FIGURE_6, _FIGURE_7 = "Figure 6: simulated mammograms", "Figure 7: the column of the tumour's pixel"

FIGURES = {
    "slices": ("", "The scan in three planes{ through TUMOUR} with the contours of its segmentation; check these before all that "
                   "follows."),
    "summary": ("", "The chain: the scan, the silhouettes of the postures, CC and MLO compression, simulated mammograms{ and the "
                    "matched curve}."),
    "points": (_FIGURE_4, "4a. Skin (light) and chest-wall (dark) data points."),
    "geometry": (_FIGURE_4, "4b. The fitted cubic-Hermite sheets and the rim where the body ends."),
    "mesh": (_FIGURE_4, "4c. The hexahedral mesh from the front, and its back surface (dark)."),
    "tissues": (_FIGURE_4, "4d. Fibroglandular tissue (violet; the surface that encloses its volume){ and TUMOUR} through the "
                           "translucent skin."),
    "outlines": (_FIGURE_4, "The shapes in the scan, stress-free and supine, superimposed; arrows from the scan to supine, lengths in "
                            "space."),
    "cc-compression": (_FIGURE_5, "5a, b. Before and after CC compression, with the plates; orange: the border of the image on the "
                                  "detector."),
    "mlo-compression": (_FIGURE_5, "5c, d. MLO compression, two views."),
    "pressure": (_FIGURE_5, "Contact pressure under paddle and detector; blue: where the flat of the plate begins."),
    "force-thickness": (_FIGURE_5, "Force of both plates against thickness."),
    "cc-mammogram": (_FIGURE_6, "6a. CC{; the yellow ring is TUMOUR}. White ring: nipple."),
    "mlo-mammogram": (_FIGURE_6, "6b. MLO{; the computed curve, the place the model gives TUMOUR (ring) and the arc of equal nipple "
                                 "distance}."),
    "cc-points": (_FIGURE_6, "6c. A selection of CC points."),
    "mlo-curves": (_FIGURE_6, "6d. Their curves in MLO."),
    "cc-matching": (_FIGURE_7, "7a, b. The column in the CC breast, and the same tissue stress-free."),
    "mlo-matching": (_FIGURE_7, "7c. The same tissue stress-free and in the MLO breast."),
}
"""Section and caption of every picture; words in braces stand there only if a tumour is followed."""

NOTES = {
    "truth": "Errors against the phantom's truth, mm; the mean and the largest are over all its landmarks:",
    "motion": "Prone to supine, mm; women: mean and standard deviation over 63 persons (pipelines/invivo/women.tsv). One breast may "
              "well lie outside: the last column says whether it is within one standard deviation.",
    "scaled": "Displacements from prone to supine, mm, when the stiffness of this tissue is scaled; rel: distance from the 100 % row. "
              "The paper's value and the difference stand beside ours; estimate: estimated discretisation error at the landmarks.",
    "conclusions": "Slopes are d ln u / d ln s between the rows of 90 and 110 %. The text of the paper rounds its slope of -0.61 to "
                   "“10 % changes ... approximately 10 %”; its own rows give 6 to 7 %.",
    "table7": "Tangent-linear derivatives of the converged state (tangent), compared with the rows of Tables III to VI solved again "
              "(resolved: three-point derivative in ln s). Step error is the error of the finite steps between these rows; the two "
              "agree if they differ by at most twice that.",
    "table8": "The same conclusions on the same mesh, with slopes from one solve each. columns: Table II's second-order constants "
              "taken as a11, a20, a02 instead of the printed a20, a02, a11. mira2018: identified in vivo, ten times softer, so that "
              "gravity matters ten times more; if the imaged shape has no stress-free body with this set, no conclusion can be drawn "
              "and the reason is given. mira2018-x10: the same set with ten times the stiffness.",
    "findings": "The default model with one choice at a time made as in the paper, and with all of them (as printed), compared with "
                "the finest solution (27-node elements). The choices are plain instead of isochoric invariants, cuboid instead of "
                "dome, and skin as a layer of elements instead of a membrane.",
    "not made": "Not made yet: the command of this run with the goal GOAL makes it, as in make -f Makefile.pipeline PRESET=paper GOAL or "
                "breast run SCAN --side left --target GOAL; the next report then has it.",
    "leaveout": "What can be left out, and what that saves: Change at the landmarks and on the MLO curve relative to the full model, "
                "and the CPU seconds saved; then the simplest model that stays within the given error, and its actual change.",
    "cost": "Error against run time: Error of the landmarks (mm) against CPU seconds, for each mesh, element and solver.",
    "budget": "Error budget: Errors (mm) that remain when one stage of the chain is replaced by the phantom's truth, and the CPU "
              "seconds of that stage.",
    "stability": "Stability: Stiff and extreme cases: each converges, or stops with a reason.",
    "compare": "Independent solver: The same scene in CalculiX.",
    "population": "The cohort beside living women: Motion from prone to supine, mm, of the breasts that the material set was not "
                  "calibrated on.",
}

MOTION = {
    "nipple_moved_mm": "nipple moved",
    "nipple_lateral_mm": "nipple moved laterally",
    "nipple_posterior_mm": "nipple moved backwards",
    "nipple_caudal_mm": "nipple moved towards the feet",
    "nipples_apart_before_mm": "distance between the nipples, prone",
    "nipples_apart_after_mm": "distance between the nipples, supine",
    "before_notch_before_mm": "nipple in front of the jugular notch, prone",
    "before_notch_after_mm": "nipple in front of the jugular notch, supine",
    "ribs_before_mm": "mean distance of tissue from the ribs, prone",
    "ribs_after_mm": "mean distance of tissue from the ribs, supine",
    "ribs_change_mm": "change of the mean distance",
    "moved_0_20_mm": "tissue up to 20 mm from the ribs: moved",
    "change_0_20_mm": "tissue up to 20 mm from the ribs: change of this distance",
    "moved_20_40_mm": "tissue 20 to 40 mm from the ribs: moved",
    "change_20_40_mm": "tissue 20 to 40 mm from the ribs: change of this distance",
    "moved_above_40_mm": "tissue more than 40 mm from the ribs: moved",
    "change_above_40_mm": "tissue more than 40 mm from the ribs: change of this distance",
    "moved_near_wall_mm": "tissue at the chest wall: moved",
}
"""The quantities of the tool population in words."""
