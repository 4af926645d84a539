// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/colour_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/table.hpp"

namespace breast {

Colour heat(double t) {
  static constexpr std::array<Colour, 7> stops = {{{0.97, 0.93, 0.86},
                                                   {0.99, 0.83, 0.52},
                                                   {0.98, 0.64, 0.30},
                                                   {0.90, 0.42, 0.22},
                                                   {0.74, 0.20, 0.26},
                                                   {0.47, 0.08, 0.32},
                                                   {0.18, 0.04, 0.24}}};
  const double at = std::clamp(t, 0.0, 1.0) * (stops.size() - 1);
  const std::size_t k = std::min(std::size_t(at), stops.size() - 2);
  const double w = at - double(k);
  const Colour &a = stops[k], &b = stops[k + 1];
  return {(1 - w) * a.r + w * b.r, (1 - w) * a.g + w * b.g, (1 - w) * a.b + w * b.b};
}

double round_up(double value, const std::vector<double>& steps) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : steps) {
    if (factor * decade >= value * (1 - 1e-12)) return factor * decade;
  }
  return 10 * decade;
}

void colour_bar(Panel& panel, double high, const std::string& title) {
  constexpr int bands = 96;
  constexpr double width = 18, letters = 15;
  const double x = panel.size().x() - 62, low_y = 90, tall = panel.size().y() - 190;
  const double band = tall / bands;
  for (int k = 0; k < bands; ++k) {
    const double y = low_y + (k + 0.5) * band;
    // Half a pixel of overlap leaves no gaps between bands.
    panel.line({x, y}, {x + width, y}, heat((k + 0.5) / bands), band + 0.5);
  }
  for (int k = 0; k <= 4; ++k) {
    const double y = low_y + tall * k / 4;
    panel.line({x + width, y}, {x + width + 5, y}, {0, 0, 0}, 1);
    const double value = high * k / 4;
    panel.text({x + width + 8, y}, format_fixed(value, high < 10 ? 1 : 0), letters - 1, {0, 0, 0});
  }
  panel.text({x + width, low_y + tall + 20}, title, letters, {0, 0, 0}, Align::right);
}

}  // namespace breast
