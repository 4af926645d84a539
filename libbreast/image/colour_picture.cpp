// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/colour_picture.hpp"

#include <algorithm>
#include <cmath>

namespace breast {

ColourPicture::ColourPicture(int width, int height, const std::vector<float>& grey)
    : width_(width), height_(height), rgb_(3 * grey.size()), coverage_(grey.size(), 0) {
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const auto value = std::uint8_t(std::lround(255 * std::clamp(grey[i], 0.0f, 1.0f)));
    for (std::size_t c = 0; c < 3; ++c) rgb_[3 * i + c] = value;
  }
}

void ColourPicture::segment(const Vec2& a, const Vec2& b, double half_width) {
  const double reach = half_width + 0.5;
  const auto first = [&](double x) { return std::max(0, int(std::ceil(x - reach))); };
  const auto last = [&](double x, int n) { return std::min(n - 1, int(std::floor(x + reach))); };
  const Vec2 d = b - a;
  const double length2 = d.squaredNorm();
  for (int y = first(std::min(a.y(), b.y())); y <= last(std::max(a.y(), b.y()), height_); ++y) {
    for (int x = first(std::min(a.x(), b.x())); x <= last(std::max(a.x(), b.x()), width_); ++x) {
      const Vec2 p(x, y);
      const double f = length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0, 1.0) : 0.0;
      const double covered = std::clamp(reach - (p - a - f * d).norm(), 0.0, 1.0);
      float& at = coverage_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
      at = std::max(at, float(covered));
    }
  }
}

void ColourPicture::line(const std::vector<Vec2>& points, double width) {
  for (std::size_t i = 1; i < points.size(); ++i) segment(points[i - 1], points[i], 0.5 * width);
}

void ColourPicture::disc(const Vec2& centre, double radius) {
  segment(centre, centre, radius);
}

void ColourPicture::quadrilateral(const std::array<Vec2, 4>& corners) {
  Vec2 low = corners[0], high = low;
  for (const Vec2& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const auto holds = [&](const Vec2& p) {  // even-odd rule
    bool inside = false;
    for (std::size_t i = 0, j = 3; i < 4; j = i++) {
      const Vec2 &a = corners[i], &b = corners[j];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      inside ^= p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    }
    return inside;
  };
  for (int y = std::max(0, int(low.y())); y <= std::min(height_ - 1, int(high.y()) + 1); ++y) {
    for (int x = std::max(0, int(low.x())); x <= std::min(width_ - 1, int(high.x()) + 1); ++x) {
      if (holds(Vec2(x, y))) coverage_[std::size_t(y) * std::size_t(width_) + std::size_t(x)] = 1;
    }
  }
}

void ColourPicture::paint(const Colour& colour, double opacity) {
  for (std::size_t i = 0; i < coverage_.size(); ++i) {
    if (!(coverage_[i] > 0)) continue;
    const double part = opacity * coverage_[i];
    for (std::size_t c = 0; c < 3; ++c) {
      std::uint8_t& value = rgb_[3 * i + c];
      value = std::uint8_t(std::lround((1 - part) * value + part * colour[c]));
    }
    coverage_[i] = 0;
  }
}

}  // namespace breast
