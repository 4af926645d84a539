// SPDX-License-Identifier: GPL-3.0-or-later
// phantom: a prone or supine breast MR scan with known stress-free, prone and supine truth.
#include "phantom/parameters.hpp"

#include <map>

#include "cli/tool.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/label_file.hpp"
#include "io/mesh_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"
#include "lineage/origin.hpp"
#include "phantom/scanner.hpp"
#include "phantom/truth.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path image, truth, dicom, fat;
  std::string preset = "average", materials, posture = "prone", contrast = "fat-bright";
  std::vector<double> misalign{0, 0};
  std::optional<double> muscle_over_fat, failed;
  int seed = 1;
  double bias = 2, noise = 2, coarse = 1;
};

/// Options that go with one contrast only.
void check_contrast(const Choices& c) {
  if ((c.contrast == "dixon") == c.fat.empty())
    throw input_error("--contrast dixon and --fat, the file of its fat image, need each other");
  if (c.muscle_over_fat && c.contrast != "fat-suppressed")
    throw input_error("--muscle-over-fat is for --contrast fat-suppressed, not ", c.contrast);
  if (c.failed && c.contrast == "fat-bright")
    throw input_error("--failed is for --contrast fat-suppressed or dixon, not ", c.contrast);
  if (!c.dicom.empty() && c.contrast == "dixon")
    throw input_error("--dicom writes one series, not the two images of --contrast dixon");
}

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Makes a bilateral breast MR (T1 without fat suppression unless --contrast says otherwise, "
      "512x512x60 voxels of 0.82x0.82x2.5 mm): breasts with skin, fat, an irregular fibroglandular tree and nipple "
      "on a chest with pectoral muscle, ribs and lung; coil bias, partial volume, Rician noise.");
  tool.describe(
      "The prone shape is the equilibrium of a known stress-free shape under gravity, solved "
      "with 27-node elements on a mesh template that hexmesh does not use, so that the errors "
      "of the chain can be measured. Breasts of the presets average, slim, broad and heavy are "
      "defined by their prone shape and slide on the rib cage, with supports and stiffness that "
      "differ from those of the material set; the other presets are defined by their "
      "stress-free shape and held at the chest wall.");
  tool.describe(
      "With --posture supine it makes the scan of the same body lying on her back: the same rib cage, the "
      "breasts where the same mechanics puts them, and the fat of the chest as thick as before wherever no breast lies. "
      "--misalign shifts and rotates that body in the scanner, as a second visit does; all supine truth is then that of "
      "the moved body, and the report contains the motion.");
  tool.output(c.image, "OUT.nrrd", "the scan (.nrrd, .nii, .nii.gz or .mha)",
              {".nii", ".nii.gz", ".mha"});
  tool.output_folder(
      c.truth, "--truth", "DIR",
      "write the truth to this folder: labels, surfaces, meshes and landmarks.tsv (stress-free, "
      "prone and supine)");
  tool.choice(c.preset, "--preset", preset_names(), "kind of breast");
  tool.integer(c.seed, "--seed", "N", "random seed: another breast of the same kind", 0,
               1000000000);
  tool.output_folder(c.dicom, "--dicom", "DIR",
                     "also write the scan as a DICOM series, with one file per slice");
  tool.number(c.bias, "--bias", "FACTOR",
              "coil sensitivity: ratio of the brightest to the darkest breast fat", 1, 20);
  tool.number(c.noise, "--noise", "%",
              "standard deviation of the noise in percent of the fat signal", 0, 100);
  tool.choice(c.contrast, "--contrast", {"fat-bright", "fat-suppressed", "dixon"},
              "contrast of the scan. fat-bright: T1. The others follow from the water, fat and T1 "
              "of each tissue in a spoiled gradient echo: fat-suppressed leaves as much of fat's "
              "signal as --muscle-over-fat says; dixon makes a water image, OUT.nrrd, and a fat "
              "image, --fat");
  tool.number(c.muscle_over_fat, "--muscle-over-fat", "FACTOR",
              "of --contrast fat-suppressed: brightness of muscle over that of fat (4 if not "
              "given)",
              0.9, 8);
  tool.number(c.failed, "--failed", "%",
              "share of the body, at the side of one breast, in which fat is not suppressed, or "
              "water and fat are exchanged",
              0, 50);
  tool.output_file(c.fat, "--fat", "OUT.nrrd", "fat image of --contrast dixon");
  tool.choice(c.posture, "--posture", {"prone", "supine"}, "posture of the scan");
  tool.numbers(
      c.misalign, "--misalign", "MM,DEGREES", 2,
      "shift and rotation of a supine body relative to the prone one, in directions drawn from the seed");
  tool.text(c.materials, "--materials", "NAME|FILE",
            "material set of the breasts (default: that of the preset)");
  tool.number(c.coarse, "--coarse", "FACTOR",
              "enlarge the voxels by this factor and, from 2 on, use a coarser mesh, for tests", 1,
              8);
  tool.topic("scan", {"--dicom", "--bias", "--noise", "--contrast", "--muscle-over-fat", "--failed",
                      "--fat", "--coarse"});
  tool.topic("posture", {"--posture", "--misalign"});
  tool.basic({"--truth", "--preset", "--seed", "--dicom", "--noise", "--contrast", "--fat",
              "--posture", "--misalign", "--materials"});
  tool.check([&c] {
    if (!c.dicom.empty()) check_dicom_folder(c.dicom);
    check_contrast(c);
    const double shift = c.misalign[0], turn = c.misalign[1];
    if ((shift != 0 || turn != 0) && c.posture != "supine")
      throw input_error("--misalign is for --posture supine");
    if (!(shift >= 0 && shift <= 50 && turn >= 0 && turn <= 15)) {
      throw input_error(
          "--misalign ", shift, ",", turn,
          ": the shift must lie between 0 and 50 mm, the turn between 0 and 15 degrees");
    }
  });
  tool.example("phantom paper.nrrd --truth paper-truth", "a breast of average size and its truth");
  tool.example("phantom p.nrrd --preset pendulous --seed 7 --bias 5 --dicom p-dicom",
               "a pendulous breast under a strong coil bias, also as DICOM");
  tool.example("phantom water.nrrd --contrast dixon --fat fat.nrrd --failed 10",
               "water and fat of a Dixon scan, exchanged in a tenth of the body");
  tool.example("phantom supine.nrrd --posture supine --misalign 4,2 --truth supine-truth",
               "the average body on her back, lying 4 mm and 2 degrees off");
}

