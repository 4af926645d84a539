// SPDX-License-Identifier: GPL-3.0-or-later
// The same scan as another scanner or operator would have made it, for programs that start from files.
//
//     changed_scan                          the names of all changes, one a line
//     changed_scan MR OUT.nrrd CHANGE       the scan after that change
//     changed_scan MR OUT.nrrd voxels=N     the scan in N million voxels of the same shape
//     changed_scan MR OUT.nrrd rolled=D     the body turned by D degrees about its long axis,
//     changed_scan MR OUT.nrrd pitched=D    or about the axis from its right to its left
//     changed_scan LABELS OUT mirrored      a label map or labels.vtkhdf, whose voxels stay as they are
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "fixtures/perturbed_scan.hpp"
#include "io/label_file.hpp"
#include "io/volume_file.hpp"
#include "segment/grid/grid_ops.hpp"

namespace breast {
namespace {

const std::string mirror = "mirrored", unchanged = "unchanged",
                  voxels = "voxels=", rolled = "rolled=", pitched = "pitched=";

std::vector<testing::Perturbation> changes() {
  std::vector<testing::Perturbation> all{{unchanged, [](const Volume<float>& s) { return s; }}};
  for (testing::Perturbation& change : testing::resamplings()) all.push_back(std::move(change));
  all.push_back({mirror, testing::mirrored});
  return all;
}

/// Voxels of the same shape, a million of them times `millions`, over the same field of view.
Volume<float> in_voxels(const Volume<float>& scan, double millions) {
  const double finer = std::cbrt(millions * 1e6 / double(scan.grid.voxels()));
  Grid grid = scan.grid;
  for (int d = 0; d < 3; ++d) {
    grid.size[d] = std::max(2, int(std::lround(scan.grid.size[d] * finer)));
    grid.spacing[d] *= double(scan.grid.size[d]) / grid.size[d];
  }
  grid.origin =
      scan.grid.to_patient(0.5 * (grid.spacing.cwiseQuotient(scan.grid.spacing) - Vec3::Ones()));
  return testing::on_grid(scan, grid, 1);
}

Volume<float> changed(const Volume<float>& scan, const std::string& name) {
  if (name.starts_with(voxels)) return in_voxels(scan, std::stod(name.substr(voxels.size())));
  if (name.starts_with(rolled))
    return testing::oblique(scan, std::stod(name.substr(rolled.size())));
  if (name.starts_with(pitched))
    return testing::oblique(scan, std::stod(name.substr(pitched.size())), 0);
  for (const testing::Perturbation& change : changes())
    if (change.name == name) return change.apply(scan);
  throw input_error("no change is called '", name, "'; call without arguments for their names");
}

/// The labels of the other breast of the mirror image, about the plane x = 0.
LabelVolume mirrored_labels(LabelVolume labels) {
  const Grid grid = labels.grid;
  labels.grid = testing::mirrored(Volume<float>(grid)).grid;
  const auto turned = [&](auto voxels) {
    for (auto row = voxels.begin(); row != voxels.end(); row += grid.size[0])
      std::reverse(row, row + grid.size[0]);
    return voxels;
  };
  labels.tissue = turned(std::move(labels.tissue));
  labels.fibroglandular_fraction = turned(std::move(labels.fibroglandular_fraction));
  labels.chest_wall_confidence = turned(std::move(labels.chest_wall_confidence));
  labels.side = labels.side == Side::left ? Side::right : Side::left;
  for (auto& [name, place] : labels.landmarks) place[0] *= -1;
  if (labels.midline_mm) labels.midline_mm = -*labels.midline_mm;
  return labels;
}

/// 16-bit, dimmed as a whole where the brightest voxel would not fit.
void write(const std::string& file, const Volume<float>& volume) {
  constexpr float most = 32767;
  const float brightest = *std::max_element(volume.voxels.begin(), volume.voxels.end());
  const float dimmed = std::min(1.0F, most / std::max(brightest, 1.0F));
  Volume<std::int16_t> whole(volume.grid);
  for (std::size_t n = 0; n < whole.voxels.size(); ++n)
    whole.voxels[n] = std::int16_t(std::round(std::clamp(dimmed * volume.voxels[n], 0.0F, most)));
  write_volume(file, whole);
}

void run(const std::string& from, const std::string& to, const std::string& name) {
  if (!from.ends_with(".vtkhdf"))
    return write(to, changed(in_patient_order(read_volume(from)), name));
  if (name != mirror) throw input_error("labels can only be ", mirror);
  write_labels(to, mirrored_labels(read_labels(from)));
}

}  // namespace
}  // namespace breast

int main(int argc, char** argv) {
  try {
    if (argc == 1)
      for (const auto& change : breast::changes()) std::printf("%s\n", change.name.c_str());
    else if (argc == 4)
      breast::run(argv[1], argv[2], argv[3]);
    else
      throw breast::input_error("usage: changed_scan [MR OUT.nrrd CHANGE]");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "changed_scan: %s\n", error.what());
    return 1;
  }
}
