// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/tissue/bias.hpp"

#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "segment/grid/filters.hpp"

namespace breast {

namespace {

constexpr float seed_drop = 0.35f;  // seeds: log intensity this close to the local maximum
// Fat: residual log intensity, in units of fat's own scatter. The weight falls to zero on the dark
// side, where voxels shared with gland would pull the field down, take in darker ones and so eat
// into the gland pass by pass.
constexpr float fat_low = -2.2f, fat_sure = -0.8f, fat_high = 0.35f;
constexpr float least_scatter = 0.045f, most_scatter = 0.10f;
constexpr float far_below = -1e4f;
constexpr float surely_dim = 0.9f;  // share of a voxel: no fat in it
// A wrong step between fat and dim tissue is mostly followed by the field, which is smooth but runs through both;
// a third of it is left to be seen.
constexpr float hidden_by_field = 3;

/// Gaussian of a width far above the voxel size, on a grid as coarse as that width allows.
Volume<float> wide_gaussian(const Volume<float>& volume, double sigma) {
  std::array<int, 3> factor{};
  for (int d = 0; d < 3; ++d) factor[d] = std::max(1, int(sigma / (3 * volume.grid.spacing[d])));
  if (factor == std::array<int, 3>{1, 1, 1}) return gaussian(volume, sigma);
  return resampled(gaussian(coarsened(volume, factor), sigma), volume.grid);
}

/// Adds to `out` the normalised convolution of value - out with `weight`, in
/// proportion to its support.
void add_smoothed_residual(Volume<float>& out, const Volume<float>& value,
                           const Volume<float>& weight, double sigma, float enough) {
  Volume<float> weighted(value.grid);
  for (std::size_t n = 0; n < out.voxels.size(); ++n) {
    const float w = weight.voxels[n];
    weighted.voxels[n] = w > 0 ? w * (value.voxels[n] - out.voxels[n]) : 0;
  }
  const Volume<float> numerator = wide_gaussian(weighted, sigma),
                      support = wide_gaussian(weight, sigma);
  for (std::size_t n = 0; n < out.voxels.size(); ++n) {
    out.voxels[n] += numerator.voxels[n] / (support.voxels[n] + enough);
  }
}

/// Smooth field through `value` weighted by `weight`: from 9 sigma to sigma, each width correcting
/// what the wider one left, so that far from any fat the wide ones remain. The last width is used
/// twice: a one-sided neighbourhood (at skin and chest wall) otherwise flattens the field's slope.
Volume<float> smooth_inside(const Volume<float>& value, const Volume<float>& weight, double sigma) {
  double sum = 0, total = 0;
  for (std::size_t n = 0; n < value.voxels.size(); ++n) {
    if (!(weight.voxels[n] > 0)) continue;
    sum += weight.voxels[n] * value.voxels[n];
    total += weight.voxels[n];
  }
  Volume<float> out(value.grid, float(sum / std::max(total, 1e-6)));
  add_smoothed_residual(out, value, weight, 9 * sigma, 0.01f);
  add_smoothed_residual(out, value, weight, 3 * sigma, 0.01f);
  // Within a compact gland the narrow width would see its rim alone.
  add_smoothed_residual(out, value, weight, sigma, 0.05f);
  add_smoothed_residual(out, value, weight, sigma, 0.05f);
  return out;
}

/// Scatter of fat's log intensity, from what is brighter than the field: there is no gland there.
float scatter_of(const Volume<float>& logs, const Volume<float>& field,
                 const Volume<float>& weight) {
  double sum = 0, square = 0;
  for (std::size_t n = 0; n < logs.voxels.size(); ++n) {
    const double residual = logs.voxels[n] - field.voxels[n];
    if (!(weight.voxels[n] > 0 && residual > 0 && residual < fat_high)) continue;
    sum += weight.voxels[n];
    square += weight.voxels[n] * residual * residual;
  }
  if (!(sum > 0)) return most_scatter;
  return std::clamp(float(std::sqrt(square / sum)), least_scatter, most_scatter);
}

float fat_weight(float residual, float scatter) {
  if (!(residual > fat_low * scatter && residual < fat_high)) return 0;
  return std::min(1.0f, (residual - fat_low * scatter) / ((fat_sure - fat_low) * scatter));
}

/// By how much fat is brighter (log, over `field`) than dim tissue where both are near: each one's mean within
/// about `sigma`. Over the field, because fat and dim tissue do not lie equally near to the coil.
float step_between(const Volume<float>& logs, const Volume<float>& field, const Volume<float>& fat,
                   const Volume<float>& dim, double sigma) {
  const auto mean_of = [&](const Volume<float>& weight, Volume<float>& support) {
    Volume<float> mean = weight;
    for (std::size_t n = 0; n < mean.voxels.size(); ++n)
      mean.voxels[n] *= weight.voxels[n] > 0 ? logs.voxels[n] - field.voxels[n] : 0;
    mean = wide_gaussian(mean, sigma);
    support = wide_gaussian(weight, sigma);
    for (std::size_t n = 0; n < mean.voxels.size(); ++n)
      mean.voxels[n] /= std::max(support.voxels[n], 1e-6f);
    return mean;
  };
  Volume<float> near_fat, near_dim;
  const Volume<float> of_fat = mean_of(fat, near_fat), of_dim = mean_of(dim, near_dim);
  double sum = 0, total = 0;
  for (std::size_t n = 0; n < logs.voxels.size(); ++n) {
    const double both = double(near_fat.voxels[n]) * near_dim.voxels[n];
    sum += both * (of_fat.voxels[n] - of_dim.voxels[n]);
    total += both;
  }
  return total > 0 ? float(sum / total) : 0;
}

double variation(const std::vector<double>& values) {
  if (values.size() < 2) return 0;
  double mean = 0, square = 0;
  for (const double v : values) mean += v;
  mean /= double(values.size());
  for (const double v : values) square += (v - mean) * (v - mean);
  return std::sqrt(square / double(values.size() - 1)) / mean;
}

}  // namespace

BiasField fat_bias(const Volume<float>& scan, const Mask& allowed,
                   const Volume<float>& skin_distance, const BiasSettings& settings,
                   const Volume<float>* previous, const DimTissue* dim) {
  const std::size_t count = scan.voxels.size();
  Volume<float> logs(scan.grid, far_below);
  Mask core(scan.grid);
  Volume<float> dim_core(scan.grid);
  for (std::size_t n = 0; n < count; ++n) {
    if (!(-skin_distance.voxels[n] > settings.core && scan.voxels[n] > 0)) continue;
    core.voxels[n] = allowed.voxels[n];
    dim_core.voxels[n] = dim && dim->share.voxels[n] > surely_dim && !core.voxels[n];
    if (core.voxels[n]) logs.voxels[n] = elementary::log(scan.voxels[n]);
    if (dim_core.voxels[n] > 0) logs.voxels[n] = elementary::log(scan.voxels[n]) + float(dim->step);
  }
  Volume<float> fat(scan.grid);
  {
    Volume<float> flat = logs;
    for (std::size_t n = 0; previous && n < count; ++n) flat.voxels[n] -= previous->voxels[n];
    const Volume<float> brightest = box_maximum(flat, 0.5 * settings.window);
    for (std::size_t n = 0; n < count; ++n) {
      fat.voxels[n] = core.voxels[n] && flat.voxels[n] > brightest.voxels[n] - seed_drop ? 1 : 0;
    }
  }
  if (std::none_of(fat.voxels.begin(), fat.voxels.end(), [](float v) { return v > 0; })) {
    throw input_error(
        "no fat was found in front of the chest wall: is this a T1-weighted scan without fat "
        "suppression?");
  }
  BiasField field;
  const auto smooth = [&] {
    Volume<float> weight = fat;
    for (std::size_t n = 0; n < count; ++n) weight.voxels[n] += dim_core.voxels[n];
    field.log_bias = smooth_inside(logs, weight, settings.sigma);
  };
  for (int pass = 0; pass < 4; ++pass) {
    smooth();
    const float scatter =
        settings.refined && pass > 0 ? scatter_of(logs, field.log_bias, fat) : most_scatter;
    for (std::size_t n = 0; n < count; ++n) {
      const float residual = logs.voxels[n] - field.log_bias.voxels[n];
      fat.voxels[n] = core.voxels[n] ? fat_weight(residual, scatter) : 0;
    }
    if (!dim) continue;
    const float more =
        hidden_by_field * step_between(logs, field.log_bias, fat, dim_core, settings.sigma);
    for (std::size_t n = 0; n < count; ++n) {
      if (dim_core.voxels[n] > 0) logs.voxels[n] += more;
    }
  }
  smooth();
  std::vector<double> before, after;
  for (std::size_t n = 0; n < count; ++n) {
    if (!(fat.voxels[n] > 0)) continue;
    before.push_back(scan.voxels[n]);
    after.push_back(scan.voxels[n] / elementary::exp(field.log_bias.voxels[n]));
  }
  std::vector<float> levels;
  for (std::size_t n = 0; n < count; ++n) {
    if (fat.voxels[n] > 0) levels.push_back(field.log_bias.voxels[n]);
  }
  if (!levels.empty()) {
    std::sort(levels.begin(), levels.end());
    const auto at = [&](double share) {
      return levels[std::size_t(share * double(levels.size() - 1))];
    };
    field.range = elementary::exp(at(0.99) - at(0.01));
  }
  field.fat_cv_before = variation(before);
  field.fat_cv_after = variation(after);
  return field;
}

}  // namespace breast
