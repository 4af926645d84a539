// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/chart.hpp"

#include <algorithm>
#include <cmath>

#include "core/table.hpp"
#include "figures/colour_scale.hpp"

namespace breast {

namespace {

constexpr double chart_letters = 15;
constexpr Colour ink{0, 0, 0}, grid{0.87, 0.87, 0.87};

double fraction(const Axis& axis, double value) {
  if (axis.logarithmic) return std::log(value / axis.low) / std::log(axis.high / axis.low);
  return (value - axis.low) / (axis.high - axis.low);
}

/// Powers of ten, or about five round values.
std::vector<double> ticks(const Axis& axis) {
  std::vector<double> values;
  if (axis.logarithmic) {
    for (int k = int(std::ceil(std::log10(axis.low) - 1e-9));
         std::pow(10.0, k) <= axis.high * (1 + 1e-9); ++k) {
      values.push_back(std::pow(10.0, k));
    }
    return values;
  }
  const double low = std::min(axis.low, axis.high), high = std::max(axis.low, axis.high);
  const double step = round_up((high - low) / 6);
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) {
    values.push_back(k * step);
  }
  return values;
}

std::string label(double value) {
  const bool whole = std::abs(value - std::round(value)) < 1e-9;
  if (whole && std::abs(value) < 0.5) return "0";  // never "-0"
  return format_fixed(value, whole ? 0 : value < 0.1 ? 2 : 1);
}

}  // namespace

Chart::Chart(Panel& panel, const Axis& across, const Axis& upwards)
    : panel_(panel),
      across_(across),
      upwards_(upwards),
      corner_(80, 66),
      extent_(panel.size() - Vec2(112, 124)) {
  for (const double value : ticks(across_)) {
    const double x = corner_.x() + extent_.x() * fraction(across_, value);
    panel_.line({x, corner_.y()}, {x, corner_.y() + extent_.y()}, grid, 1);
    panel_.text({x, corner_.y() - 16}, label(value), chart_letters, ink, Align::centre);
  }
  for (const double value : ticks(upwards_)) {
    const double y = corner_.y() + extent_.y() * fraction(upwards_, value);
    panel_.line({corner_.x(), y}, {corner_.x() + extent_.x(), y}, grid, 1);
    panel_.text({corner_.x() - 8, y}, label(value), chart_letters, ink, Align::right);
  }
  panel_.text({corner_.x() + extent_.x() / 2, corner_.y() - 42}, across_.title, chart_letters + 1,
              ink, Align::centre);
  panel_.text({12, corner_.y() + extent_.y() + 22}, upwards_.title, chart_letters + 1, ink);
}

Vec2 Chart::pixel(const Vec2& value) const {
  return corner_ +
         extent_.cwiseProduct(Vec2(fraction(across_, value.x()), fraction(upwards_, value.y())));
}

bool Chart::inside(const Vec2& value) const {
  if (upwards_.logarithmic && !(value.y() > 0)) return false;
  const double x = fraction(across_, value.x()), y = fraction(upwards_, value.y());
  return x >= -1e-9 && x <= 1 + 1e-9 && y >= -1e-9 && y <= 1 + 1e-9;
}

void Chart::band(double low, double high, const Colour& colour, const std::string& words) {
  const double from = std::clamp(fraction(upwards_, low), 0.0, 1.0);
  const double to = std::clamp(fraction(upwards_, high), 0.0, 1.0);
  const double middle = corner_.y() + extent_.y() * 0.5 * (from + to);
  panel_.line({corner_.x(), middle}, {corner_.x() + extent_.x(), middle}, colour,
              extent_.y() * (to - from));
  panel_.text({corner_.x() + 8, corner_.y() + extent_.y() * to - 12}, words, chart_letters - 1,
              {0.25, 0.4, 0.25});
}

void Chart::piece(const Vec2& from, const Vec2& to, const Colour& colour, double width,
                  bool dashed) {
  if (!dashed) return panel_.line(from, to, colour, width);
  const double length = (to - from).norm(), dash = 9;
  for (double s = 0; s < length; s += 1.6 * dash) {
    const Vec2 along = (to - from) / length;
    panel_.line(from + s * along, from + std::min(s + dash, length) * along, colour, width);
  }
}

void Chart::curve(const std::vector<Vec2>& points, const Colour& colour, double width,
                  bool dashed) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!inside(points[i])) continue;
    const Vec2 here = pixel(points[i]);
    if (i > 0 && inside(points[i - 1])) {
      piece(pixel(points[i - 1]), here, colour, width, dashed);
    }
    panel_.line(here - Vec2(4, 0), here + Vec2(4, 0), colour, 8);
  }
}

void Chart::legend(const std::string& words, const Colour& colour, bool dashed) {
  const Vec2 at = corner_ + Vec2(14, extent_.y() - 18 - 22 * lines_++);
  piece(at, at + Vec2(34, 0), colour, 3, dashed);
  panel_.text(at + Vec2(42, 0), words, chart_letters, ink);
}

void Chart::frame() {
  const Vec2 right(extent_.x(), 0), up(0, extent_.y());
  for (const auto& [from, to] : {std::pair<Vec2, Vec2>{corner_, corner_ + right},
                                 {corner_, corner_ + up},
                                 {corner_ + right, corner_ + extent_},
                                 {corner_ + up, corner_ + extent_}}) {
    panel_.line(from, to, ink, 1);
  }
}

}  // namespace breast
