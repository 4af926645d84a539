// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection/projection.hpp"

#include <algorithm>
#include <atomic>
#include <memory>

#include "core/error.hpp"
#include "projection/ray_mesh.hpp"
#include "projection/voxel_tissue.hpp"

namespace breast {

namespace {

void add_element_tissue(Tissue tissue, double length, TissuePath& mm) {
  switch (tissue) {
    case Tissue::fibroglandular:
      mm.fibroglandular += length;
      break;
    case Tissue::muscle:
      mm.muscle += length;
      break;
    case Tissue::skin:
      mm.skin += length;
      break;
    case Tissue::tumour:
      mm.tumour += length;
      break;
    default:
      mm.fat += length;
  }
}

// Summed over one row of pixels.
struct RowSums {
  TissuePath mm;             // without columns that leave through the back
  double unlabelled = 0;     // mm of that
  int back = 0, muscle = 0;  // pixels
};

class Projector {
 public:
  Projector(const HexMesh& mesh, const ProjectionOptions& options, const ViewPose& pose)
      : mesh_(mesh),
        options_(options),
        rays_(mesh, mesh.points, pose),
        filled_(mesh.contact->ends_image ? mesh.contact->thickness_mm : 0) {
    if (options.labels != nullptr) {
      imaged_ = rays_.pieces_of(mesh, mesh.imaged);
      Vec3 lower = mesh.imaged.front(), upper = lower;
      for (const Vec3& x : mesh.imaged) {
        lower = lower.cwiseMin(x);
        upper = upper.cwiseMax(x);
      }
      voxels_ = std::make_unique<VoxelTissue>(*options.labels, lower, upper);
    }
  }
  double volume() const { return rays_.volume(); }

  RowSums row(int v, Mammogram& image) const {
    RowSums sums;
    ChordPacket chords;
    std::vector<TissuePath> behind(std::size_t(image.width));
    for (int u = 0; u < image.width;) {
      const int rays = rays_.trace(image.pixel * Vec2(u, v), image.pixel,
                                   std::min(packet_rays, image.width - u), chords);
      for (int k = 0; k < rays; ++k, ++u)
        pixel(u, v, chords[k], image, behind[std::size_t(u)], sums);
    }
    if (filled_ > 0) continue_backwards(v, behind, image, sums);
    return sums;
  }

 private:
  // Columns that leave through the back lack the tissue behind the mesh, and those behind them may miss the mesh. They are continued to
  // the thickness of the tissue in front of them in the same row, so that skin and brightness continue, too; at most to the distance
  // of the plates. They are continued with fat, and behind a column that is mostly muscle with muscle: the mesh has but a layer of it.
  void continue_backwards(int v, std::vector<TissuePath>& behind, Mammogram& image,
                          RowSums& sums) const {
    double front = 0;
    bool back = false, muscle = false;
    for (int u = image.width - 1; u >= 0; --u) {
      const std::size_t at = std::size_t(v) * image.width + u;
      TissuePath& mm = behind[std::size_t(u)];
      if (back && front > 0 && !(image.thickness[at] > 0) && image.through_back[at] == 0) {
        image.through_back[at] = 1;
        ++sums.back;
      }
      if (image.through_back[at] == 0) {
        front = image.thickness[at];
        continue;
      }
      back = true;
      muscle = muscle || mm.muscle > 0.5 * std::min(filled_, front);
      (muscle ? mm.muscle : mm.fat) += std::max(0.0, std::min(filled_, front) - mm.total());
      record(at, mm, image);
    }
  }

  void record(std::size_t at, const TissuePath& mm, Mammogram& image) const {
    image.path[at] = float(std::max(0.0, options_.energy.path(mm)));
    image.thickness[at] = float(mm.total());
    image.fibroglandular[at] = float(mm.fibroglandular);
  }

  // Records the tissue of a pixel, or, if its column leaves through the back, stores it in `behind`.
  void pixel(int u, int v, const std::vector<Chord>& chords, Mammogram& image, TissuePath& behind,
             RowSums& sums) const {
    if (chords.empty()) return;
    const std::size_t at = std::size_t(v) * image.width + u;
    const bool back = rays_.leaves_through_back(chords);
    if (back) {
      image.through_back[at] = 1;
      ++sums.back;
      if (!(filled_ > 0)) return;
    }
    TissuePath mm;
    double unlabelled = 0;
    if (voxels_) {
      const Ray ray = rays_.ray(image.pixel * Vec2(u, v));
      VoxelTissue::Parts parts = VoxelTissue::Parts::Zero();
      double length = 0, muscle = 0;
      for (const Chord& chord : chords) {
        if (mesh_.tissue[rays_.element(chord.piece)] == Tissue::muscle) {
          muscle += chord.leave - chord.enter;
          continue;
        }
        parts += sample_chord(ray, chord);
        length += chord.leave - chord.enter;
      }
      mm = VoxelTissue::path(parts, length);
      mm.muscle = muscle;
      unlabelled = VoxelTissue::unlabelled(parts);
    } else {
      for (const Chord& chord : chords) {
        add_element_tissue(mesh_.tissue[rays_.element(chord.piece)], chord.leave - chord.enter, mm);
      }
    }
    if (mm.muscle > 0) ++sums.muscle;
    if (back) {
      behind = mm;
      return;
    }
    record(at, mm, image);
    sums.unlabelled += unlabelled;
    sums.mm.fat += mm.fat;
    sums.mm.fibroglandular += mm.fibroglandular;
    sums.mm.skin += mm.skin;
    sums.mm.tumour += mm.tumour;
    sums.mm.muscle += mm.muscle;
  }

