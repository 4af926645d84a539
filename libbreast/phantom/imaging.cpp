// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/imaging.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "phantom/material_frame.hpp"

namespace breast {

Grid phantom_grid(const MriParameters& p) {
  if (!(p.voxel_factor >= 1 && p.voxel_factor <= 8)) {
    throw input_error("phantom voxel factor ", p.voxel_factor, ": must lie between 1 and 8");
  }
  Grid grid;
  const Vec3 spacing = p.voxel_factor * Vec3(0.82, 0.82, 2.5),
             field(512 * 0.82, 512 * 0.82, 60 * 2.5);
  const Vec3 corner(-0.5 * field.x(), -142, -0.5 * field.z());
  for (int a = 0; a < 3; ++a) grid.size[a] = int(std::lround(field[a] / spacing[a]));
  grid.spacing = spacing;
  grid.origin = corner + 0.5 * spacing;
  return grid;
}

namespace {

// Counts of the subsamples of one voxel.
struct Tally {
  double signal = 0;
  std::array<int, n_matters> matter{};
  std::array<int, n_tissues> tissue{};
  int count = 0;
  void add(Matter m, Tissue t) {
    signal += matter_signal(m);
    ++matter[std::size_t(m)];
    ++tissue[std::size_t(t)];
    ++count;
  }
};

class Imager {
 public:
  Imager(const PhantomScene& scene, PhantomImage& image)
      : scene_(scene),
        image_(image),
        grid_(image.signal.grid),
        frames_{BreastFrames(*scene.left, grid_), BreastFrames(*scene.right, grid_)} {}

  void slice(int k) {
    const int nx = grid_.size[0], ny = grid_.size[1];
    // Matter of the rigid body in three planes of the slice shows where subsamples are needed.
    std::vector<Probe> probe(std::size_t(nx) * ny);
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) probe[std::size_t(j) * nx + i] = probe_rigid(i, j, k);
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const Vec3 centre = grid_.to_patient(Vec3(i, j, k));
        MaterialFrame frame;
        int side = 0;
        for (int s = 0; s < 2 && side == 0; ++s)
          if (frames_[s].at(i, j, k, frame)) side = s + 1;
        Tally tally;
        if (side > 0) {
          breast_voxel(scene_.breast(side == 1 ? Side::left : Side::right), centre, frame, tally);
        } else {
          rigid_voxel(centre, probe[std::size_t(j) * nx + i], mixed(probe, i, j), tally);
        }
        store(grid_.offset(i, j, k), side, tally);
      }
  }

 private:
  // The matter of the rigid body at the centre of a voxel, and whether it is the same above and
  // below.
  struct Probe {
    Matter matter = Matter::air;
    Tissue tissue = Tissue::air;
    bool mixed = false;
    bool differs(const Probe& other) const {
      return mixed != other.mixed || (!mixed && matter != other.matter);
    }
  };

  // Matter of the rigid body; `tissue` gets its label.
  Matter rigid_matter(const Vec3& x, Tissue& tissue) const {
    const auto [skin, wall] = scene_.torso.distances(x);
    return rigid_matter(x, skin, wall, tissue);
  }

  Matter rigid_matter(const Vec3& x, double skin, double wall, Tissue& tissue) const {
    tissue = Tissue::air;
    if (skin > 0) return Matter::air;
    if (wall > 0) {
      // Within the cut, everything outside the breast is air. The last 3 mm before the cut hardly
      // move, so that the rigid skin is accurate enough there.
      if (scene_.left->inside_cut(x, 3) || scene_.right->inside_cut(x, 3)) {
        return Matter::air;
      }
      tissue = Tissue::other;
      return skin > -scene_.parameters.skin ? Matter::skin : Matter::fat;
    }
    tissue = Tissue::muscle;
    return scene_.torso.interior(x, -wall);
  }

  Probe probe_rigid(int i, int j, int k) const {
    const Vec3 centre = grid_.to_patient(Vec3(i, j, k));
    const auto [skin, wall] = scene_.torso.distances(centre);
    Probe probe;
    if (skin > 4 * grid_.spacing.z()) return probe;
    probe.matter = rigid_matter(centre, skin, wall, probe.tissue);
    const Vec3 up = grid_.direction.col(2) * (grid_.spacing.z() / 2);
    Tissue tissue;
    for (double s : {-1.0, 1.0})
      probe.mixed = probe.mixed || rigid_matter(centre + s * up, tissue) != probe.matter;
    return probe;
  }

