// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/overlap.hpp"

#include <cmath>
#include <utility>

#include "core/parallel.hpp"
#include "core/units.hpp"
#include "image/nearest_voxel.hpp"

namespace breast {

namespace {

// Classes: the tissue codes, then the breast as a whole.
constexpr int breast_class = n_tissues, n_classes = n_tissues + 1;
using Counts = std::array<long long, n_classes>;

void count(Counts& counts, Tissue tissue) {
  ++counts[std::size_t(tissue)];
  if (is_breast(tissue)) ++counts[breast_class];
}

Counts count_all(const LabelVolume& labels) {
  Counts counts{};
  for (const std::uint8_t code : labels.tissue) count(counts, static_cast<Tissue>(code));
  return counts;
}

// Voxels of `fine` whose nearest voxel of `coarse` has the same class.
Counts count_common(const LabelVolume& fine, const LabelVolume& coarse) {
  const Grid& grid = fine.grid;
  const Mat3 to_coarse = coarse.grid.spacing.cwiseInverse().asDiagonal() *
                         coarse.grid.direction.inverse() * grid.direction *
                         grid.spacing.asDiagonal();
  const Vec3 start = coarse.grid.to_index(grid.origin);
  Counts total{};
#pragma omp parallel num_threads(threads())
  {
    Counts mine{};
#pragma omp for schedule(static)
    for (int k = 0; k < grid.size[2]; ++k) {
      for (int j = 0; j < grid.size[1]; ++j) {
        for (int i = 0; i < grid.size[0]; ++i) {
          const Vec3 at = start + to_coarse * Vec3(i, j, k);
          const int ci = int(std::lround(at.x())), cj = int(std::lround(at.y())),
                    ck = int(std::lround(at.z()));
          if (!coarse.grid.contains(ci, cj, ck)) continue;
          const Tissue a = fine.at(i, j, k), b = coarse.at(ci, cj, ck);
          if (a == b) ++mine[std::size_t(a)];
          if (is_breast(a) && is_breast(b)) ++mine[breast_class];
        }
      }
    }
#pragma omp critical
    for (int c = 0; c < n_classes; ++c) total[std::size_t(c)] += mine[std::size_t(c)];
  }
  return total;
}

/// Body against air on the voxels of `fine` inside `coarse`, without the regions that only one of
/// them covers.
Overlap body_overlap(const LabelVolume& fine, const LabelVolume& coarse) {
  const Grid& grid = fine.grid;
  const NearestVoxel nearest(coarse.grid);
  double mine = 0, theirs = 0, both = 0;
#pragma omp parallel for num_threads(threads()) reduction(+ : mine, theirs, both)
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::ptrdiff_t voxel = nearest.at(grid.to_patient(Vec3(i, j, k)));
        if (voxel < 0) continue;
        const bool a = fine.at(i, j, k) != Tissue::air,
                   b = coarse.tissue[std::size_t(voxel)] != std::uint8_t(Tissue::air);
        mine += a;
        theirs += b;
        both += a && b;
      }
    }
  }
  const double ml = grid.voxel_volume() / mm3_per_ml;
  return {mine * ml, theirs * ml, mine + theirs > 0 ? 2 * both / (mine + theirs) : 1};
}

}  // namespace

LabelOverlap compare_labels(const LabelVolume& given, const LabelVolume& truth) {
  const double given_ml = given.grid.voxel_volume() / mm3_per_ml;
  const double truth_ml = truth.grid.voxel_volume() / mm3_per_ml;
  const bool given_finer = given_ml <= truth_ml;
  const Counts common = given_finer ? count_common(given, truth) : count_common(truth, given);
  const Counts of_given = count_all(given), of_truth = count_all(truth);
  LabelOverlap result;
  for (int c = 0; c < n_classes; ++c) {
    const auto i = std::size_t(c);
    Overlap& overlap = c == breast_class ? result.breast : result.tissue[i];
    overlap.given_ml = double(of_given[i]) * given_ml;
    overlap.truth_ml = double(of_truth[i]) * truth_ml;
    const double both = double(common[i]) * (given_finer ? given_ml : truth_ml);
    const double sum = overlap.given_ml + overlap.truth_ml;
    overlap.dice = sum > 0 ? 2 * both / sum : 1;
  }
  result.body = given_finer ? body_overlap(given, truth) : body_overlap(truth, given);
  if (!given_finer) std::swap(result.body.given_ml, result.body.truth_ml);
  return result;
}

double gland_dice_in_breast(const LabelVolume& given, const LabelVolume& truth,
                            const std::vector<bool>& half) {
  const Grid& grid = given.grid;
  const NearestVoxel nearest(truth.grid);
  double found = 0, known = 0, both = 0;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const Tissue ours = given.at(i, j, k);
        if (!is_breast(ours)) continue;
        const std::ptrdiff_t voxel = nearest.at(grid.to_patient(Vec3(i, j, k)));
        if (voxel < 0) continue;
        const auto theirs = static_cast<Tissue>(truth.tissue[std::size_t(voxel)]);
        if (theirs == Tissue::tumour) continue;
        const bool is_half = !half.empty() && half[std::size_t(voxel)];
        const double weight = is_half ? 0.5 : 1;
        const bool a = ours == Tissue::fibroglandular,
                   b = is_half || theirs == Tissue::fibroglandular;
        found += a ? weight : 0;
        known += b ? weight : 0;
        both += a && b ? weight : 0;
      }
    }
  }
  return found + known > 0 ? 2 * both / (found + known) : 1;
}

}  // namespace breast