  // Midpoint rule with steps of at most half a voxel along every axis of the scan. The image of the
  // chord in the scan is a short smooth curve, approximated by a parabola through its two ends and
  // its middle, the only point for which the element map is inverted.
  VoxelTissue::Parts sample_chord(const Ray& ray, const Chord& chord) const {
    const Trilinear& imaged = imaged_[chord.piece];
    Vec3 local = 0.5 * (chord.local_enter + chord.local_leave);
    rays_.piece(chord.piece).invert(ray.at(0.5 * (chord.enter + chord.leave)), 1e-4, local);
    const Vec3 start = voxels_->index(imaged.at(chord.local_enter)),
               middle = voxels_->index(imaged.at(local)),
               end = voxels_->index(imaged.at(chord.local_leave));
    const Vec3 slope = 4 * middle - 3 * start - end, bend = 2 * (start + end) - 4 * middle;
    const double fastest = slope.cwiseAbs().cwiseMax((slope + 2 * bend).cwiseAbs()).maxCoeff();
    const int steps = 1 + int(fastest / 0.5);
    VoxelTissue::Parts sum = VoxelTissue::Parts::Zero();
    for (int k = 0; k < steps; ++k) {
      const double f = (k + 0.5) / steps;
      sum += voxels_->at(start + f * (slope + f * bend));
    }
    return sum * float((chord.leave - chord.enter) / steps);
  }

  const HexMesh& mesh_;
  const ProjectionOptions& options_;
  RayMesh rays_;
  /// If the image ends at the plates' edge: the distance of the plates, mm, the largest thickness to which a
  /// column is continued beyond the mesh.
  double filled_;
  std::vector<Trilinear> imaged_;
  std::unique_ptr<VoxelTissue> voxels_;
};

Mammogram empty_image(const HexTopology& mesh, const ImageFrame& frame,
                      const ProjectionOptions& options) {
  if (!(options.pixel > 0)) throw input_error("pixel ", options.pixel, " mm: must be positive");
  const double pixels = (frame.width / options.pixel) * (frame.height / options.pixel);
  if (!(pixels <= 1e8)) {
    throw input_error("pixel ", options.pixel, " mm: ", pixels,
                      " pixels, but at most 1e8 are allowed; use larger pixels");
  }
  Mammogram image;
  image.pose = frame.pose;
  image.view = frame.view;
  image.side = mesh.side;
  image.pixel = options.pixel;
  image.plate_edge_u = frame.plate_edge_u;
  image.energy = options.energy.name();
  image.width = 1 + int(frame.width / options.pixel);
  image.height = 1 + int(frame.height / options.pixel);
  const std::size_t n = std::size_t(image.width) * image.height;
  image.path.assign(n, 0);
  image.thickness.assign(n, 0);
  image.fibroglandular.assign(n, 0);
  image.through_back.assign(n, 0);
  return image;
}

}  // namespace

Mammogram project_mammogram(const HexMesh& mesh, const ProjectionOptions& options,
                            ProjectionReport* report, Progress& progress) {
  const ImageFrame frame = image_frame(mesh, options.beam);
  Mammogram image = empty_image(mesh, frame, options);
  const Projector projector(mesh, options, frame.pose);
  std::vector<RowSums> rows(std::size_t(image.height));
  std::atomic<int> done{0};
#pragma omp parallel for schedule(dynamic, 4)
  for (int v = 0; v < image.height; ++v) {
    rows[v] = projector.row(v, image);
    const int count = ++done;
    if (count % 16 == 0) {
#pragma omp critical(project_progress)
      progress.update("projecting", double(count) / image.height, {});
    }
  }
  if (report == nullptr) return image;
  *report = {};
  double path_mm = 0;
  const double area = image.pixel * image.pixel;
  for (const RowSums& row : rows) {  // in order: the same for any number of threads
    report->volumes.fat += area * row.mm.fat;
    report->volumes.fibroglandular += area * row.mm.fibroglandular;
    report->volumes.skin += area * row.mm.skin;
    report->volumes.tumour += area * row.mm.tumour;
    report->volumes.muscle += area * row.mm.muscle;
    report->muscle_columns += row.muscle;
    report->unlabelled += row.unlabelled;
    report->back_columns += row.back;
    path_mm += row.mm.total();
  }
  report->imaged_volume = area * path_mm;
  report->unlabelled = path_mm > 0 ? report->unlabelled / path_mm : 0;
  report->mesh_volume = projector.volume();
  return image;
}

}  // namespace breast
