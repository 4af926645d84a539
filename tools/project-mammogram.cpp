// SPDX-License-Identifier: GPL-3.0-or-later
// project-mammogram: the X-ray image of a compressed breast.
#include <algorithm>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "io/mammogram_dicom.hpp"
#include "io/mammogram_file.hpp"
#include "io/mesh_file.hpp"
#include "label_input.hpp"
#include "projection/projection.hpp"
#include "projection/report.hpp"
#include "projection/xray/beam_quality.hpp"
#include "projection/xray/exposure.hpp"
#include "projection/xray/spectrum.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path mesh, image, labels, png, dicom;
  double pixel = 0.25;
  std::string geometry = "parallel", energy = "fraction", dicom_for = "presentation";
  Exposure exposure;
  int seed = 1;
  LabelChoices foreign;
};

MammogramDicom about(const HexMesh& mesh, bool for_processing) {
  MammogramDicom dicom;
  dicom.for_processing = for_processing;
  dicom.thickness_mm = mesh.contact->thickness_mm;
  if (!mesh.contact->plates.empty()) dicom.force_N = mesh.contact->plates.front().force_N;
  return dicom;
}

void report_beam(const std::string& energy, Report& report) {
  if (!names_spectrum(energy)) return;
  const Spectrum spectrum = named_spectrum(energy);
  report.set("mean_keV", spectrum.mean_kev());
  report.set("half_value_layer_mm_Al", spectrum.half_value_layer());
}

void run_projection(const Choices& choices, Run& run) {
  const HexMesh mesh = read_mesh(choices.mesh, {.contact = true});
  std::vector<Run::Input> inputs{{choices.mesh, mesh.content_sha256, &mesh.history}};
  ProjectionOptions options;
  options.pixel = choices.pixel;
  options.beam = choices.geometry == "cone" ? Beam::cone : Beam::parallel;
  options.energy = parse_energy(choices.energy);
  LabelInput labels;
  if (!choices.labels.empty()) {
    Pairs pairs = pairs_of("project-mammogram", run, choices.foreign.accept_other);
    labels = read_label_input(choices.labels, choices.foreign, pairs, run);
    pairs.check("COMPRESSED", origin_of(choices.mesh, mesh), "--labels",
                origin_of(choices.labels, labels.labels));
    options.labels = &labels.labels;
    for (const Run::Input& one : inputs_of(choices.labels, choices.foreign, labels))
      inputs.push_back(one);
  }
  ProjectionReport projection;
  Mammogram image;
  {
    Timer::Scope phase(run.timer(), "project");
    image = project_mammogram(mesh, options, &projection, run.progress());
  }
  refuse_foreign_labels(projection, choices.labels.filename().string());
  {
    Timer::Scope phase(run.timer(), "expose");
    expose(image, choices.exposure);
  }
  write_report(mesh, image, projection, run.report());
  report_beam(image.energy, run.report());
  for (const std::string& doubt : doubts(mesh, image, projection)) run.warn(doubt);
  image.history = run.history(inputs);
  if (!choices.png.empty()) write_mammogram_png(choices.png, image);
  if (!choices.dicom.empty()) {
    write_mammogram_dicom(choices.dicom, image, about(mesh, choices.dicom_for == "processing"));
  }
  write_mammogram(choices.image, image);
}

}  // namespace

int main(int argc, char** argv) {
  Choices choices;
  Tool tool("project-mammogram", "simulated mammogram of a compressed breast");
  tool.describe(
      "Traces an X-ray through the compressed mesh to every pixel. With --labels each point of "
      "the ray is mapped back through its element to the MR scan and takes the tissue of the "
      "voxel there, so that the image has the detail of the scan; otherwise each element has "
      "one tissue. The image ends where rays would leave the mesh through the chest wall.");
  tool.describe(
      "The X-ray spectra are those of Boone, Fewell and Jennings (1997), filtered by 1 mm beryllium "
      "and 0.05 mm rhodium or 0.03 mm molybdenum; tissues have the composition given by "
      "Hammerstein (1979) and the cross sections of xraylib; the detector integrates energy and "
      "has no blur.");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), section IV-A, Fig. 6");
  tool.input(choices.mesh, "COMPRESSED.vtkhdf", "compressed shape (compress)");
  tool.output(
      choices.image, "IMAGE.vti",
      "image: attenuation path, tissue thickness and fibroglandular thickness (mm) of every "
      "pixel");
  tool.input_file(
      choices.labels, "--labels", "LABELS.vtkhdf",
      "tissue labels of the MR scan (segment; also .seg.nrrd of 3D Slicer and other label "
      "volumes); without them each element has one tissue");
  declare_label_choices(tool, "project-mammogram", choices.foreign);
  tool.output_file(
      choices.png, "--png", "FILE.png",
      "16-bit grey-scale image, oriented as for clinical reading and corrected to the tissue "
      "thickness between the plates");
  tool.output_file(choices.dicom, "--dicom", "FILE.dcm",
                   "DICOM mammogram (MG) with view, side, thickness, force and pixel spacing");
  tool.choice(choices.dicom_for, "--dicom-for", {"presentation", "processing"},
              "the picture as displayed, or the detector's signal");
  tool.number(choices.pixel, "--pixel", "mm", "pixel size", 0.02, 10);
  tool.choice(choices.geometry, "--geometry", {"parallel", "cone"},
              "X-ray beam; cone has a point source 650 mm above the chest-wall edge of the "
              "detector");
  tool.text(
      choices.energy, "--energy", "fraction|KEV|SPECTRUM",
      "quantity that is projected. fraction: mm of fibroglandular tissue plus half the mm of "
      "fat; KEV (5-100): line integral of the attenuation; SPECTRUM: W/Rh:KV or Mo/Mo:KV (22-35 "
      "kV), or a TSV with columns energy_keV, weight");
  tool.number(
      choices.exposure.scatter_fraction, "--scatter", "FRACTION",
      "scattered fraction of the radiation that leaves the breast (0.1 with a grid, 0.3-0.5 "
      "without)",
      0, 0.9);
  tool.number(choices.exposure.photons_per_mm2, "--photons", "N_PER_MM2",
              "photons per mm2 detected without a breast, which determine the Poisson noise; 0 "
              "for no noise",
              0, 1e9);
  tool.integer(choices.seed, "--seed", "N", "random seed of the noise", 0, 1000000000);
  tool.topic("picture", {"--png", "--dicom", "--dicom-for", "--pixel"});
  tool.topic("X-rays", {"--geometry", "--energy", "--scatter", "--photons", "--seed"});
  tool.basic({"--labels", "--png", "--dicom", "--pixel", "--geometry", "--energy"});
  tool.check([&] {
    choices.exposure.seed = std::uint64_t(choices.seed);
    parse_energy(choices.energy);
    parse_tissue_codes(choices.foreign.codes);
  });
  tool.example("project-mammogram cc.vtkhdf cc.vti --labels labels.vtkhdf --png cc.png",
               "craniocaudal image with the detail of the scan");
  tool.example("project-mammogram mlo.vtkhdf mlo.vti --energy 20 --pixel 0.1",
               "line integrals at 20 keV, one tissue per element");
  tool.example(
      "project-mammogram cc.vtkhdf cc.vti --labels labels.vtkhdf --energy W/Rh:28 "
      "--scatter 0.1 --photons 50000",
      "tungsten tube with rhodium filter, grid and quantum noise");
  return tool.main(argc, argv, [&](Run& run) { run_projection(choices, run); });
}
