// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh against a label volume of the VICTRE sample breast, before or after
// VICTRE's own compression.
//
//     bench_victre MESH.vtkhdf LABELS.nrrd X Y Z [FRONT]
//
// X Y Z: offset of the volume's first voxel in VICTRE's frame (x from the chest wall to the nipple,
// y left, z superior; p_1.mhd, pc_1.mhd). The mesh, of a left breast, lies in the frame of the
// simulated MR. Prints overlap and distances, of all and of what lies in front of x = FRONT mm, on
// a grid of 1 mm.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "core/error.hpp"
#include "evaluation/foreign_labels.hpp"
#include "evaluation/label_surface.hpp"
#include "evaluation/overlap.hpp"
#include "evaluation/surface_distance.hpp"
#include "io/mesh_file.hpp"
#include "io/volume_file.hpp"
#include "mesh/locate.hpp"

namespace breast {
namespace {

/// VICTRE's (x, y, z) in the MR scene: P = −x, L = ±(65.19 − y), S = z + 0.4. phantomC_info.json's
/// words give 65.15 and 0.52; these are from the centres of gland and nipple in both.
Vec3 in_scene(const Vec3& x, Side side) {
  return {lateral_sign(side) * (65.19 - x.y()), -x.x(), x.z() + 0.4};
}

/// Every `stride`-th voxel of VICTRE's volume, placed in the scene; muscle and paddles become air.
LabelVolume truth_labels(const Volume<float>& native, const Vec3& offset, Side side, int stride) {
  const TissueCodes codes =
      parse_tissue_codes({"1=fat", "88=fat", "150=fat", "225=fat", "29=fibroglandular",
                          "95=fibroglandular", "125=fibroglandular", "2=skin", "33=skin"});
  LabelVolume truth;
  for (int d = 0; d < 3; ++d)
    truth.grid.size[std::size_t(d)] = native.grid.size[std::size_t(d)] / stride;
  truth.grid.spacing = Vec3::Constant(0.2 * stride);
  truth.grid.direction.col(0) = Vec3(0, -1, 0);
  truth.grid.direction.col(1) = Vec3(-lateral_sign(side), 0, 0);
  truth.grid.direction.col(2) = Vec3(0, 0, 1);
  const int half = stride / 2;
  truth.grid.origin = in_scene(offset + Vec3::Constant(0.2 * (half + 0.5)), side);
  truth.side = side;
  for (int k = 0; k < truth.grid.size[2]; ++k) {
    for (int j = 0; j < truth.grid.size[1]; ++j) {
      for (int i = 0; i < truth.grid.size[0]; ++i) {
        const int code = int(native.at(stride * i + half, stride * j + half, stride * k + half));
        const auto known = codes.values.find(code);
        const bool is_known = known != codes.values.end();
        truth.tissue.push_back(std::uint8_t(is_known ? known->second : Tissue::air));
      }
    }
  }
  return truth;
}

/// The mesh's tissues at the voxels of `grid`; its skin has no volume.
LabelVolume mesh_labels(const HexMesh& mesh, const Grid& grid) {
  LabelVolume labels;
  labels.grid = grid;
  labels.side = mesh.side;
  labels.tissue.assign(grid.voxels(), std::uint8_t(Tissue::air));
  const Locator locator(mesh, mesh.points);
  int hint = -1;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const auto at = locator.find(grid.to_patient(Vec3(i, j, k)), hint);
        if (!at) continue;
        hint = at->element;
        labels.tissue[grid.offset(i, j, k)] = std::uint8_t(mesh.tissue[std::size_t(hint)]);
      }
    }
  }
  return labels;
}

/// Without what lies behind x = front mm of VICTRE's frame.
LabelVolume in_front(LabelVolume labels, double front) {
  const int first =
      int(std::ceil(labels.grid.to_index(in_scene(Vec3(front, 0, 0), labels.side)).x()));
  for (int k = 0; k < labels.grid.size[2]; ++k) {
    for (int j = 0; j < labels.grid.size[1]; ++j) {
      for (int i = 0; i < std::min(first, labels.grid.size[0]); ++i) {
        labels.tissue[labels.grid.offset(i, j, k)] = std::uint8_t(Tissue::air);
      }
    }
  }
  return labels;
}

void print_row(const char* part, const LabelVolume& given, const LabelVolume& truth) {
  const LabelOverlap overlap = compare_labels(given, truth);
  const Overlap& gland = overlap.tissue[int(Tissue::fibroglandular)];
  const SurfaceComparison surface = compare_surfaces(breast_surface(given), breast_surface(truth));
  std::printf("%s\t%.4f\t%.1f\t%.1f\t%.4f\t%.1f\t%.1f\t%.2f\t%.2f\t%.2f\n", part,
              overlap.breast.dice, overlap.breast.given_ml, overlap.breast.truth_ml, gland.dice,
              gland.given_ml, gland.truth_ml, surface.both.mean_mm, surface.both.p95_mm,
              surface.both.max_mm);
}

int run(int arguments, char** argument) {
  const HexMesh mesh = read_mesh(argument[1]);
  const Vec3 offset(std::atof(argument[3]), std::atof(argument[4]), std::atof(argument[5]));
  const LabelVolume truth = truth_labels(read_volume(argument[2]), offset, mesh.side, 5);
  const LabelVolume given = mesh_labels(mesh, truth.grid);
  std::printf(
      "part\tbreast_dice\tgiven_ml\ttruth_ml\tgland_dice\tgiven_ml\ttruth_ml\tsurface_mean_mm\t"
      "p95_mm\tmax_mm\n");
  print_row("all", given, truth);
  if (arguments > 6) {
    const double front = std::atof(argument[6]);
    print_row("front", in_front(given, front), in_front(truth, front));
  }
  return 0;
}

}  // namespace
}  // namespace breast

int main(int arguments, char** argument) {
  if (arguments < 6 || arguments > 7) {
    std::fprintf(stderr, "usage: bench_victre MESH.vtkhdf LABELS.nrrd X Y Z [FRONT]\n");
    return 2;
  }
  try {
    return breast::run(arguments, argument);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_victre: %s\n", error.what());
    return 1;
  }
}
