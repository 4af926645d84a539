// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/tissue/skin_thickness.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "segment/grid/filters.hpp"

namespace breast {

namespace {

constexpr double skin_to_fat = 0.5;  // brightness of skin in T1
constexpr double edge = 0.25;        // of fat: below skin, above air
constexpr double step = 0.2, outside = 4, profile_reach = 6, fat_layer = 2;  // mm along a profile
constexpr std::size_t least_profiles = 200;

/// Variance (mm2) of what blurs a surface of this normal (grid axes): the voxel's own width and the
/// interpolation between voxels, on average a twelfth and a sixth of its square.
double blur_across(const Vec3& normal, const Vec3& spacing) {
  return 0.25 * normal.cwiseProduct(spacing).squaredNorm();
}

/// Brightness at depth x behind the surface of a blurred layer of skin in front of fat.
double model(double x, double thickness, double sigma) {
  const auto rise = [&](double at) { return 0.5 * std::erfc(-at / (sigma * std::sqrt(2.0))); };
  return skin_to_fat * rise(x) + (1 - skin_to_fat) * rise(x - thickness);
}

/// What the profile misses of fat (mm) over `profile_reach` behind the place where it passes `edge`.
template <class Profile>
double deficit_behind(double place, const Profile& profile) {
  double sum = 0;
  for (double d = 0.5 * step; d < profile_reach; d += step) sum += (1 - profile(place + d)) * step;
  return sum;
}

/// Thickness (mm) at which the model misses as much as was measured.
double thickness_of(double deficit, double sigma) {
  double low = 0, high = profile_reach;
  for (int n = 0; n < 30; ++n) {
    const double middle = 0.5 * (low + high);
    const auto profile = [&](double x) { return model(x, middle, sigma); };
    double place = -4 * sigma;
    while (profile(place) < edge) place += 0.01;
    (deficit_behind(place, profile) < deficit ? low : high) = middle;
  }
  return low;
}

/// Deficit along `inward` from around `surface` (patient mm); negative where the profile does not
/// begin in air or does not end in fat.
double deficit_at(const Volume<float>& brightness, const Vec3& surface, const Vec3& inward) {
  const auto raw = [&](double s) { return sample_linear(brightness, surface + s * inward, edge); };
  double place = -outside;
  if (!(raw(place) < edge)) return -1;
  while (place < outside && raw(place) < edge) place += 0.05;
  double fat = 0;
  int samples = 0;
  for (double d = profile_reach; d < profile_reach + fat_layer; d += step, ++samples)
    fat += raw(place + d);
  fat /= samples;
  if (!(place < outside && fat > 0.8 && fat < 1.25)) return -1;
  return deficit_behind(place, [&](double s) { return raw(s) / fat; });
}

Vec3 gradient(const Volume<float>& v, int i, int j, int k) {
  const Vec3 ahead(v.at(i + 1, j, k), v.at(i, j + 1, k), v.at(i, j, k + 1)),
      behind(v.at(i - 1, j, k), v.at(i, j - 1, k), v.at(i, j, k - 1));
  return (ahead - behind).cwiseQuotient(2 * v.grid.spacing);
}

/// Deficit and blur of every profile.
std::vector<std::pair<double, double>> profiles(const Volume<float>& brightness, const Mask& breast,
                                                const Volume<float>& skin_distance) {
  const Grid& grid = breast.grid;
  const Volume<float> smooth = gaussian(skin_distance, 2);
  const double voxel = 0.5 * (grid.spacing[0] + grid.spacing[1]);
  const double most_blur = 1.5 * blur_across(Vec3(1, 0, 0), Vec3::Constant(voxel));
  std::vector<std::pair<double, double>> found;
  for (int k = 1; k + 1 < grid.size[2]; ++k) {
    for (int j = 1; j + 1 < grid.size[1]; ++j) {
      for (int i = 1; i + 1 < grid.size[0]; ++i) {
        if (!breast.at(i, j, k) || !(skin_distance.at(i, j, k) > -0.75 * voxel)) continue;
        const Vec3 slope = gradient(smooth, i, j, k);
        if (!(slope.norm() > 0.5)) continue;  // of a distance: a fold or an edge
        const Vec3 normal = slope.normalized();
        const double blur = blur_across(normal, grid.spacing);
        if (!(blur < most_blur)) continue;
        const double deficit =
            deficit_at(brightness, grid.to_patient(Vec3(i, j, k)), -(grid.direction * normal));
        if (deficit >= 0) found.emplace_back(deficit, blur);
      }
    }
  }
  return found;
}

}  // namespace

double skin_thickness(const Volume<float>& brightness, const Mask& breast,
                      const Volume<float>& skin_distance) {
  auto found = profiles(brightness, breast, skin_distance);
  if (found.size() < least_profiles) return 0;
  double variance = 0;
  for (const auto& [deficit, blur] : found) variance += blur / double(found.size());
  const auto middle = found.begin() + std::ptrdiff_t(found.size() / 2);
  std::nth_element(found.begin(), middle, found.end());
  return thickness_of(middle->first, std::sqrt(variance));
}

}  // namespace breast
