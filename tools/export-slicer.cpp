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
      throw input_error("DIR: ", folder,
                        " is the folder of the run itself; give another folder, such as ", folder,
                        "/slicer");
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
          "Writes a run for 3D Slicer: the scan, the labels as a segmentation with names and "
          "colours, every shape as a volume mesh (.vtu) and a surface (.vtp), the landmarks of "
          "every shape and the curve of a CC point (.mrk.json), displacement fields, the scan "
          "warped to the supine breast, and scene.mrml, which opens all of these. All "
          "coordinates are LPS in mm, as every file states.")
      .describe(
          "A displacement field A-points-to-B.nrrd maps a point of shape A to its position in "
          "shape B, by ITK's convention. 3D Slicer reads it as a transform from parent: an "
          "image, a segmentation or a model of shape B to which it is applied is shown in shape "
          "A. To see the scan in the supine breast, apply supine-points-to-scan to it. Outside "
          "the body a field extrapolates the map of the nearest elements over one grid cell, "
          "and is nearly harmonic beyond; -part.nrrd distinguishes the three parts (2 body, 1 "
          "border, 0 extrapolated). The error of the field against the element map is measured "
          "at 1000 random points of the body and printed.")
      .cite("3D Slicer documentation, developer guide: segmentations, markups, transforms");
  // Not declared as an input file: reports and the scene may be written into it, as the pipeline
  // does.
  tool.word(c.run, "RUN",
            "folder of a run with labels, mesh and, where they exist, reference, supine, cc, "
            "mlo and curve");
  tool.word(c.folder, "DIR",
            "output folder; it may exist already, and files of other programs in it are kept");
  tool.input_file(
      c.scan, "--scan", "MR",
      "scan from which the labels were made (file or DICOM folder); without it the scene has no "
      "background image, and the fields have the grid of the labels");
  tool.integer(c.series, "--series", "N", "which series of a DICOM folder (0: the only one)", 0,
               10000);
  tool.number(
      c.spacing, "--spacing", "MM",
      "grid spacing of the fields along every axis (default: the grid of the scan, with its "
      "slices subdivided until they are at most 1.25 mm apart)",
      0.1, 20);
  tool.flag(c.no_fields, "--no-fields", "write neither displacement fields nor the warped scan");
  tool.check([&c] { c.check(); });
  tool.example("export-slicer runs/scan-left scene --scan scan.nrrd",
               "then open scene/scene.mrml in 3D Slicer");
  tool.example("export-slicer runs/average scene --spacing 2", "smaller fields, on a coarser grid");
}

void run_export(const Choices& c, Run& run) {
  SlicerRun slicer_run;
  {
    const Timer::Scope phase(run.timer(), "read");
    slicer_run = read_run(c.run, c.scan, c.series, run);
  }
  if (!slicer_run.scan) {
    run.warn(
        "without --scan the scene has no image; give the scan from which the labels were "
        "made");
  }
  AtomicFolder folder(c.folder, "scene.mrml");
  std::vector<SceneItem> items;
  {
    const Timer::Scope phase(run.timer(), "write");
    items = write_shapes(folder.temporary(), slicer_run, run.history(slicer_run.inputs()));
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
