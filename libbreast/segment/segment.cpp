// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/segment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "core/table.hpp"
#include "segment/bias_and_wall.hpp"
#include "segment/body/field_of_view.hpp"
#include "segment/body/side.hpp"
#include "segment/contrast/dixon.hpp"
#include "segment/contrast/evidence.hpp"
#include "segment/contrast/refusals.hpp"
#include "segment/contrast/second_scan.hpp"
#include "segment/contrast/suppressed.hpp"
#include "segment/doubts.hpp"
#include "segment/expected.hpp"
#include "segment/grid/filters.hpp"
#include "segment/grid/itk_filters.hpp"
#include "segment/grid/noise.hpp"
#include "segment/pace.hpp"
#include "segment/plausibility.hpp"
#include "segment/quality.hpp"
#include "segment/tissue/compact_gland.hpp"
#include "segment/tissue/lost_edges.hpp"
#include "segment/tissue/skin_thickness.hpp"
#include "segment/wall/front_muscle.hpp"
#include "segment/wall/wall_input.hpp"
#include "segment/wall/wall_uncertainty.hpp"
#include "segment/work.hpp"

namespace breast {

namespace {

// Skin of a supine breast lies in front of and beside the sternum's.
constexpr double spread_behind = 40;  // mm
// Gland brighter than this share of fat has in part been taken for dim fat, and much of it lowers
// the bias around it, which is then estimated again without it. A little (strands, vessels) does
// not.
constexpr double darkest_gland_in_bias = 0.5, least_gland_in_bias = 0.1;

/// The working grid of the images, and the body on it.
void start_work(Work& work, const Images& images, const SegmentOptions& options) {
  work.scan = working_scan(images);
  work.seen = seen_on(images, work.scan.grid);
  end_at_front(work.scan, work.seen);
  work.body = find_body(work.scan, options.side, options.posture);
}

/// What the stages need to know of the body.
void frame_body(Work& work, const SegmentOptions& options) {
  work.torso = find_torso(work.body.mask, options.side);
  work.skin_distance = signed_distance(work.body.mask);
  work.domain = wall_domain(work.body.mask, work.torso, options.side == Side::left, work.seen);
  refuse_other_side(work.torso, work.scan.grid, options.side);
}

bool corrected_by_hand(const SegmentOptions& options) {
  return options.wall_labels || !options.wall_points.empty();
}

/// The wall's uncertainty, and what the user says of it.
void correct_wall(Work& work, const SegmentOptions& options) {
  work.wall.sigma = wall_sigma(work.ratio, work.domain, work.wall);
  const HeightField found = work.wall.depth;
  if (options.wall_labels)
    apply_wall_labels(work.wall, work.domain, work.scan.grid, *options.wall_labels);
  if (!options.wall_points.empty()) {
    const auto apply = options.wall_points_of_surface ? apply_wall_surface : apply_wall_points;
    apply(work.wall, work.domain, work.scan.grid, options.wall_points);
  }
  hand_set_sigma(work.wall, found);
  if (options.wall_shift != 0) shift_wall(work.wall, work.domain, options.wall_shift);
}

void summarise(Segmentation& result, const Work& work) {
  result.midline_mm =
      work.scan.grid.to_patient(Vec3(work.torso.midline, 0, 0.5 * work.scan.grid.size[2]))[0];
  result.muscle_ratio = result.contrast.muscle_ratio;
  result.gland_ratio = work.gland.gland_ratio;
  result.fat_fraction = work.gland.fat_fraction;
  result.fat_fraction_grown = work.gland.fat_fraction_grown;
  result.fibroglandular_agreement = work.gland.agreement;
  result.fibroglandular_expected_dice = expected_gland_dice(result.labels);
  result.sternal_thickness = work.extent.sternal_thickness;
  result.greatest_thickness = work.extent.greatest_thickness;
  double sum = 0, sure = 0, sigma = 0, count = 0;
  std::vector<double> sigmas;
  for (int k = 0; k < work.wall.depth.nz; ++k) {
    for (int i = 0; i < work.wall.depth.nx; ++i) {
      if (!work.extent.columns[std::size_t(k) * work.wall.depth.nx + i]) continue;
      sum += work.wall.confidence.at(i, k);
      sure += work.wall.confidence.at(i, k) > 0.5;
      sigmas.push_back(work.wall.sigma.at(i, k));
      sigma += sigmas.back();
      count += 1;
    }
  }
  result.wall_confidence_mean = count > 0 ? sum / count : 0;
  result.wall_expected_mm = expected_wall_mm(work);
  result.breast_expected_dice = expected_breast_dice(work, result.cut_by_view_cm2);
  result.wall_confident_percent = count > 0 ? 100 * sure / count : 0;
  result.wall_sigma_mean = count > 0 ? sigma / count : 0;
  result.wall_sigma_p95 = percentile(std::move(sigmas), 0.95, result.wall_sigma_p95);
}

void take_extents(Segmentation& result, const Extents& found) {
  result.front_left_out_percent = found.front_left_out_percent;
  result.lateral_border_mm = found.lateral_border_mm;
  result.nipple_depth_mm = found.nipple_depth_mm;
  result.view_behind_sternum_mm = found.view_behind_sternum_mm;
}

/// The papilla or, where none stands out of a prone breast, the areola if its skin shows it. Only where fat is bright is skin dark.
Nipple nipple_of(const Work& work, Segmentation& result) {
  Nipple nipple = find_nipple(work.breast, work.body.mask, result.posture);
  if (result.posture != Posture::prone || nipple.height > 0 ||
      result.kind != Contrast::fat_bright || result.also.used)
    return nipple;
  result.areola =
      find_areola(work.brightness, work.breast, work.body.mask, work.skin_distance, nipple.tip);
  if (!result.areola.found) return nipple;
  nipple.tip = nipple.base = result.areola.centre;
  nipple.from_extreme = (nipple.tip - nipple.extreme).norm();
  return nipple;
}

/// Depth (mm) to which skin darkens what lies below it: its own and that of voxels shared with it,
/// usually 3 mm.
double darkened_by_skin(const Work& work) {
  const Vec3& spacing = work.scan.grid.spacing;
  return work.skin > 0 ? std::min(3.0, work.skin + 0.75 * (spacing[0] + spacing[1])) : 3.0;
}

/// Where skin is that of another scan, the one that this scan shows may lie behind it.
Mask below_skin(const Work& work) {
  const double depth = darkened_by_skin(work);
  Mask interior = interior_of(work, depth, work.scan.grid.spacing[1]);
  for (std::size_t n = 0; n < work.own_distance.voxels.size(); ++n)
    if (work.own_distance.voxels[n] > -depth) interior.voxels[n] = 0;
  return interior;
}

/// Skin, fat and gland of the breast: gland by fat's share of a Dixon scan, otherwise by brightness.
void separate_tissue(Work& work, Interior by, Segmentation& result) {
  work.skin = skin_thickness(work.brightness, work.breast, work.skin_distance);
  const Mask interior = below_skin(work), by_muscle = near_unsure_wall(work, 8);
  if (work.fat_share.voxels.empty()) {
    work.gland = find_fibroglandular(work.brightness, work.body.mask, interior, by_muscle,
                                     work.wall.muscle_ratio, result.bias_cv_after, by);
    return;
  }
  const FatShare share = fat_share_of(work);
  result.exchanged_percent = 100 * share.exchanged;
  work.gland = find_fibroglandular(share.ratio, work.body.mask, interior, by_muscle, share.muscle,
                                   share.scatter, by);
}

/// Compact gland that misleads the estimate of the bias: of which much was taken for dim fat, or
/// which fills much of the breast. Nothing where there is none.
DimTissue missed_gland(const Work& work, const Mask& interior) {
  constexpr double most_missed = 0.2, most_of_breast = 0.25;
  DimTissue gland = compact_gland(work.scan, interior);
  double all = 0, missed = 0, breast = 0;
  for (std::size_t n = 0; n < interior.voxels.size(); ++n) {
    breast += interior.voxels[n];
    all += gland.share.voxels[n];
    missed += work.gland.lobes.voxels[n] ? 0 : gland.share.voxels[n];
  }
  return missed > most_missed * all || all > most_of_breast * breast ? gland : DimTissue{};
}

/// Much bright gland, or compact gland that was missed.
MisleadingGland misleading_gland(const Work& work) {
  constexpr double reach = 4;  // mm beyond compact gland, whose blocks are as wide
  MisleadingGland gland{{}, missed_gland(work, below_skin(work))};
  const bool compact = !gland.compact.share.voxels.empty();
  const bool bright = work.gland.gland_ratio > darkest_gland_in_bias &&
                      1 - work.gland.fat_fraction > least_gland_in_bias;
  if (!bright && !compact) return gland;
  gland.share = gaussian(work.gland.fraction, 1);
  if (!compact) return gland;
  const Volume<float> around = gaussian(gland.compact.share, reach);
  for (std::size_t n = 0; n < around.voxels.size(); ++n)
    gland.share.voxels[n] = std::max(gland.share.voxels[n], around.voxels[n]);
  return gland;
}

/// Estimates the bias again where gland has misled it. Returns whether it has.
bool correct_misled_bias(Work& work, Work coarse, Segmentation& result) {
  const MisleadingGland gland = misleading_gland(work);
  if (gland.share.voxels.empty()) return false;
  refine_bias(coarse, &gland);
  divide_by_bias(work, coarse.bias);
  result.bias_cv_after = coarse.bias.fat_cv_after;
  return true;
}

/// Radius (mm) of the largest ball within a mask.
double greatest_depth_within(const Mask& mask) {
  const Volume<float> distance = signed_distance(mask);
  return std::max(0.0f, -*std::min_element(distance.voxels.begin(), distance.voxels.end()));
}

/// What the user says of the wall, and muscle that lies on it, in a scan with bright or `suppressed` fat.
void complete_wall(Work& work, bool suppressed, const SegmentOptions& options, Progress& progress) {
  progress.update("chest wall", stage_begin::muscle, "muscle on it");
  if (!corrected_by_hand(options)) {
    refine_bias(work);
    // As suppressed fat is shown, noise turns mixtures of it with skin into muscle.
    include_front_muscle(work.wall, work.ratio, suppressed ? &work.skin_distance : nullptr,
                         work.domain,
                         find_extent(work.wall, work.domain, work.torso, work.skin_distance,
                                     options.side, options.posture),
                         work.torso.cleft);
  }
  correct_wall(work, options);
}

/// The final bias, and the contrast as the wall completes it.
void complete_bias(Work& work, Segmentation& result, const SegmentOptions& options) {
  refine_bias(work);
  result.bias_cv_before = work.bias.fat_cv_before;
  result.bias_cv_after = work.bias.fat_cv_after;
  result.bias_range = work.bias.range;
  result.contrast.fat_cv = work.bias.fat_cv_after;
  result.contrast.muscle_ratio = work.wall.muscle_ratio;
  if (options.posture == Posture::prone) complete_contrast(result.contrast, work, options.side);
}

/// Bias, wall and what the user says of it.
void locate_wall(Work& work, Segmentation& result, const SegmentOptions& options,
                 Progress& progress, Timer& timer) {
  find_wall(work, progress, timer);
  const Timer::Scope phase(timer, "bias");
  complete_wall(work, false, options, progress);
  complete_bias(work, result, options);
}

/// The contrast of the scan, where the user does not say it.
Contrast contrast_of(const SegmentOptions& options) {
  if (options.contrast != Contrast::automatic) return options.contrast;
  return options.fat ? Contrast::dixon : Contrast::fat_bright;
}

/// Finds the contrast, and bias and wall by it. Returns why the contrast is refused; empty if it is
/// not.
std::string find_contrast(Work& work, Segmentation& result, const SegmentOptions& options,
                          Progress& progress, Timer& timer) {
  result.contrast =
      contrast_below_skin(work, options.posture != Posture::prone ? spread_behind : 0);
  result.kind = contrast_of(options);
  const auto half = [&] { return options.fat ? "" : refusal_of_half(result.contrast); };
  std::string refusal = half();
  if (!refusal.empty() && options.contrast != Contrast::fat_bright) return refusal;
  locate_wall(work, result, options, progress, timer);
  refusal = half();
  return refusal.empty() ? refusal_of(result.contrast) : refusal;
}

/// The reason for a refusal that `read` returns or throws, without its ways out; empty if the scan can be read.
template <typename Read>
std::string refusal_of_reading(Read&& read) {
  try {
    return read();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::input) throw;
    const std::string reason = error.what();
    return reason.substr(0, reason.find(ways_out_begin));
  }
}

/// Why the scan alone does not show the wall; empty if it does.
std::string refusal_alone(Work& work, Segmentation& result, const SegmentOptions& options,
                          Progress& progress, Timer& timer) {
  return refusal_of_reading([&] { return find_contrast(work, result, options, progress, timer); });
}

/// Puts the second scan in the place of the first for all but the skin.
void take_second_scan(Work& work, Images& images, Segmentation& result,
                      const SegmentOptions& options) {
  const Volume<float> second = in_patient_order(*options.also);
  const Body body = find_body(on_working_grid(second), options.side, options.posture);
  const SecondScan aligned = align_skins(work.torso, work.skin_distance, body.mask);
  SharedField field = shared_field(images.tissue, work.body.mask, second, aligned.motion);
  result.also = {.used = true,
                 .residual_mm = aligned.residual_mm,
                 .shift_mm = aligned.motion.shift.norm(),
                 .turn_degrees = aligned.motion.turn.norm(),
                 .shared_percent = field.percent,
                 .change = {}};
  images.outline = std::move(field.first);
  images.seen = {};
  images.tissue = std::move(field.second);
  measure_noise(images);
  start_work(work, images, options);
  result.debris_ml = work.body.debris_ml;
  result.beside_ml = work.body.beside_ml;
  frame_body(work, options);
}

/// Body in which suppressed fat is hardly brighter than air: what is brighter than both counts as
/// little brighter, so that the threshold does not fall between fat and what holds water.
Body body_of_dark_fat(Volume<float> scan, double air_level, const SegmentOptions& options) {
  constexpr double above_air = 2.5;
  const float most = float(above_air * air_level);
  if (most > 0)
    for (float& value : scan.voxels) value = std::min(value, most);
  return find_body(scan, options.side, options.posture);
}

/// Reads a scan with suppressed fat, which is `found` to be dark. Returns why its wall cannot be seen; empty if it can,
/// or if the user gives one.
std::string read_suppressed(Work& work, Images& images, Segmentation& result, DarkFat& found,
                            const SegmentOptions& options, Progress& progress, Timer& timer) {
  const Volume<float> scan = work.scan;
  work.body = body_of_dark_fat(scan, work.body.air_level, options);
  frame_body(work, options);
  SuppressedFat fat = find_suppressed_wall(work, progress, timer);
  const Timer::Scope phase(timer, "bias");
  found = dark_fat(fat);
  result.kind = Contrast::fat_suppressed;
  result.muscle_over_fat = fat.muscle.median;
  result.muscle_over_fat_low = fat.muscle.low;
  result.contrast = contrast_below_skin(work);
  complete_wall(work, true, options, progress);
  complete_bias(work, result, options);
  show_gland(work, scan, images, fat);
  result.unsuppressed_ml = fat.failed_ml;
  if (!corrected_by_hand(options)) doubt_wall_by_failed(work, fat);
  if (fat.failed_ml > 0) result.doubts.push_back(doubt_of_failed(fat));
  const std::string refusal = refusal_of_suppressed(fat, result.contrast);
  if (!refusal.empty() && !corrected_by_hand(options)) return refusal;
  if (!refusal.empty()) result.doubts.push_back("the chest wall is the given one: " + refusal);
  if (!corrected_by_hand(options)) {
    result.doubts.push_back(message(
        "the chest wall was found in suppressed fat, beside which muscle is ",
        format_fixed(fat.muscle.median, 2),
        " times as bright: what lies in front of the ribs may be taken for muscle; check it "
        "(--overlay)"));
  }
  refine_bias(work);
  result.bias_cv_after = work.bias.fat_cv_after;
  return "";
}

/// Bias and wall of a scan that comes alone. One that is refused as a scan with bright fat is read as one with
/// suppressed fat, unless the user says what it is.
void find_wall_alone(Work& work, Images& images, Segmentation& result,
                     const SegmentOptions& options, Progress& progress, Timer& timer) {
  DarkFat found = DarkFat::unknown;
  if (options.contrast == Contrast::fat_suppressed) {
    const FatContrast below_skin = contrast_below_skin(work);
    if (!corrected_by_hand(options) && !may_be_suppressed(below_skin))
      throw input_error(refusal_of_skin(below_skin), ways_out(false));
    const std::string refusal =
        read_suppressed(work, images, result, found, options, progress, timer);
    if (!refusal.empty()) throw input_error(refusal, ways_out(found == DarkFat::silent));
    return;
  }
  const bool suppressed_too =
      options.contrast == Contrast::automatic && !options.fat && options.posture == Posture::prone;
  const auto read = suppressed_too ? refusal_alone : find_contrast;
  const std::string refusal = read(work, result, options, progress, timer);
  if (refusal.empty()) return;
  if (options.contrast == Contrast::fat_bright) {
    result.doubts.push_back("accepted as requested: " + refusal);
    return;
  }
  if (options.fat)
    throw input_error("the sum of water and fat: ", refusal,
                      ": give the two images of one Dixon scan, or a T1 series as MR");
  const bool half = !refusal_of_half(result.contrast).empty();
  if (!suppressed_too || !may_be_suppressed(result.contrast))
    throw input_error(refusal, ways_out(half, false));
  const std::string suppressed = refusal_of_reading(
      [&] { return read_suppressed(work, images, result, found, options, progress, timer); });
  if (!suppressed.empty()) throw input_error(refusal_of_both(refusal, half, suppressed, found));
}

/// Bias and wall of the scan that shows them: the first, or else the second.
void find_wall_on_either(Work& work, Images& images, Segmentation& result,
                         const SegmentOptions& options, Progress& progress, Timer& timer) {
  if (!options.also) return find_wall_alone(work, images, result, options, progress, timer);
  Work alone = work;
  const std::string unseen = refusal_alone(alone, result, options, progress, timer);
  if (unseen.empty()) {
    work = std::move(alone);
    result.also.change =
        "the second scan changed nothing: in MR fat is bright, which shows the chest wall";
    return;
  }
  alone = {};
  take_second_scan(work, images, result, options);
  const std::string refusal = find_contrast(work, result, options, progress, timer);
  if (!refusal.empty())
    throw input_error("MR: ", unseen, "; --also: ", refusal,
                      ": give a second scan in which fat is bright");
  // The wall is as uncertain as its place beside the skin of the other scan.
  for (double& sigma : work.wall.sigma.depth) sigma = std::hypot(sigma, result.also.residual_mm);
  const SecondScanUse& also = result.also;
  result.also.change = message(
      "the skin is from MR, chest wall, muscle and gland are from the second scan (skins ",
      format_fixed(also.residual_mm, 1), " mm apart rms after ", format_fixed(also.shift_mm, 1),
      " mm and ", format_fixed(also.turn_degrees, 1), " degrees, ",
      std::lround(also.shared_percent), " % of the body in both); MR alone: ", unseen);
}

/// Where a wall is held by the limits of the search alone, or what lies behind is as bright as fat
/// (muscle has 0.2 to 0.4 of it in T1).
void refuse_without_wall(const Segmentation& result) {
  // A prone breast hangs in front of the sternum: a wall that leaves out a third of that runs through the breast.
  constexpr double most_left_out = 30;  // %
  if (result.posture == Posture::prone && result.front_left_out_percent > most_left_out) {
    throw input_error(
        "the chest wall was found inside the breast: ", std::lround(result.front_left_out_percent),
        " % of the body in front of the skin over the sternum is not labelled breast (at most ",
        most_left_out, "): give --chest-wall, or a scan that shows it (--also)");
  }
  constexpr double least_confidence = 0.15, brightest_muscle = 0.6;
  if (result.wall_confidence_mean >= least_confidence && result.muscle_ratio < brightest_muscle)
    return;
  throw input_error("no chest wall found: behind it the image has ",
                    std::lround(100 * result.muscle_ratio),
                    " % of the brightness in front (at most ", std::lround(100 * brightest_muscle),
                    " % expected), mean confidence ", result.wall_confidence_mean, " (at least ",
                    least_confidence,
                    "): is fat saturated, or is the scan not T1-weighted? Otherwise give "
                    "--chest-wall");
}

}  // namespace

