// SPDX-License-Identifier: GPL-3.0-or-later
// phantom: a prone breast MR scan whose stress-free, prone and supine truth is known.
#include "phantom/parameters.hpp"

#include <map>
#include <optional>

#include "cli/tool.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/label_file.hpp"
#include "io/mesh_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"
#include "phantom/scanner.hpp"
#include "phantom/truth.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path image, truth, dicom;
  std::string preset = "average", materials;
  int seed = 1;
  double bias = 2, noise = 2, coarse = 1;
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Makes a bilateral prone breast MR (T1 without fat suppression, 512x512x60 voxels of "
      "0.82x0.82x2.5 mm): breasts with skin, fat, an irregular fibroglandular tree and nipple on a "
      "chest with pectoral muscle, ribs and lung; coil bias, partial volume, Rician noise. The "
      "breasts hang as physics says: their known stress-free shape is solved under prone gravity "
      "with 27-node elements on a template that hexmesh does not have, so that the chain can be "
      "told its errors. Breasts of the presets average, slim, broad and heavy are shaped as they hang "
      "and slide on their rib cage, with supports and stiffness that differ from the set's; the "
      "other presets are shaped stress-free and held at the wall.");
  tool.output(c.image, "OUT.nrrd", "the scan (.nrrd, .nii, .nii.gz or .mha)",
              {".nii", ".nii.gz", ".mha"});
  tool.output_folder(
      c.truth, "--truth", "DIR",
      "write labels, surfaces, meshes and landmarks.tsv (stress-free, prone and supine) there");
  tool.choice(c.preset, "--preset", preset_names(), "kind of breast");
  tool.integer(c.seed, "--seed", "N", "another woman of the same kind", 0, 1000000000);
  tool.output_folder(c.dicom, "--dicom", "DIR",
                     "also write the scan as a DICOM series, one file a slice");
  tool.number(c.bias, "--bias", "FACTOR", "coil sensitivity: brightest over darkest breast fat", 1,
              20);
  tool.number(c.noise, "--noise", "%", "noise in per cent of the fat signal", 0, 100);
  tool.text(c.materials, "--materials", "NAME|FILE",
            "material set of the breasts; without it the preset's");
  tool.number(c.coarse, "--coarse", "FACTOR",
              "larger voxels and, from 2 on, a coarser mesh: for tests", 1, 8);
  tool.check([&c] {
    if (!c.dicom.empty()) check_dicom_folder(c.dicom);
  });
  tool.example("phantom paper.nrrd --truth paper-truth", "a breast of average size and its truth");
  tool.example("phantom p.nrrd --preset pendulous --seed 7 --bias 5 --dicom p-dicom",
               "a pendulous breast under a strong coil bias, also as DICOM");
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
                      const Postures& postures, const PhantomScene& scene, const PhantomImage& image, Run& run) {
  const std::string side(side_name(breast.mesh.side));
  LabelVolume labels = true_labels(scene, image, breast.mesh.side);
  labels.history = breast.mesh.history = run.history({});
  report_volumes(labels, "volumes_ml/" + side, run.report());
  write_labels(folder / ("labels-" + side + ".vtkhdf"), labels);
  HexMesh mesh = breast.mesh;
  mesh.reference = postures.stress_free;
  write_mesh(folder / (side + ".vtkhdf"), mesh);
  write_surface(folder / ("skin-" + side + ".vtp"),
                boundary_surface(mesh, mesh.points, mesh.skin_faces));
  write_surface(folder / ("wall-" + side + ".vtp"),
                boundary_surface(mesh, mesh.points, mesh.pectoral_faces));
}

void run_phantom(const Choices& c, Run& run) {
  const PhantomParameters parameters = parameters_of(c);
  const MaterialSet materials = body_materials(parameters.body);
  // Made before minutes are spent on what goes into it.
  std::optional<AtomicFolder> folder;
  if (!c.truth.empty()) folder.emplace(c.truth, "landmarks.tsv");
  write_parameters(parameters, run.report());
  run.progress().update("shape", -1, "stress-free breasts and their glands");
  PhantomScene scene = [&] {
    Timer::Scope phase(run.timer(), "shape");
    return PhantomScene(parameters);
  }();
  Table landmarks;
  double worst = 0;
  std::map<Side, Postures> solved;
  for (Side side : {Side::left, Side::right}) {
    Timer::Scope phase(run.timer(), "mechanics");
    PhantomBreast& breast = scene.breast(side);
    TruthError error;
    const Postures postures = solve_breast(breast, parameters, materials, error, run.progress());
    report_breast(breast, postures, run.report());
    add_landmarks(breast, postures, landmarks);
    worst = std::max(worst, error.worst());
    solved[side] = postures;
  }
  run.report().set("error_estimate_mm", worst);
  run.report().set("error_estimate_by",
                   "largest landmark distance to a mesh of half the resolution");
  PhantomImage image = [&] {
    Timer::Scope phase(run.timer(), "imaging");
    return image_scene(scene, run.progress());
  }();
  Timer::Scope phase(run.timer(), "writing");
  const Volume<std::int16_t> mr = scan(image, parameters.mri, parameters.seed);
  if (!c.truth.empty()) {
    const std::filesystem::path& truth = folder->temporary();
    for (Side side : {Side::left, Side::right})
      write_truth_side(truth, scene.breast(side), solved.at(side), scene, image, run);
    write_table(truth / "landmarks.tsv", landmarks);
    for (Side side : {Side::left, Side::right})
      write_table(truth / ("tumour-" + std::string(side_name(side)) + ".tsv"),
                  tumour_place(scene.breast(side).mesh));
    write_text(truth / "parameters.json", run.report().json());
    folder->commit();
  }
  if (!c.dicom.empty()) write_dicom_series(c.dicom, mr, "phantom " + c.preset);
  write_volume(c.image, mr);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("phantom", "a prone breast MR scan whose truth is known");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_phantom(c, run); });
}
