// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/tissue.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "image/nearest_voxel.hpp"
#include "mesh/lattice.hpp"
#include "mesh/locate.hpp"
#include "mesh/quality.hpp"

namespace breast {

namespace {

struct ElementSamples {
  double total = 0, breast = 0, gland = 0, tumour = 0;  // weights in mm³
};

ElementSamples sample_element(const LabelVolume& labels, const NearestVoxel& sampler,
                              const HexMesh& mesh, int e) {
  const int* vtk = lattice::vtk_nodes(mesh.order);
  std::array<Vec3, 27> own;
  for (int a = 0; a < mesh.nodes_per_element(); ++a) own[a] = mesh.imaged[mesh.element(e)[vtk[a]]];
  ElementSamples sums;
  for (int s = 0; s < 27; ++s) {
    const Vec3 local = Vec3(s % 3 - 1, (s / 3) % 3 - 1, s / 9 - 1) * (2.0 / 3);
    Vec3 x;
    Mat3 jacobian;
    lattice::evaluate(mesh.order, own.data(), local, x, jacobian);
    const double weight = std::abs(jacobian.determinant()) * 8 / 27;
    sums.total += weight;
    const std::ptrdiff_t voxel = sampler.at(x);
    if (voxel < 0) continue;
    const Tissue tissue = static_cast<Tissue>(labels.tissue[voxel]);
    if (!is_breast(tissue)) continue;
    sums.breast += weight;
    const double gland = labels.fibroglandular_fraction.empty()
                             ? double(tissue == Tissue::fibroglandular)
                             : double(labels.fibroglandular_fraction[voxel]);
    sums.gland += weight * gland;
    if (tissue == Tissue::tumour) sums.tumour += weight;
  }
  return sums;
}

// The fraction above which whole elements make up the given glandular volume.
double volume_preserving_threshold(const HexTopology& mesh, const std::vector<double>& volumes,
                                   double wanted) {
  std::vector<int> order(volumes.size());
  std::iota(order.begin(), order.end(), 0);
  const auto& fraction = mesh.fibroglandular_fraction;
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return fraction[a] != fraction[b] ? fraction[a] > fraction[b] : a < b;
  });
  double sum = 0, threshold = 1;
  for (const int e : order) {
    if (sum + 0.5 * volumes[e] > wanted) break;
    sum += volumes[e];
    threshold = fraction[e];
  }
  return std::clamp(threshold, 0.1, 0.7);
}

// Share of the breast's voxels outside the mesh, estimated from about every eighth voxel.
double missed_share(const LabelVolume& labels, const HexMesh& mesh, long long breast_voxels) {
  const Locator locator(mesh, mesh.imaged);
  const int stride = std::max(1, int(std::cbrt(double(breast_voxels) / 40000)));
  const Grid& grid = labels.grid;
  long long seen = 0, missed = 0;
#pragma omp parallel for num_threads(threads()) reduction(+ : seen, missed) schedule(dynamic, 1)
  for (int k = 0; k < grid.size[2]; ++k) {
    int hint = -1;
    for (int j = 0; j < grid.size[1]; j += stride) {
      for (int i = (j / stride + k) % stride; i < grid.size[0]; i += stride) {
        if (!is_breast(labels.at(i, j, k))) continue;
        ++seen;
        const auto found = locator.find(grid.to_patient(Vec3(i, j, k)), hint);
        if (found) hint = found->element;
        missed += !found;
      }
    }
  }
  return seen > 0 ? double(missed) / double(seen) : 0;
}

}  // namespace

std::array<double, n_tissues> tissue_volumes(const HexMesh& mesh) {
  std::array<double, n_tissues> sums{};
  const std::vector<double> volumes = element_volumes(mesh, mesh.points);
  for (int e = 0; e < mesh.elements(); ++e) sums[int(mesh.tissue[e])] += volumes[e];
  return sums;
}

TissueReport assign_tissue(const LabelVolume& labels, HexMesh& mesh) {
  if (labels.side != mesh.side) {
    throw input_error("labels are of the ", side_name(labels.side),
                      " breast and the geometry of the ", side_name(mesh.side),
                      " breast: give the labels to which the geometry was fitted");
  }
  long long breast_voxels = 0;
  for (const std::uint8_t code : labels.tissue)
    breast_voxels += is_breast(static_cast<Tissue>(code));
  if (breast_voxels == 0)
    throw input_error("the labels have no breast voxels (fat, fibroglandular, skin)");
  const int elements = mesh.elements();
  mesh.tissue.resize(elements, Tissue::fat);
  mesh.fibroglandular_fraction.assign(elements, 0.0f);
  const NearestVoxel sampler(labels.grid);
  std::vector<ElementSamples> samples(elements);
#pragma omp parallel for num_threads(threads()) schedule(static)
  for (int e = 0; e < elements; ++e) samples[e] = sample_element(labels, sampler, mesh, e);
  TissueReport report;
  double total = 0, inside = 0;
  const std::vector<double> volumes = element_volumes(mesh, mesh.imaged);
  for (int e = 0; e < elements; ++e) {
    const ElementSamples& s = samples[e];
    total += s.total;
    inside += s.breast;
    if (mesh.tissue[e] == Tissue::skin) continue;
    const double gland = s.breast > 0 ? s.gland / s.breast : 0;
    mesh.fibroglandular_fraction[e] = float(gland);
    report.fibroglandular_volume += gland * volumes[e];
  }
  report.gland_threshold = volume_preserving_threshold(mesh, volumes, report.fibroglandular_volume);
  for (int e = 0; e < elements; ++e) {
    if (mesh.tissue[e] == Tissue::skin) continue;
    const bool gland = mesh.fibroglandular_fraction[e] >= report.gland_threshold;
    const bool tumour = samples[e].breast > 0 && samples[e].tumour >= 0.5 * samples[e].breast;
    mesh.tissue[e] = tumour ? Tissue::tumour : gland ? Tissue::fibroglandular : Tissue::fat;
  }
  if (!(inside > 0)) {
    throw input_error(
        "no element of the mesh lies in a breast voxel: the labels and the geometry are of "
        "different scans or frames");
  }
  report.volume = tissue_volumes(mesh);
  report.outside_fraction = 1 - inside / total;
  report.segmented_volume = double(breast_voxels) * labels.grid.voxel_volume();
  report.missed_fraction = missed_share(labels, mesh, breast_voxels);
  return report;
}

}  // namespace breast
