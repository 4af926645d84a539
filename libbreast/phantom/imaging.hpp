// SPDX-License-Identifier: GPL-3.0-or-later
// Sampling of the scene for the simulated scanner: matter per subsample of every voxel, and the
// labels.
#pragma once

#include "image/label_volume.hpp"
#include "phantom/mr_contrast.hpp"
#include "phantom/scene.hpp"

namespace breast {

/// Noise-free signal (fat = 1000, no coil bias) and the truth on the same grid.
struct PhantomImage {
  Volume<float> signal;
  SignalImages parts;  ///< its water and fat (mr_contrast.hpp); empty in the contrast of T1
  std::vector<std::uint8_t> tissue;         ///< majority Tissue per voxel, both breasts
  std::vector<std::uint8_t> side;           ///< 0 rigid body or air, 1 left breast, 2 right breast
  std::vector<std::uint8_t> gland_percent;  ///< fibroglandular percentage of the voxel
};

/// 512×512×60 voxels of 0.82×0.82×2.5 mm around the chest; coarser by `voxel_factor`.
Grid phantom_grid(const MriParameters& parameters);
/// Images the shape in mesh.points with the whole body `moved` in the scanner. Voxels are
/// independent of each other, so that the result does not depend on the number of threads. With
/// `parts` the images of water and fat are made too, and `signal` is their sum.
PhantomImage image_scene(const PhantomScene& scene, Progress& progress = no_progress(),
                         const RigidMotion& moved = {}, bool parts = false);
/// The label volume `segment` should find for one side, cropped to the breast and its surroundings.
/// The breast is the tissue inside the mesh, up to its cut; fat beyond is `other`. Landmarks: the
/// tip of the nipple and the tumour. Meshes of a body that was moved must have been moved with it.
LabelVolume true_labels(const PhantomScene& scene, const PhantomImage& image, Side side);

}  // namespace breast
