#include "phantom/parameters.hpp"

#include "core/error.hpp"
#include "phantom/random.hpp"

namespace breast {

const std::vector<std::string>& preset_names() {
  static const std::vector<std::string> names{"paper", "flat", "small", "large", "pendulous"};
  return names;
}

BreastParameters kind_breast(const std::string& name) {
  BreastParameters b;
  if (name == "small") {
    b.radius = 45, b.height = 60, b.shoulder = 14, b.fold = 14;
    b.nipple_radius = 4, b.nipple_height = 5;
  } else if (name == "large") {
    b.centre_x = 90, b.radius = 60, b.height = 100, b.shoulder = 34, b.fold = 20;
  } else if (name == "pendulous") {
    b.centre_x = 82, b.radius = 50, b.height = 108, b.shoulder = 48, b.axis_inferior = 10;
  } else if (name == "flat") {
    b.radius = 46, b.height = 47, b.shoulder = 12, b.fold = 12;
    b.nipple_radius = 4, b.nipple_height = 4;
  } else if (name == "paper") {
    // The paper's tumour moves a third as far as the nipple. Only a place low and medial does so
    // and still lies far enough in front of the chest wall to be seen in both mammograms.
    b.tumour_azimuth = 240;
  } else {
    throw input_error("preset '", name, "' is unknown: choose paper, flat, small, large or pendulous");
  }
  return b;
}

BreastParameters preset_breast(const std::string& name) {
  BreastParameters b = kind_breast(name);
  if (name != "paper") return b;
  // `make -f Makefile.pipeline calibrate`, that is
  //   calibrate --preset paper --gain 1.28,1.39 --evaluations 24
  // so that the chain as printed (PAPER=1) moves nipple and tumour about as far as the paper's. The
  // level is the lower bound of the search: a tumour closer to the chest wall, out of the mammograms,
  // would fit better.
  b = resized(b, 0.8938);
  b.tumour_aside = 0.6679, b.tumour_level = 0.5;
  return b;
}

BreastParameters resized(BreastParameters b, double size) {
  b.radius *= size, b.height *= size, b.shoulder *= size;
  return b;
}

namespace {

// Left and right differ by a few per cent.
void individualise(BreastParameters& b, RandomStream& stream) {
  b.radius *= 1 + stream.uniform(-0.025, 0.025);
  b.height *= 1 + stream.uniform(-0.03, 0.03);
  b.centre_z += stream.uniform(-3, 3);
  b.axis_lateral += stream.uniform(-2, 2);
  b.axis_inferior += stream.uniform(-2, 2);
}

}  // namespace

PhantomParameters phantom_preset(const std::string& name, std::uint64_t seed) {
  return phantom_preset(name, seed, preset_breast(name));
}

PhantomParameters phantom_preset(const std::string& name, std::uint64_t seed,
                                 const BreastParameters& breast) {
  PhantomParameters p;
  p.preset = name;
  p.seed = seed;
  p.left = p.right = breast;
  if (name == "small") p.gland.fraction = 0.26;
  if (name == "large") p.gland.fraction = 0.09, p.torso.half_width = 178, p.torso.half_depth = 108;
  if (name == "pendulous") p.gland.fraction = 0.10;
  RandomStream stream(mix(seed, 11));
  individualise(p.left, stream);
  individualise(p.right, stream);
  return p;
}

namespace {
void write_breast(const std::string& at, const BreastParameters& b, Report& report) {
  report.set(at + "centre_x_mm", b.centre_x);
  report.set(at + "centre_z_mm", b.centre_z);
  report.set(at + "axis_lateral_deg", b.axis_lateral);
  report.set(at + "axis_inferior_deg", b.axis_inferior);
  report.set(at + "radius_mm", b.radius);
  report.set(at + "height_mm", b.height);
  report.set(at + "shoulder_mm", b.shoulder);
  report.set(at + "power", b.power);
  report.set(at + "upper_fullness", b.upper_fullness);
  report.set(at + "lateral_fullness", b.lateral_fullness);
  report.set(at + "axillary_tail", b.axillary_tail);
  report.set(at + "fold_mm", b.fold);
  report.set(at + "unevenness_mm", b.unevenness);
  report.set(at + "nipple_radius_mm", b.nipple_radius);
  report.set(at + "nipple_height_mm", b.nipple_height);
  report.set(at + "tumour_level", b.tumour_level);
  report.set(at + "tumour_aside", b.tumour_aside);
  report.set(at + "tumour_azimuth_deg", b.tumour_azimuth);
}
}  // namespace

void write_parameters(const PhantomParameters& p, Report& report) {
  report.set("parameters/preset", p.preset);
  report.set("parameters/seed", static_cast<long long>(p.seed));
  report.set("parameters/skin_mm", p.skin);
  report.set("parameters/materials", p.materials);
  write_breast("parameters/left/", p.left, report);
  write_breast("parameters/right/", p.right, report);
  report.set("parameters/gland/fraction", p.gland.fraction);
  report.set("parameters/gland/lobes", p.gland.lobes);
  report.set("parameters/gland/extent", p.gland.extent);
  report.set("parameters/mri/voxel_factor", p.mri.voxel_factor);
  report.set("parameters/mri/bias", p.mri.bias);
  report.set("parameters/mri/noise_percent", p.mri.noise_percent);
  report.set("parameters/mri/samples", p.mri.samples);
  report.set("parameters/torso/half_width_mm", p.torso.half_width);
  report.set("parameters/torso/half_depth_mm", p.torso.half_depth);
  report.set("parameters/torso/power", p.torso.power);
  report.set("parameters/torso/tilt", p.torso.tilt);
  report.set("parameters/torso/bend_per_mm", p.torso.bend);
  report.set("parameters/torso/sternal_groove_mm", p.torso.sternal_groove);
  report.set("parameters/torso/fat_medial_mm", p.torso.fat_medial);
  report.set("parameters/torso/fat_lateral_mm", p.torso.fat_lateral);
  report.set("parameters/mesh/core", p.mesh.core);
  report.set("parameters/mesh/shell", p.mesh.shell);
  report.set("parameters/mesh/skirt", p.mesh.skirt);
  report.set("parameters/mesh/slab", p.mesh.slab);
  report.set("parameters/mesh/rise", p.mesh.rise);
  report.set("parameters/mesh/order", p.mesh.order);
}

}  // namespace breast
