// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/postures.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "mechanics/model.hpp"
#include "mesh/locate.hpp"
#include "mesh/quality.hpp"
#include "phantom/chest/rib_surface.hpp"

namespace breast {

namespace {

Element element_of(const HexMesh& mesh) {
  return mesh.order == 2 ? Element::q2p1 : Element::q1p0;
}

void must_converge(const Equilibrium& found, const HexMesh& mesh, std::string_view what) {
  if (found.converged()) return;
  throw not_converged_error("phantom, ", side_name(mesh.side), " breast, ", what, ": ",
                            found.record.reason);
}

MechanicsOptions held_model(const HexMesh& mesh, const MaterialSet& materials) {
  MechanicsOptions options;
  options.materials = materials;
  options.element = element_of(mesh);
  options.cut = cut_support("fixed");
  return options;
}

// Solves and stores the resulting shape in the mesh.
SolveSummary take_posture(HexMesh& mesh, Posture posture, const MechanicsOptions& options,
                          Progress& progress) {
  Equilibrium found = solve_forward(mesh, posture_gravity(posture), options, progress);
  must_converge(found, mesh, posture_name(posture));
  store(found, mesh);
  return found;
}

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double worst = 0;
  for (std::size_t n = 0; n < a.size(); ++n) worst = std::max(worst, (a[n] - b[n]).norm());
  return worst;
}

}  // namespace

Postures solve_postures(HexMesh& mesh, const MaterialSet& materials, Progress& progress) {
  constexpr double agreement = 1e-4;  // mm
  const MechanicsOptions options = held_model(mesh, materials);
  Postures out;
  out.model = model_text(options);
  for (int pass = 0; pass < 6; ++pass) {
    out.prone = take_posture(mesh, Posture::prone, options, progress);
    out.imaged_gap = largest_distance(mesh.points, mesh.imaged);
    if (out.imaged_gap < agreement) break;
    mesh.imaged = mesh.points;
  }
  for (Landmark& landmark : mesh.landmarks)
    landmark.imaged = landmark_position(mesh, mesh.imaged, landmark);
  out.pressure = mesh.pressure;
  HexMesh supine = mesh;
  out.supine_solve = take_posture(supine, Posture::supine, options, progress);
  out.supine = std::move(supine.points);
  out.stress_free = mesh.reference;
  return out;
}

Postures solve_sliding_postures(const HexMesh& imaged, const MaterialSet& materials,
                                std::shared_ptr<const LevelSurface> surface, Progress& progress) {
  MechanicsOptions options;
  options.materials = materials;
  options.element = element_of(imaged);
  take_supports_of_set(options);
  options.wall_surface = std::move(surface);
  // As fast as multigrid on these meshes, which gives up on some of the breasts.
  options.solver = SolverOption::direct;
  Postures out;
  out.model = model_text(options);
  HexMesh mesh = imaged;
  const Equilibrium prone =
      solve_backward(mesh, posture_gravity(Posture::prone), options, progress);
  must_converge(prone, mesh, "stress-free");
  store(prone, mesh);
  out.prone = prone;
  out.stress_free = mesh.reference;
  out.pressure = mesh.pressure;
  const Equilibrium supine =
      solve_forward(mesh, posture_gravity(Posture::supine), options, progress);
  must_converge(supine, mesh, "supine");
  store(supine, mesh);
  out.supine_solve = supine;
  out.supine = std::move(mesh.points);
  return out;
}

void carry_landmarks(const HexMesh& from, HexMesh& to) {
  const Locator locator(to, to.reference);
  to.landmarks.clear();
  for (const Landmark& landmark : from.landmarks) {
    const Vec3 point = landmark_position(from, from.reference, landmark);
    const Location at = landmark.name == "nipple"
                            ? nearest_on_faces(to, to.reference, to.skin_faces, point)
                            : locator.nearest(point);
    to.landmarks.push_back({landmark.name, element_position(to, to.imaged, at.element, at.local),
                            at.element, at.local, at.moved});
    if (landmark.name == "tumour") to.tumour_node = nearest_node(to.reference, point);
  }
}

namespace {

HexMesh half_resolution(const PhantomBreast& breast, const PhantomParameters& parameters) {
  const auto half = [](int n) { return (n + 1) / 2; };
  MeshParameters size = parameters.mesh;
  size.core = 2 * half(half(size.core));
  size.shell = half(size.shell), size.skirt = half(size.skirt);
  size.slab = half(size.slab), size.rise = half(size.rise);
  HexMesh mesh = phantom_mesh(breast.shape, breast.body_map(), size);
  assign_gland(breast.gland, mesh);
  mesh.skin_model = breast.mesh.skin_model;
  if (mesh.skin_model == SkinModel::membrane)
    mesh.skin_thickness.assign(mesh.skin_faces.size(), parameters.skin);
  return mesh;
}

TruthError compare(const HexMesh& fine, const Postures& fine_postures, const HexMesh& coarse,
                   const Postures& coarse_postures) {
  const Locator locator(coarse, coarse.reference);
  TruthError error;
  error.elements = coarse.elements();
  for (const Landmark& landmark : fine.landmarks) {
    const Location at = locator.nearest(landmark_position(fine, fine.reference, landmark));
    const auto gap = [&](const std::vector<Vec3>& there, const std::vector<Vec3>& here) {
      return (element_position(coarse, there, at.element, at.local) -
              landmark_position(fine, here, landmark))
          .norm();
    };
    error.prone_mm = std::max(error.prone_mm, gap(coarse.points, fine.points));
    error.supine_mm = std::max(error.supine_mm, gap(coarse_postures.supine, fine_postures.supine));
  }
  return error;
}

}  // namespace

Postures solve_breast(PhantomBreast& breast, const PhantomParameters& parameters,
                      const MaterialSet& materials, TruthError& error, Progress& progress) {
  HexMesh coarse = half_resolution(breast, parameters);
  if (parameters.body.slides) {
    std::shared_ptr<const LevelSurface> ribs;
    if (!breast.mesh.geometry) ribs = std::make_shared<RibSurface>(parameters.torso);
    coarse.geometry = breast.mesh.geometry;
    const Postures guess = solve_sliding_postures(coarse, materials, ribs, progress);
    const Postures postures = solve_sliding_postures(breast.mesh, materials, ribs, progress);
    error = compare(breast.mesh, postures, coarse, guess);
    return postures;
  }
  const Postures coarse_postures = solve_postures(coarse, materials, progress);
  // The displacement of the coarse mesh gives an initial guess of the imaged shape, which saves a
  // solve on the fine mesh.
  HexMesh& mesh = breast.mesh;
  const Locator locator(coarse, coarse.reference);
#pragma omp parallel for schedule(dynamic, 256) num_threads(threads())
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Location at = locator.nearest(mesh.reference[n]);
    mesh.imaged[n] = mesh.reference[n] +
                     element_position(coarse, coarse.points, at.element, at.local) -
                     element_position(coarse, coarse.reference, at.element, at.local);
  }
  const Postures postures = solve_postures(mesh, materials, progress);
  error = compare(mesh, postures, coarse, coarse_postures);
  return postures;
}

}  // namespace breast