PhantomParameters parameters_of(const Choices& c) {
  PhantomParameters p = phantom_preset(c.preset, std::uint64_t(c.seed));
  p.mri.bias = c.bias;
  p.mri.noise_percent = c.noise;
  p.mri.voxel_factor = c.coarse;
  if (!c.materials.empty()) p.body.materials = c.materials;
  if (c.coarse >= 2) p.mesh = coarse_mesh(p);
  return p;
}

void write_truth_side(const std::filesystem::path& folder, PhantomBreast& breast,
                      const Postures& postures, const PhantomScene& scene,
                      const PhantomImage& image, const History& history, Run& run) {
  const std::string side(side_name(breast.mesh.side));
  LabelVolume labels = true_labels(scene, image, breast.mesh.side);
  labels.history = breast.mesh.history = history;
  report_volumes(labels, "volumes_ml/" + side, run.report());
  write_labels(folder / ("labels-" + side + ".vtkhdf"), labels);
  HexMesh mesh = breast.mesh;
  mesh.reference = postures.stress_free;
  mesh.model = postures.model;
  write_mesh(folder / (side + ".vtkhdf"), mesh);
  for (const auto& [name, faces] :
       {std::pair("skin-", &mesh.skin_faces), {"wall-", &mesh.pectoral_faces}}) {
    TriMesh surface = boundary_surface(mesh, mesh.points, *faces);
    surface.history = history;
    write_surface(folder / (name + side + ".vtp"), surface);
  }
}

/// Moves the breasts to their supine shapes for imaging.
void lie_supine(PhantomScene& scene, const std::map<Side, Postures>& solved) {
  for (const auto& [side, postures] : solved) scene.breast(side).lie_supine(postures.supine);
}

/// Moves the truth to the position of the body in the scanner.
void move_with_body(PhantomScene& scene, const RigidMotion& moved) {
  for (Side side : {Side::left, Side::right}) {
    HexMesh& mesh = scene.breast(side).mesh;
    for (Vec3& point : mesh.points) point = moved(point);
    mesh.gravity = moved.rotation() * mesh.gravity;
  }
}

