// SPDX-License-Identifier: GPL-3.0-or-later
// render: pictures of the pipeline's results, drawn off-screen.
#include <algorithm>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "figures/figures.hpp"
#include "io/geometry_file.hpp"
#include "io/label_file.hpp"
#include "io/mammogram_file.hpp"
#include "io/mesh_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"
#include "tool_pairs.hpp"

using namespace breast;

namespace {

struct Choices {
  std::vector<std::filesystem::path> files;
  std::filesystem::path scan, labels;
  int series = 0;
  std::string figure, accept_other;
  std::filesystem::path output;

  void check() const {
    if (scan.empty() != labels.empty())
      throw input_error("--scan and --labels must be given together");
    for (const auto& file : files) {
      const std::string ending = file.extension().string();
      if (ending != ".vtkhdf" && ending != ".vti" && ending != ".vtp") {
        throw input_error(file.string(), ": render reads .vtkhdf, .vti and .vtp files");
      }
    }
  }
};

void add_file(const std::filesystem::path& file, const std::string& figure, FigureInput& input) {
  const std::string ending = file.extension().string();
  if (ending == ".vti") {
    input.images.push_back(read_mammogram(file));
  } else if (ending == ".vtp") {
    if (figure_takes_points(figure)) {
      input.surfaces.push_back(read_surface(file));
    } else {
      input.curves = read_polylines(file);
    }
  } else if (figure_takes_geometry(figure)) {
    input.geometry = read_geometry(file);
  } else {
    input.meshes.push_back({file.filename().string(), read_mesh(file)});
  }
}

// The origins of the files in their order.
std::vector<Origin> origins_of(const FigureInput& input, const Choices& choices) {
  std::vector<Origin> origins;
  std::size_t mesh = 0, image = 0, surface = 0;
  for (const auto& file : choices.files) {
    if (file.extension() == ".vti") {
      origins.push_back(origin_of(file, input.images[image++]));
    } else if (file.extension() == ".vtp") {
      origins.push_back(figure_takes_points(choices.figure)
                            ? origin_of(file, input.surfaces[surface++])
                            : origin_of(file, *input.curves));
    } else {
      origins.push_back(figure_takes_geometry(choices.figure)
                            ? origin_of(file, *input.geometry)
                            : origin_of(file, input.meshes[mesh++].mesh));
    }
  }
  return origins;
}

// A picture shows one breast. Only outlines may compare several.
void check_one_breast(const FigureInput& input, const Choices& choices, Pairs& pairs) {
  if (choices.figure == "outlines") return;
  const std::vector<Origin> origins = origins_of(input, choices);
  for (const Origin& origin : origins) {
    pairs.check("first FILE", origins.front(), "FILE", origin);
    if (origin.file.extension() != ".vti") continue;
    for (const Origin& curve : origins)
      if (curve.file.extension() == ".vtp") pairs.check("FILE.vti", origin, "FILE.vtp", curve);
  }
  if (!input.labels) return;
  for (const Origin& origin : origins)
    pairs.check("--labels", origin_of(choices.labels, *input.labels), "FILE", origin);
}

void run_render(const Choices& choices, Run& run) {
  FigureInput input;
  for (const auto& file : choices.files) add_file(file, choices.figure, input);
  Pairs pairs = pairs_of("render", run, choices.accept_other);
  if (!choices.scan.empty()) {
    VolumeSource source;
    input.scan = read_volume(choices.scan, choices.series, &source);
    input.labels = read_labels(choices.labels);
    pairs.check("--labels", origin_of(choices.labels, *input.labels), "--scan",
                origin_of_scan(choices.scan, source.content_sha256, input.scan->grid));
  }
  check_one_breast(input, choices, pairs);
  Timer::Scope phase(run.timer(), "draw");
  draw_figure(choices.figure, input, choices.output);
  run.report().set("figure", choices.figure);
}

}  // namespace

int main(int argc, char** argv) {
  Choices choices;
  choices.figure = "mesh";
  Tool tool("render", "pictures of shapes, plates and mammograms");
  tool.describe(
      "Draws one figure without a screen: the tool starts and stops an X server of its own "
      "(Xvfb), whatever DISPLAY says. All views are parallel projections with a scale bar in mm; "
      "L, A and S mark the patient's left, anterior and superior directions. The figures, and the files that each needs, are:");
  for (const std::string& name : figure_names())
    tool.describe(name + ": " + figure_summary(name) + ".");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), Figs 4 to 7");
  tool.inputs(choices.files, "FILE",
              "meshes (.vtkhdf), mammograms (.vti), points or curves (.vtp); all of one breast, "
              "except for outlines");
  tool.input_file(
      choices.scan, "--scan", "MR",
      "MR scan behind the contours of slices and summary (.nrrd, .nii, .nii.gz, .mha or a "
      "DICOM folder)");
  tool.integer(choices.series, "--series", "N", "series of a DICOM folder (0: the only one)", 0,
               100000);
  tool.input_file(choices.labels, "--labels", "LABELS.vtkhdf",
                  "segmentation of that scan (segment)");
  tool.choice(choices.figure, "--figure", figure_names(), "figure to draw");
  tool.output_file(choices.output, "-o,--output", "OUT.png", "the picture");
  tool.required("--output");
  declare_accept_other(tool, "render", choices.accept_other);
  tool.check([&] { choices.check(); });
  tool.example(
      "render mesh.vtkhdf --figure slices --scan scan.nrrd --labels labels.vtkhdf -o slices.png",
      "the scan in three planes through the tumour, with the contours of the segmentation");
  tool.example("render mesh.vtkhdf --figure tissues -o tissues.png",
               "fibroglandular tissue and tumour through a translucent skin");
  tool.example("render cc.vti mlo.vti curve.vtp --figure mammogram -o mammograms.png",
               "both mammograms with the matched curve");
  return tool.main(argc, argv, [&](Run& run) { run_render(choices, run); });
}
