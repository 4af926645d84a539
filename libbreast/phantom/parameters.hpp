// SPDX-License-Identifier: GPL-3.0-or-later
// All parameters of the phantom.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/report.hpp"
#include "core/types.hpp"
#include "material/material_set.hpp"

namespace breast {

/// The rigid thorax (mm). Sections z = const of the pectoral surface are superellipses
/// |x/half_width|^power + |(y−centre(z))/half_depth|^power = 1, centre = half_depth + tilt z + bend
/// z².
struct TorsoParameters {
  double half_width = 165, half_depth = 102, power = 2.5;
  double tilt = 0.10, bend = 4e-4;  ///< the upper chest lies further back (mm per mm, per mm)
  double sternal_groove = 3.0;      ///< depth of the wall's groove over the sternum
  double fat_medial = 15, fat_lateral = 21;  ///< subcutaneous fat at the sternum and at the side
};

/// One breast, stress-free (mm). Local axes: h along the breast's axis from the chest wall.
struct BreastParameters {
  double centre_x = 80;  ///< lateral distance of the axis' foot from the midline
  double centre_z = -2;
  double axis_lateral = 10;  ///< lateral inclination of the axis, degrees
  double axis_inferior = 5;  ///< downward inclination of the axis, degrees
  double radius = 54;        ///< mean radius at the base
  double height = 82;        ///< chest wall to nipple base along the axis
  double shoulder = 18;      ///< height up to which the breast is a cylinder, a dome above
  double power = 1.92;       ///< fullness of the dome (2 = ellipsoid)
  double upper_fullness = 0.06, lateral_fullness = 0.04,
         axillary_tail = 0.08;  ///< relative to radius
  double fold = 22;             ///< fillet between breast and chest, larger above than below
  double rim = 2;               ///< mm from the end of the fold to the cut, at the midline
  double flank = 0;             ///< mm by which the cut lies farther from the fold at the side
  double unevenness = 1.0;      ///< amplitude of the skin's slow undulation
  double nipple_radius = 5.5, nipple_height = 5;
  double tumour_level = 0.55;  ///< position of the tumour along the axis, relative to the height
  double tumour_aside = 0.45;  ///< distance of the tumour from the axis, relative to the radius
  double tumour_azimuth = 45;  ///< degrees from lateral towards superior: upper outer quadrant
};

struct GlandParameters {
  double fraction = 0.14;  ///< volume of the gland as a fraction of the breast's
  int lobes = 18;
  double extent = 0.72;  ///< radius of the gland's region relative to the breast's
};

struct MriParameters {
  double voxel_factor = 1;     ///< coarser grid for tests: spacing multiplied, size divided
  double bias = 2.0;           ///< coil sensitivity, brightest over darkest breast voxel
  double noise_percent = 2.0;  ///< of the median fat signal
  Vec3 samples{3, 3, 5};       ///< subsamples per voxel for partial volume
};

/// (core² + 4 core (shell + skirt)) slab + (core² + 4 core shell) rise + core² shell elements.
struct MeshParameters {
  int core = 8;   ///< across the inner square, even
  int shell = 4;  ///< layers between the inner block and the skin
  int skirt = 2;  ///< rings of the fat layer around the breast
  int slab = 2;   ///< layers of the slab on the chest wall
  int rise = 5;   ///< layers of the inner block above the slab
  int order = 2;
};

/// Boundary conditions and stiffness of the breasts. Breasts on a fixed wall are defined by their
/// stress-free shape. A breast that slides is defined by its prone shape, because it would
/// otherwise detach from the chest beside it, which is rigid in the phantom; its stress-free shape
/// is computed.
struct BodyParameters {
  std::string materials = "seed2008";
  std::vector<std::string> scale = {};  ///< TISSUE=PERCENT of the set
  bool slides = false;
  double wall_percent = 100,
         cut_percent =
             100;  ///< stiffness of wall and cut in percent of the set's, for sliding breasts
  /// mm by which a body that slides goes on at its side past the cut in the prone image. A breast on
  /// its back hangs over a near cut, whose elements fold at the wall.
  double beyond = 0;
};

struct PhantomParameters {
  std::string preset = "paper";
  std::uint64_t seed = 1;
  TorsoParameters torso;
  BreastParameters left, right;
  GlandParameters gland;
  MriParameters mri;
  MeshParameters mesh;
  double skin = 1.5;  ///< mm
  BodyParameters body;
  const BreastParameters& side(Side s) const { return s == Side::left ? left : right; }
};

/// "average", "slim", "broad" and "heavy" slide on rib cages that fall away at the sides; "paper",
/// "flat", "small", "large" and "pendulous" are fixed at theirs.
const std::vector<std::string>& preset_names();
/// Whether the breasts of a preset slide on their wall.
bool preset_slides(const std::string& name);
/// The phantom of a preset; the seed also varies left against right by a few per cent, as in every
/// woman. Throws Error (input) on another name or an unusable value.
PhantomParameters phantom_preset(const std::string& name, std::uint64_t seed);
/// The same with the given breast instead of the preset's, before left and right are varied.
PhantomParameters phantom_preset(const std::string& name, std::uint64_t seed,
                                 const BreastParameters& breast);
/// The breast of a preset before left and right are varied. "paper" is kind_breast("paper") as
/// calibrated (tools/calibrate.cpp; the command stands beside the values in parameters.cpp).
BreastParameters preset_breast(const std::string& name);
/// The same before any calibration, from which the calibration starts.
BreastParameters kind_breast(const std::string& name);
/// `breast` scaled by `size`: radius, height and shoulder.
BreastParameters resized(BreastParameters breast, double size);
/// The material set of a body with its scaling; with supports of wall and cut if it slides. Throws
/// Error (input) for an unknown set, and for a set without supports if the body slides.
MaterialSet body_materials(const BodyParameters& body);
/// Mesh parameters with fewer elements, for tests.
MeshParameters coarse_mesh(const PhantomParameters& parameters);
/// Writes every parameter under "parameters/".
void write_parameters(const PhantomParameters& parameters, Report& report);

}  // namespace breast
