// SPDX-License-Identifier: GPL-3.0-or-later
// export-slicer: a run as files of 3D Slicer, with a scene that opens them all.
#include "cli/tool.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "slicer_files.hpp"

using namespace breast;

namespace {

namespace fs = std::filesystem;

struct Choices {
  fs::path scan;
  std::string run, folder;
  int series = 0;
  bool no_fields = false;
  std::optional<double> spacing;

  void check() const {
    std::error_code ignored;
    if (fs::weakly_canonical(folder, ignored) == fs::weakly_canonical(run, ignored)) {
      throw input_error("DIR: ", folder, " is the run itself; name another folder, such as ",
                        folder, "/slicer");
    }
    fs::path bare = folder;
    if (!bare.has_filename()) bare = bare.parent_path();  // "scene/"
    if (bare.has_parent_path() && !fs::is_directory(bare.parent_path())) {
      throw input_error("DIR: folder ", bare.parent_path().string(),
                        " does not exist; make it first");
    }
    if (fs::exists(folder) && !fs::is_directory(folder)) {
      throw input_error("DIR: ", folder, " exists and is not a folder");
    }
  }
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
          "Writes the run for 3D Slicer: the scan, the labels as a segmentation with names and "
          "colours, every shape as a volume mesh (.vtu) and a surface (.vtp), the landmarks of "
          "every shape and the curve of a CC point (.mrk.json), displacement fields, the scan as it "
          "would look in the supine breast, and scene.mrml, which opens all of it. All places are "
          "LPS and mm, stated in every file.")
      .describe(
          "A field A-points-to-B.nrrd takes a point of A to its place in B (a displacement field as "
          "ITK has it). Slicer reads it as a transform from parent: applied to an image, a "
          "segmentation or a model that lies in B, it shows it in A. To see the scan in the supine "
          "breast, apply supine-points-to-scan to it. Outside the body a field continues the map of "
          "the nearest elements for one cell, then nearly harmonically; -part.nrrd tells the three "
          "apart (2 body, 1 border, 0 continued). Its error against the element map is measured at "
          "1000 random points of the body, and printed.")
      .cite("3D Slicer documentation, developer guide: segmentations, markups, transforms");
  // No input as others are: reports and the scene may lie in it, as the pipeline has them.
  tool.word(c.run, "RUN",
            "folder of a run: labels, mesh and what there is of reference, supine, cc, mlo, curve");
  tool.word(c.folder, "DIR",
            "folder to fill; it may exist, files of other programs in it are kept");
  tool.input_file(
      c.scan, "--scan", "MR",
      "the scan the labels were made from (file or DICOM folder); without it there is no "
      "background, and fields lie on the labels' grid");
  tool.integer(c.series, "--series", "N", "which series of a DICOM folder (0: the only one)", 0,
               10000);
  tool.number(
      c.spacing, "--spacing", "MM",
      "distance of the fields' grid points along every axis; without it the scan's own grid, "
      "slices divided until they are at most 1.25 mm apart",
      0.1, 20);
  tool.flag(c.no_fields, "--no-fields", "leave out displacement fields and the warped scan");
  tool.check([&c] { c.check(); });
  tool.example("export-slicer runs/scan-left scene --scan scan.nrrd",
               "then open scene/scene.mrml in 3D Slicer");
  tool.example("export-slicer runs/average scene --spacing 2", "small fields, on the labels' axes");
}

void run_export(const Choices& c, Run& run) {
  SlicerRun slicer_run;
  {
    const Timer::Scope phase(run.timer(), "read");
    slicer_run = read_run(c.run, c.scan, c.series, run);
  }
  if (!slicer_run.scan) {
    run.warn("without --scan the scene has no image: give the scan the labels were made from");
  }
  AtomicFolder folder(c.folder, "scene.mrml");
  std::vector<SceneItem> items;
  {
    const Timer::Scope phase(run.timer(), "write");
    items = write_shapes(folder.temporary(), slicer_run, run.history(slicer_run.inputs));
  }
  if (!c.no_fields) {
    const FieldOptions options{c.spacing.value_or(0)};
    std::vector<SceneItem> fields = write_fields(folder.temporary(), slicer_run, options, run);
    // Volumes first: the first is the background of the slice views, the second their foreground.
    const bool warped = !fields.empty() && fields.front().kind == SceneKind::volume;
    if (warped) items.insert(items.begin() + (slicer_run.scan ? 1 : 0), fields.front());
    items.insert(items.end(), fields.begin() + (warped ? 1 : 0), fields.end());
  }
  write_text(folder.temporary() / "scene.mrml", scene_xml(items));
  folder.commit();
  run.report().set("files", items.size() + 1);
  run.progress().note(
      message(items.size() + 1, " files for 3D Slicer: open scene.mrml in ", c.folder));
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("export-slicer",
            "a run for 3D Slicer: images, labels, shapes, fields, points and a scene");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_export(c, run); });
}
