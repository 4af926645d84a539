// project-mammogram: the X-ray image of a compressed breast.
#include <algorithm>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"
#include "io/label_file.hpp"
#include "io/mammogram_file.hpp"
#include "io/mesh_file.hpp"
#include "mammo/projection.hpp"
#include "xray/beam_quality.hpp"
#include "xray/exposure.hpp"
#include "xray/spectrum.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path mesh, image, labels, png;
  double pixel = 0.25;
  std::string geometry = "parallel", energy = "fraction";
  Exposure exposure;
  int seed = 1;
};

// Another scan's labels would be sampled without complaint, so their content must be among the
// inputs that led to the mesh.
void check_lineage(const HexMesh& mesh, const LabelVolume& labels, const std::string& file,
                   Run& run) {
  const auto holds = [&](const HistoryEntry& entry) {
    return std::any_of(entry.inputs.begin(), entry.inputs.end(), [&](const InputRecord& input) {
      return input.sha256 == labels.content_sha256;
    });
  };
  if (std::none_of(mesh.history.begin(), mesh.history.end(), holds)) {
    run.warn(file + " is not in the mesh's history: are these the labels the mesh was made from?");
  }
}

void report_image(const HexMesh& mesh, const Mammogram& image, const ProjectionReport& projection,
                  Run& run) {
  Report& report = run.report();
  report.set("view", image.view);
  report.set("angle_deg", image.pose.angle_deg);
  report.set("energy", image.energy);
  if (names_spectrum(image.energy)) {
    const Spectrum spectrum = named_spectrum(image.energy);
    report.set("mean_keV", spectrum.mean_kev());
    report.set("half_value_layer_mm_Al", spectrum.half_value_layer());
  }
  report.set("pixel_mm", image.pixel);
  report.set("width_pixels", image.width);
  report.set("height_pixels", image.height);
  report.set("thickness_mm", mesh.contact->thickness_mm);
  report.set("brightest_path", double(*std::max_element(image.path.begin(), image.path.end())));
  report.set("mesh_volume_ml", projection.mesh_volume / mm3_per_ml);
  report.set("imaged_volume_ml", projection.imaged_volume / mm3_per_ml);
  report.set("volumes_ml/fat", projection.volumes.fat / mm3_per_ml);
  report.set("volumes_ml/fibroglandular", projection.volumes.fibroglandular / mm3_per_ml);
  report.set("volumes_ml/skin", projection.volumes.skin / mm3_per_ml);
  report.set("volumes_ml/tumour", projection.volumes.tumour / mm3_per_ml);
  report.set("unlabelled_percent", 100 * projection.unlabelled);
  report.set("columns_through_back", projection.back_columns);
  for (const Landmark& landmark : mesh.landmarks) {
    const Vec3 position = landmark_position(mesh, mesh.points, landmark);
    const Vec2 uv = image.pose.project(position);
    const std::string key = "landmarks/" + landmark.name + "/";
    report.set(key + "imaged", landmark.imaged);
    report.set(key + "position", position);
    report.set(key + "uv_mm", std::vector<double>{uv.x(), uv.y()});
    if (uv.x() < 0) {
      run.warn(landmark.name + " lies " + format_fixed(-uv.x(), 1) +
               " mm behind the image's posterior edge");
    }
  }
  if (projection.unlabelled > 0.05) {
    run.warn(format_fixed(100 * projection.unlabelled, 1) +
             " % of the tissue lies in voxels labelled air, muscle or other (taken as fat)");
  }
}

void run_projection(const Choices& choices, Run& run) {
  const HexMesh mesh = read_mesh(choices.mesh, {.contact = true});
  std::vector<Run::Input> inputs{{choices.mesh, mesh.content_sha256, &mesh.history}};
  ProjectionOptions options;
  options.pixel = choices.pixel;
  options.beam = choices.geometry == "cone" ? Beam::cone : Beam::parallel;
  options.energy = parse_energy(choices.energy);
  LabelVolume labels;
  if (!choices.labels.empty()) {
    labels = read_labels(choices.labels);
    check_lineage(mesh, labels, choices.labels.filename().string(), run);
    options.labels = &labels;
    inputs.push_back({choices.labels, labels.content_sha256, &labels.history});
  }
  ProjectionReport projection;
  Mammogram image;
  {
    Timer::Scope phase(run.timer(), "project");
    image = project_mammogram(mesh, options, &projection, run.progress());
  }
  {
    Timer::Scope phase(run.timer(), "expose");
    expose(image, choices.exposure);
  }
  report_image(mesh, image, projection, run);
  image.history = run.history(inputs);
  if (!choices.png.empty()) write_mammogram_png(choices.png, image);
  write_mammogram(choices.image, image);
}

}  // namespace

int main(int argc, char** argv) {
  Choices choices;
  Tool tool("project-mammogram", "simulated mammogram of a compressed breast");
  tool.describe(
      "Follows an X-ray to every pixel through the compressed mesh. With --labels each point of "
      "the "
      "ray is mapped back through its element to the MR scan and takes the tissue of the voxel "
      "there, so that the image has the detail of the scan; without, each element has one tissue. "
      "The image ends where columns would leave the mesh through the chest wall. Beams are "
      "spectra of Boone, Fewell and Jennings (1997) behind 1 mm beryllium and 0.05 mm rhodium or "
      "0.03 mm molybdenum; tissue is of Hammerstein's composition (1979) with the cross sections "
      "of xraylib; the detector integrates energy and has no blur.");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), section IV-A, Fig. 6");
  tool.input(choices.mesh, "COMPRESSED.vtkhdf", "compressed shape (compress)");
  tool.output(choices.image, "IMAGE.vti", "path, thickness and fibroglandular mm per pixel");
  tool.input_file(choices.labels, "--labels", "LABELS.vtkhdf",
                  "tissue of the MR scan (segment); without, one tissue per element");
  tool.output_file(
      choices.png, "--png", "FILE",
      "16-bit grey image hung as in the clinic, its grey as if all tissue were as thick as "
      "between the plates");
  tool.number(choices.pixel, "--pixel", "mm", "pixel size", 0.02, 10);
  tool.choice(choices.geometry, "--geometry", {"parallel", "cone"},
              "beam; cone: point source 650 mm above the detector's chest-wall edge");
  tool.text(
      choices.energy, "--energy", "fraction|KEV|SPECTRUM",
      "fraction: mm of fibroglandular tissue plus half the fat; KEV (5-100): line integral of the "
      "attenuation; SPECTRUM: W/Rh:KV or Mo/Mo:KV (22-35 kV), or a TSV with columns energy_keV, "
      "weight");
  tool.number(
      choices.exposure.scatter_fraction, "--scatter", "part",
      "scattered part of the radiation behind the breast (0.1 with a grid, 0.3-0.5 without)", 0,
      0.9);
  tool.number(choices.exposure.photons_per_mm2, "--photons", "per mm2",
              "photons detected without a breast: Poisson noise; 0: none", 0, 1e9);
  tool.integer(choices.seed, "--seed", "N", "of the noise", 0, 1000000000);
  tool.check([&] {
    choices.exposure.seed = std::uint64_t(choices.seed);
    parse_energy(choices.energy);
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