  bool mixed(const std::vector<Probe>& probe, int i, int j) const {
    const int nx = grid_.size[0], ny = grid_.size[1];
    const Probe& own = probe[std::size_t(j) * nx + i];
    if (own.mixed) return true;
    const auto differs = [&](int a, int b) {
      return a >= 0 && b >= 0 && a < nx && b < ny && probe[std::size_t(b) * nx + a].differs(own);
    };
    return differs(i - 1, j) || differs(i + 1, j) || differs(i, j - 1) || differs(i, j + 1);
  }

  // Calls `add` at the centres of n[0]×n[1]×n[2] equal parts of a voxel.
  template <class Add>
  void subsample(const Vec3& centre, const std::array<int, 3>& n, Add add) const {
    for (int c = 0; c < n[2]; ++c)
      for (int b = 0; b < n[1]; ++b)
        for (int a = 0; a < n[0]; ++a) {
          const Vec3 part((a + 0.5) / n[0] - 0.5, (b + 0.5) / n[1] - 0.5, (c + 0.5) / n[2] - 0.5);
          add(Vec3(centre + grid_.direction * grid_.spacing.cwiseProduct(part)));
        }
  }

  void rigid_voxel(const Vec3& centre, const Probe& probe, bool is_mixed, Tally& tally) const {
    if (!is_mixed) {
      tally.add(probe.matter, probe.tissue);
      return;
    }
    Tissue tissue;
    subsample(centre, {2, 2, 3}, [&](const Vec3& x) {
      const Matter matter = rigid_matter(x, tissue);
      tally.add(matter, tissue);
    });
  }

  void breast_voxel(const PhantomBreast& breast, const Vec3& centre, const MaterialFrame& frame,
                    Tally& tally) const {
    const double size = grid_.spacing.norm();
    const BreastShape& shape = breast.shape;
    const double skin = shape.outline(frame.stress_free);
    const bool near_skin = skin > -size - 4;
    const bool near_wall = scene_.torso.wall_distance(centre) < size;
    const Vec3& n = scene_.parameters.mri.samples;
    subsample(centre, {int(n[0]), int(n[1]), int(n[2])}, [&](const Vec3& x) {
      const double wall = near_wall ? scene_.torso.wall_distance(x) : size;
      if (wall < 0) {
        tally.add(scene_.torso.interior(x, -wall), Tissue::muscle);
        return;
      }
      const Vec3 material = frame.at(x);
      Matter matter = Matter::fat;
      const double depth = near_skin ? shape.outline(material) : -size;
      if (depth > 0) {
        matter = Matter::air;
      } else if (near_skin && shape.nipple_distance(material) < 0) {
        matter = Matter::nipple;
      } else if (near_skin && depth > -shape.skin_thickness(material)) {
        matter = Matter::skin;
      } else {
        matter = breast.gland.matter(material);
      }
      tally.add(matter, breast_tissue(matter));
    });
  }

  void store(std::size_t at, int side, const Tally& tally) {
    const auto most = std::max_element(tally.tissue.begin(), tally.tissue.end());
    image_.signal.voxels[at] = float(tally.signal / tally.count);
    if (!image_.parts.water.voxels.empty()) store_parts(at, tally);
    image_.tissue[at] = std::uint8_t(most - tally.tissue.begin());
    image_.side[at] = std::uint8_t(side);
    image_.gland_percent[at] = std::uint8_t(
        std::lround(100.0 * tally.tissue[std::size_t(Tissue::fibroglandular)] / tally.count));
  }

  void store_parts(std::size_t at, const Tally& tally) {
    WaterFat sum;
    for (int m = 0; m < n_matters; ++m) {
      const WaterFat part = matter_water_fat(Matter(m));
      sum.water += tally.matter[std::size_t(m)] * part.water;
      sum.fat += tally.matter[std::size_t(m)] * part.fat;
    }
    image_.parts.water.voxels[at] = float(sum.water / tally.count);
    image_.parts.fat.voxels[at] = float(sum.fat / tally.count);
    image_.signal.voxels[at] = float(sum.in_phase() / tally.count);
  }

  const PhantomScene& scene_;
  PhantomImage& image_;
  const Grid& grid_;
  std::array<BreastFrames, 2> frames_;
};

}  // namespace

