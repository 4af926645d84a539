#include "phantom/postures.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "core/error.hpp"
#include "core/units.hpp"
#include "mesh/locate.hpp"
#include "mesh/quality.hpp"

namespace breast {

namespace {

SolveSummary equilibrium(HexMesh& mesh, const char* posture, const MaterialSet& materials,
                         Progress& progress) {
  MechanicsOptions options;
  options.materials = materials;
  options.element = mesh.order == 2 ? Element::q2p1 : Element::q1p0;
  options.cut = Cut::fixed;
  SolveSummary summary = solve_forward(mesh, posture_gravity(posture), options, progress);
  if (!summary.converged()) {
    throw not_converged_error("phantom, ", side_name(mesh.side), " breast, ", posture, ": ",
                              summary.record.reason);
  }
  return summary;
}

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double worst = 0;
  for (std::size_t n = 0; n < a.size(); ++n) worst = std::max(worst, (a[n] - b[n]).norm());
  return worst;
}

}  // namespace

Postures solve_postures(HexMesh& mesh, const MaterialSet& materials, Progress& progress) {
  constexpr double agreement = 1e-6;  // mm
  Postures out;
  mesh.imaged = mesh.reference;
  for (int pass = 0; pass < 6; ++pass) {
    out.prone = equilibrium(mesh, "prone", materials, progress);
    out.imaged_gap = largest_distance(mesh.points, mesh.imaged);
    if (getenv("DBG")) fprintf(stderr, "gap %g\n", out.imaged_gap);
    if (out.imaged_gap < agreement) break;
    mesh.imaged = mesh.points;
  }
  for (Landmark& landmark : mesh.landmarks)
    landmark.imaged = landmark_position(mesh, mesh.imaged, landmark);
  mesh.scaled_jacobian = scaled_jacobians(mesh, mesh.points);
  HexMesh supine = mesh;
  out.supine_solve = equilibrium(supine, "supine", materials, progress);
  out.supine = std::move(supine.points);
  return out;
}

TruthError truth_error(const PhantomBreast& breast, const Postures& fine,
                       const PhantomParameters& parameters, const MaterialSet& materials,
                       Progress& progress) {
  const auto half = [](int n) { return (n + 1) / 2; };
  MeshParameters size = parameters.mesh;
  size.core = 2 * half(half(size.core));
  size.shell = half(size.shell), size.skirt = half(size.skirt);
  size.slab = half(size.slab), size.rise = half(size.rise);
  HexMesh coarse = phantom_mesh(breast.shape, breast.map, size);
  assign_gland(breast.gland, coarse);
  coarse.skin_model = breast.mesh.skin_model;
  if (coarse.skin_model == SkinModel::membrane)
    coarse.skin_thickness.assign(coarse.skin_faces.size(), parameters.skin);
  const Postures solved = solve_postures(coarse, materials, progress);
  const Locator locator(coarse, coarse.reference);
  TruthError error;
  error.elements = coarse.elements();
  for (const Landmark& landmark : breast.mesh.landmarks) {
    const Location at =
        locator.nearest(landmark_position(breast.mesh, breast.mesh.reference, landmark));
    const auto gap = [&](const std::vector<Vec3>& coarse_field, const std::vector<Vec3>& field) {
      return (element_position(coarse, coarse_field, at.element, at.local) -
              landmark_position(breast.mesh, field, landmark))
          .norm();
    };
    error.prone_mm = std::max(error.prone_mm, gap(coarse.points, breast.mesh.points));
    error.supine_mm = std::max(error.supine_mm, gap(solved.supine, fine.supine));
  }
  return error;
}

}  // namespace breast
