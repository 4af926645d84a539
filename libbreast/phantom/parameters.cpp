// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/parameters.hpp"

#include "core/error.hpp"
#include "mechanics/supports/support.hpp"
#include "phantom/random.hpp"

namespace breast {

const std::vector<std::string>& preset_names() {
  static const std::vector<std::string> names{"average", "slim",  "broad", "heavy",    "paper",
                                              "flat",    "small", "large", "pendulous"};
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
  } else if (preset_slides(name)) {
    // Shapes as they hang in the scan.
    b.axis_lateral = 4, b.axis_inferior = 2, b.power = 2.1, b.fold = 15, b.flank = 4;
    if (name == "average") {
      b.centre_x = 77, b.radius = 47, b.height = 90, b.shoulder = 40;
    } else if (name == "slim") {
      b.centre_x = 68, b.radius = 38, b.height = 66, b.shoulder = 26, b.fold = 12;
      b.nipple_radius = 4;
    } else if (name == "broad") {
      b.centre_x = 83, b.radius = 57, b.height = 108, b.shoulder = 52;
    } else {
      b.centre_x = 90, b.radius = 65, b.height = 126, b.shoulder = 64, b.fold = 16;
    }
  } else if (name == "paper") {
    // The paper's tumour moves a third as far as the nipple. Only a low and medial position does so
    // and lies far enough in front of the chest wall to be visible in both mammograms.
    b.tumour_azimuth = 240;
  } else {
    std::string choices;
    for (const std::string& preset : preset_names())
      choices += (choices.empty() ? "" : ", ") + preset;
    throw input_error("preset '", name, "' is unknown: choose one of ", choices);
  }
  return b;
}

bool preset_slides(const std::string& name) {
  return name == "average" || name == "slim" || name == "broad" || name == "heavy";
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

// Rib cages of different shape, 26 to 37 cm broad and 20 to 28 cm deep, and bodies that differ from
// a calibrated set by as much as women do. The chain knows neither; the presets show the
// resulting errors.
void put_on_ribs(PhantomParameters& p) {
  p.torso.sternal_groove = 2;
  p.torso.tilt = 0.22, p.torso.bend = 3e-4;
  p.body.materials = "phantom2026";
  p.body.slides = true;
  p.body.beyond = 16;
  p.mesh.skirt = 4;
  if (p.preset == "average") {
    p.torso.half_width = 142, p.torso.half_depth = 110, p.torso.power = 2.0;
    p.gland.fraction = 0.15;
    p.body.scale = {"fat=95", "fibroglandular=110"};
    p.body.wall_percent = 120, p.body.cut_percent = 85;
  } else if (p.preset == "slim") {
    p.torso.half_width = 130, p.torso.half_depth = 100, p.torso.power = 2.0;
    p.gland.fraction = 0.28;
    p.body.scale = {"fat=105", "fibroglandular=100"};
    p.body.wall_percent = 80, p.body.cut_percent = 115;
  } else if (p.preset == "broad") {
    p.torso.half_width = 154, p.torso.half_depth = 122, p.torso.power = 2.0,
    p.torso.fat_lateral = 26, p.torso.tilt = 0.18;
    p.gland.fraction = 0.09;
    p.body.scale = {"fat=105", "fibroglandular=120"};
    p.body.wall_percent = 85, p.body.cut_percent = 100;
  } else {
    p.torso.half_width = 186, p.torso.half_depth = 138, p.torso.power = 2.0,
    p.torso.fat_lateral = 26, p.torso.tilt = 0.26;
    p.gland.fraction = 0.06;
    p.body.scale = {"fat=95", "fibroglandular=90"};
    p.body.wall_percent = 110, p.body.cut_percent = 110;
  }
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
  if (preset_slides(name)) put_on_ribs(p);
  RandomStream stream(mix(seed, 11));
  individualise(p.left, stream);
  individualise(p.right, stream);
  return p;
}

MaterialSet body_materials(const BodyParameters& body) {
  MaterialSet set = load_materials(body.materials);
  scale_materials(set, body.scale);
  if (!body.slides) return set;
  if (set.wall.empty() || set.cut.empty()) {
    throw input_error("materials '", body.materials,
                      "': they hold no support of wall and cut, which a "
                      "breast that slides needs (as invivo has), or choose a preset that is held");
  }
  set.wall = wall_support(set.wall)->stiffened(body.wall_percent / 100)->text();
  set.cut = cut_support(set.cut)->stiffened(body.cut_percent / 100)->text();
  return set;
}

MeshParameters coarse_mesh(const PhantomParameters& p) {
  return p.body.slides ? MeshParameters{4, 2, 2, 1, 3, 2} : MeshParameters{4, 2, 1, 1, 3, 2};
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
  report.set(at + "rim_mm", b.rim);
  report.set(at + "flank_mm", b.flank);
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
  report.set("parameters/materials", p.body.materials);
  std::string scales;
  for (const std::string& scale : p.body.scale) scales += (scales.empty() ? "" : " ") + scale;
  report.set("parameters/scale_percent", scales);
  report.set("parameters/slides", p.body.slides);
  if (p.body.slides) {
    report.set("parameters/wall_percent", p.body.wall_percent);
    report.set("parameters/cut_percent", p.body.cut_percent);
    report.set("parameters/beyond_mm", p.body.beyond);
  }
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