std::string_view contrast_name(Contrast contrast) {
  switch (contrast) {
    case Contrast::fat_bright:
      return "fat-bright";
    case Contrast::fat_suppressed:
      return "fat-suppressed";
    case Contrast::dixon:
      return "dixon";
    default:
      return "auto";
  }
}

Segmentation segment_breast(Volume<float> scan, const SegmentOptions& options, Progress& shown,
                            Timer& timer) {
  Work work;
  Images images;  // what was scanned; `work` may be coarser
  Segmentation result;
  const bool supine = options.posture != Posture::prone;
  result.posture = options.posture;
  {
    const Timer::Scope phase(timer, "body");
    shown.update("body", stage_begin::body, "");
    images = images_of(std::move(scan), options);
    start_work(work, images, options);
    const double roll = stand_upright(images, work.scan, work.body.mask, options);
    if (roll != 0) start_work(work, images, options);
    result.roll_degrees = roll * 180 / std::numbers::pi;
    result.debris_ml = work.body.debris_ml;
    result.beside_ml = work.body.beside_ml;
    frame_body(work, options);
  }
  Pace progress(shown, images.tissue.grid.voxels(), work.scan.grid.voxels(),
                side_voxels(work, images.tissue.grid, options.side));
  find_wall_on_either(work, images, result, options, progress, timer);
  const Timer::Scope phase(timer, "tissue");
  progress.update("tissue", stage_begin::tissue, "in the voxels of the scan");
  Work coarse = std::move(work);
  // Of the working grid, only what the bias may be estimated again from is still needed.
  coarse.ratio = {};
  coarse.brightness = {};
  work = on_scan_grid(coarse, std::move(images), options.side);
  progress.update("tissue", stage_begin::breast, "extent of the breast");
  work.extent = find_extent(work.wall, work.domain, work.torso, work.skin_distance, options.side,
                            options.posture);
  work.breast = breast_voxels(work.body.mask, work.wall, work.domain, work.torso, work.extent,
                              options.side, options.posture);
  for (std::size_t n = 0; n < work.seen.voxels.size(); ++n)
    work.breast.voxels[n] &= work.seen.voxels[n];
  progress.update("tissue", stage_begin::gland, "fat and gland");
  separate_tissue(work, Interior::threshold, result);
  if (correct_misled_bias(work, std::move(coarse), result) ||
      options.interior != Interior::threshold)
    separate_tissue(work, options.interior, result);
  progress.update("tissue", stage_begin::result, "nipple and measures");
  result.lost_edges_percent = lost_edges_percent(work.scan, below_skin(work), work.gland);
  result.compact_dark_mm = greatest_depth_within(work.gland.lobes);
  result.labels = labels_of(work, options.side);
  if (options.wall_labels)
    result.muscle_back_percent = 100 * end_muscle(result.labels, *options.wall_labels);
  result.labels.midline_mm =
      work.scan.grid.to_patient(Vec3(work.torso.midline, 0, 0.5 * work.scan.grid.size[2]))[0];
  const Nipple nipple = nipple_of(work, result);
  result.labels.landmarks["nipple"] = nipple.tip;
  result.nipple_base = nipple.base;
  result.papilla_height = nipple.height;
  result.nipple_from_extreme = nipple.from_extreme;
  result.points = supine ? side_points(work) : data_points(work);
  result.wall_shift = options.wall_shift;
  result.cut_by_view_cm2 = cut_by_view_cm2(work.breast, work.seen);
  // A supine breast is flat, and what its side rests on is not gone back to.
  if (!supine) result.flat_skin_cm2 = flat_skin_cm2(work);
  summarise(result, work);
  const Extents found = extents_of(work, nipple.tip, options.side);
  take_extents(result, found);
  add_doubts(result, work, found);
  if (!corrected_by_hand(options)) refuse_without_wall(result);
  return result;
}

}  // namespace breast