PhantomImage image_scene(const PhantomScene& scene, Progress& progress, const RigidMotion& moved,
                         bool parts) {
  PhantomImage image;
  const Grid scanner = phantom_grid(scene.parameters.mri);
  // For a body that was moved, the grid of the scanner is moved instead.
  Grid seen = scanner;
  seen.origin = moved.origin_of(scanner.origin);
  seen.direction = moved.rotation().transpose() * scanner.direction;
  image.signal = Volume<float>(seen);
  if (parts) image.parts = {image.signal, image.signal};
  const Grid& grid = image.signal.grid;
  image.tissue.resize(grid.voxels());
  image.side.resize(grid.voxels());
  image.gland_percent.resize(grid.voxels());
  progress.update("image", 0, "locating voxels in the breasts");
  Imager imager(scene, image);
  std::atomic<int> done{0};
#pragma omp parallel for schedule(dynamic) num_threads(threads())
  for (int k = 0; k < grid.size[2]; ++k) {
    imager.slice(k);
    const int finished = ++done;
#pragma omp critical(phantom_progress)
    progress.update("image", double(finished) / grid.size[2], "slices");
  }
  image.signal.grid = scanner;
  if (parts) image.parts.water.grid = image.parts.fat.grid = scanner;
  return image;
}

namespace {

// The tip of the papilla in the image: it protrudes from the mesh and rotates with the tissue
// behind it.
Vec3 nipple_tip(const PhantomBreast& breast) {
  const HexMesh& mesh = breast.mesh;
  const Vec3 behind = breast.shape.apex() - 6 * breast.shape.axis();
  const Location at = Locator(mesh, mesh.reference).nearest(behind);
  const Vec3 base = mesh.points[mesh.nipple_node];
  const Vec3 out = base - element_position(mesh, mesh.points, at.element, at.local);
  return base + breast.shape.parameters().nipple_height * out.normalized();
}

}  // namespace

LabelVolume true_labels(const PhantomScene& scene, const PhantomImage& image, Side side) {
  const Grid& full = image.signal.grid;
  const std::uint8_t own = side == Side::left ? 1 : 2;
  std::array<int, 3> low = full.size, high{-1, -1, -1};
  for (int k = 0; k < full.size[2]; ++k)
    for (int j = 0; j < full.size[1]; ++j)
      for (int i = 0; i < full.size[0]; ++i)
        if (image.side[full.offset(i, j, k)] == own) {
          const int at[3] = {i, j, k};
          for (int a = 0; a < 3; ++a)
            low[a] = std::min(low[a], at[a]), high[a] = std::max(high[a], at[a]);
        }
  if (high[0] < 0)
    throw input_error("phantom labels: no voxel of the ", side_name(side), " breast");
  const Vec3 before(25, 15, 10), after(25, 40, 10);  // mm kept around the breast, more behind it
  LabelVolume labels;
  labels.side = side;
  labels.grid = full;
  for (int a = 0; a < 3; ++a) {
    low[a] = std::max(0, low[a] - int(before[a] / full.spacing[a]));
    high[a] = std::min(full.size[a] - 1, high[a] + int(after[a] / full.spacing[a]));
    labels.grid.size[a] = high[a] - low[a] + 1;
  }
  labels.grid.origin = full.to_patient(Vec3(low[0], low[1], low[2]));
  labels.tissue.resize(labels.grid.voxels());
  labels.fibroglandular_fraction.assign(labels.grid.voxels(), 0.0f);
  labels.chest_wall_confidence.assign(labels.grid.voxels(), 1.0f);
  for (int k = 0; k < labels.grid.size[2]; ++k)
    for (int j = 0; j < labels.grid.size[1]; ++j)
      for (int i = 0; i < labels.grid.size[0]; ++i) {
        const std::size_t from = full.offset(i + low[0], j + low[1], k + low[2]);
        const std::size_t to = labels.grid.offset(i, j, k);
        const auto tissue = Tissue(image.tissue[from]);
        const bool rigid =
            tissue == Tissue::air || tissue == Tissue::muscle || tissue == Tissue::other;
        labels.tissue[to] = std::uint8_t(rigid || image.side[from] == own ? tissue : Tissue::other);
        if (image.side[from] == own)
          labels.fibroglandular_fraction[to] = 0.01f * float(image.gland_percent[from]);
      }
  const HexMesh& mesh = scene.breast(side).mesh;
  labels.landmarks["tumour"] = landmark_position(mesh, mesh.points, *mesh.landmark("tumour"));
  labels.landmarks["nipple"] = nipple_tip(scene.breast(side));
  labels.skin_thickness = scene.parameters.skin;
  return labels;
}

}  // namespace breast