void report_motion(const RigidMotion& moved, Report& report) {
  report.set("misalignment/centre_mm", moved.centre);
  report.set("misalignment/shift_mm", moved.shift);
  report.set("misalignment/turn_deg", moved.turn);
}

std::string content_of(const Volume<std::int16_t>& mr) {
  Volume<float> volume(mr.grid);
  volume.voxels.assign(mr.voxels.begin(), mr.voxels.end());
  return content_hash(volume);
}

/// The scan, which of a Dixon scan is that of water, and that of fat.
DixonScan scans_of(const PhantomImage& image, const PhantomParameters& p, const Choices& c) {
  ContrastParameters shown;
  if (c.muscle_over_fat) shown.muscle_over_fat = *c.muscle_over_fat;
  if (c.failed) shown.failed_percent = *c.failed;
  if (c.contrast == "dixon") return dixon_scan(image, p.mri, shown, p.seed);
  if (c.contrast == "fat-suppressed") return {suppressed_scan(image, p.mri, shown, p.seed), {}};
  return {scan(image, p.mri, p.seed), {}};
}

void run_phantom(const Choices& c, Run& run) {
  const PhantomParameters parameters = parameters_of(c);
  const MaterialSet materials = body_materials(parameters.body);
  // Created and removed again, so that a folder that is refused does not cost the minutes of the simulation.
  if (!c.truth.empty()) AtomicFolder(c.truth, "landmarks.tsv");
  write_parameters(parameters, run.report());
  run.report().set("posture", c.posture);
  run.progress().update("shape", -1, "stress-free breasts and their glands");
  PhantomScene scene = [&] {
    Timer::Scope phase(run.timer(), "shape");
    return PhantomScene(parameters);
  }();
  const bool supine = c.posture == "supine";
  const RigidMotion moved =
      supine ? misalignment(scene, c.misalign[0], c.misalign[1]) : RigidMotion();
  if (supine) report_motion(moved, run.report());
  Table landmarks;
  double worst = 0;
  std::map<Side, Postures> solved;
  for (Side side : {Side::left, Side::right}) {
    Timer::Scope phase(run.timer(), "mechanics");
    PhantomBreast& breast = scene.breast(side);
    TruthError error;
    const Postures postures = solve_breast(breast, parameters, materials, error, run.progress());
    report_breast(breast, postures, run.report());
    Postures seen = postures;
    for (Vec3& point : seen.supine) point = moved(point);
    add_landmarks(breast, seen, landmarks);
    worst = std::max(worst, error.worst());
    solved[side] = postures;
  }
  run.report().set("error_estimate_mm", worst);
  run.report().set("error_estimate_by",
                   "largest landmark distance to a mesh of half the resolution");
  if (supine) lie_supine(scene, solved);
  PhantomImage image = [&] {
    Timer::Scope phase(run.timer(), "imaging");
    return image_scene(scene, run.progress(), moved, c.contrast != "fat-bright");
  }();
  if (supine) move_with_body(scene, moved);
  Timer::Scope phase(run.timer(), "writing");
  const auto [mr, fat] = scans_of(image, parameters, c);
  if (!c.truth.empty()) {
    AtomicFolder folder(c.truth, "landmarks.tsv");
    const std::filesystem::path& truth = folder.temporary();
    // The truth names the scan, so that it is not compared with what was made from another one.
    const std::string sha256 = content_of(mr);
    const History history = run.history({{c.image, sha256, nullptr}});
    landmarks.columns.push_back(truth_scan_column);
    for (auto& row : landmarks.rows) row.push_back(sha256);
    for (Side side : {Side::left, Side::right})
      write_truth_side(truth, scene.breast(side), solved.at(side), scene, image, history, run);
    write_table(truth / "landmarks.tsv", landmarks);
    for (Side side : {Side::left, Side::right})
      write_table(truth / ("tumour-" + std::string(side_name(side)) + ".tsv"),
                  tumour_place(scene.breast(side).mesh));
    write_text(truth / "parameters.json", run.report().json());
    folder.commit();
  }
  if (!c.dicom.empty()) write_dicom_series(c.dicom, mr, "phantom " + c.preset);
  if (!c.fat.empty()) write_volume(c.fat, fat);
  write_volume(c.image, mr);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("phantom", "a prone or supine breast MR scan whose truth is known");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_phantom(c, run); });
}
