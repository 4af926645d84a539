// SPDX-License-Identifier: GPL-3.0-or-later
// Intermediate results that the stages of segmentation share.
#pragma once

#include "image/label_volume.hpp"
#include "segment/segment.hpp"
#include "segment/tissue/bias.hpp"
#include "segment/tissue/nipple.hpp"
#include "segment/tissue/tissue.hpp"
#include "segment/wall/extent.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// What was scanned of one examination, on one grid in patient order.
struct Images {
  Volume<float> tissue;     ///< shows fat, gland and muscle
  Volume<float> outline;    ///< shows the skin; empty where it is `tissue`
  Volume<float> fat_share;  ///< of a Dixon scan: fat over water and fat; otherwise empty
  Mask seen;                ///< as voxels_with_data(); elsewhere the others are continued
  double noise = 0;         ///< as disturbing_noise() of `tissue`
  bool speckled = false;    ///< as is_speckle() of the noise of `tissue`
};
/// Sets `noise` and `speckled` from `tissue`.
void measure_noise(Images& images);
/// The images of a scan in patient order: water and fat of a Dixon scan become their sum.
Images images_of(Volume<float> scan, const SegmentOptions& options);
/// What shows tissue, without disturbing noise, on the working grid.
Volume<float> working_scan(const Images& images);
/// Which voxels of a grid have data, by their centres; empty: all.
Mask seen_on(const Images& images, const Grid& grid);
/// Samples the images of a turned body again, along its own axes. `scanned` is its working_scan(),
/// `body` the body on it. Returns the angle (radians).
double stand_upright(Images& images, const Volume<float>& scanned, const Mask& body,
                     const SegmentOptions& options);

/// All volumes have the same grid.
struct Work {
  Volume<float> scan, skin_distance;
  Volume<float> brightness;  ///< scan over bias: 1 in fat
  /// Brightness within the body, 0 outside; on the working grid alone, empty on the side's own.
  Volume<float> ratio;
  Volume<float> fat_share;  ///< as in Images
  Mask seen;                ///< as in Images
  /// Distance (mm) from the skin that `scan` shows; empty where that is the skin of the body.
  Volume<float> own_distance;
  Body body;
  TorsoFront torso;
  WallDomain domain;
  ChestWall wall;
  BiasField bias;
  BreastExtent extent;
  Mask breast;
  Mask enclosed_dark;  ///< as in DarkParts, in front of the wall
  Fibroglandular gland;
  double skin = 0;
};

/// The scan in voxels of about 1.6 mm in plane and 2.6 mm along the body, where its own are finer:
/// body, wall and bias are smooth on that scale, and need no more whatever the scan has.
Volume<float> on_working_grid(const Volume<float>& scan);

/// Number of a scan's voxels that show the chosen side, which on_scan_grid() cuts out.
std::size_t side_voxels(const Work& coarse, const Grid& scanned, Side side);
/// The chosen side of the original scan with everything found so far, for the final labels: if the
/// working grid was coarser, the border of the body is determined again on the finer voxels. Speckle is taken out.
/// The images are released as soon as the side is cut out of them.
Work on_scan_grid(const Work& coarse, Images images, Side side);

/// Brightness from the scan, and a bias on any grid.
void divide_by_bias(Work& work, const BiasField& bias);
/// The brightness in the body, and 0 outside.
Volume<float> within(const Mask& body, Volume<float> brightness);

/// Interior of the breast: deeper than `skin_depth` mm, more than `wall_margin` mm in front of the
/// wall.
Mask interior_of(const Work& work, double skin_depth, double wall_margin);
/// Tissue within `reach` mm in front of the wall, in columns with a confidence below one half.
Mask near_unsure_wall(const Work& work, double reach);
LabelVolume labels_of(const Work& work, Side side);
/// Data for surface fitting: skin at voxel faces against air, wall on the breast's columns.
TriMesh data_points(const Work& work);
/// The same for a supine side, for comparison with a prediction: all its skin in front of the
/// deepest wall sought, with outward normals, and the wall in every column where the image shows
/// it.
TriMesh side_points(const Work& work);

}  // namespace breast
