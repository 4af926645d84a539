// SPDX-License-Identifier: GPL-3.0-or-later
// Captions, scale bars and compasses of a panel.
#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCoordinate.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "figures/canvas.hpp"
#include "figures/canvas_impl.hpp"

namespace breast {

namespace {
constexpr double caption_letters = 17;  // pixels

vtkSmartPointer<vtkActor2D> annulus(const Vec2& centre, double inner, double outer,
                                    const Colour& colour) {
  constexpr int steps = 72;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (int k = 0; k < steps; ++k) {
    const double angle = 2 * std::numbers::pi * k / steps;
    for (const double radius : {inner, outer}) {
      const Vec2 p = supersampling * (centre + radius * Vec2(std::cos(angle), std::sin(angle)));
      points->InsertNextPoint(p.x(), p.y(), 0);
    }
    const int next = (k + 1) % steps;
    cells->InsertNextCell({2 * k, 2 * k + 1, 2 * next + 1, 2 * next});
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  vtkNew<vtkCoordinate> viewport;
  viewport->SetCoordinateSystemToViewport();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  mapper->SetTransformCoordinate(viewport);
  auto actor = vtkSmartPointer<vtkActor2D>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour.r, colour.g, colour.b);
  return actor;
}
}  // namespace

int Panel::caption(const std::string& words) {
  constexpr double letter_width = 9.0, line_height = 22;
  const auto room = std::size_t(std::max(12.0, (size().x() - 14) / letter_width));
  std::istringstream stream(words);
  std::vector<std::string> lines(1);
  for (std::string word; stream >> word;) {
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > room) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  for (std::size_t k = 0; k < lines.size(); ++k) {
    text({10, size().y() - 18 - line_height * double(k)}, lines[k], caption_letters + 1, black);
  }
  return int(lines.size());
}

void Panel::scale_bar(const Colour& colour) {
  // The largest round length up to a quarter of the panel.
  const double available = 0.25 * size().x() * mm_per_pixel();
  double length = 1;
  for (const double candidate : {2., 5., 10., 20., 50., 100., 200.}) {
    if (candidate <= available) length = candidate;
  }
  const double pixels = length / mm_per_pixel();
  const Vec2 right(size().x() - 22, 20), left = right - Vec2(pixels, 0);
  line(left, right, colour, 3);
  for (const Vec2& end : {left, right}) line(end - Vec2(0, 5), end + Vec2(0, 5), colour, 2);
  text(0.5 * (left + right) + Vec2(0, 16), std::to_string(int(length)) + " mm", caption_letters - 1,
       colour, Align::centre);
}

// Filled annuli, because wide lines of many short pieces would show gaps between them.
void Panel::ring(const Vec3& at, double radius, const Colour& colour) {
  constexpr double half_width = 1.3, rim = 1.0;  // pixels
  impl_->front->AddViewProp(annulus(to_pixel(at), radius - half_width - rim,
                                    radius + half_width + rim, black));
  impl_->front->AddViewProp(
      annulus(to_pixel(at), radius - half_width, radius + half_width, colour));
}

void Panel::arrow(const Vec3& from, const Vec3& to, const Colour& colour) {
  const Vec2 start = to_pixel(from), tip = to_pixel(to);
  if ((tip - start).norm() < 8) return;  // shorter than its own head
  const Vec2 along = (tip - start).normalized(), side(-along.y(), along.x());
  line(start, tip, colour, 2.2);
  path({tip - 10 * along + 4.5 * side, tip, tip - 10 * along - 4.5 * side}, colour, 2.2);
}

void Panel::compass() {
  struct Axis {
    Vec3 direction;
    const char* letter;
  };
  // The named end of each axis: patient's left, anterior, superior (LPS).
  const std::array<Axis, 3> axes = {{{{1, 0, 0}, "L"}, {{0, -1, 0}, "A"}, {{0, 0, 1}, "S"}}};
  const double arm = 30;
  Vec2 low(0, 0);
  for (const Axis& axis : axes) {
    low =
        low.cwiseMin(arm * Vec2(axis.direction.dot(impl_->right), axis.direction.dot(impl_->top)));
  }
  const Vec2 origin = Vec2(24, 24) - low;
  std::vector<std::pair<Vec2, std::string>> letters_at;
  for (const Axis& axis : axes) {
    const Vec2 shown(axis.direction.dot(impl_->right), axis.direction.dot(impl_->top));
    if (shown.norm() < 0.15) continue;  // points at or away from the viewer
    const Vec2 tip = origin + arm * shown;
    line(origin, tip, black, 2);
    const Vec2 along = shown.normalized(), side(-along.y(), along.x());
    line(tip, tip - 6 * along + 3.5 * side, black, 2);
    line(tip, tip - 6 * along - 3.5 * side, black, 2);
    // Along an oblique beam two axes may coincide: their letters then stand side by side.
    const Vec2 at = tip + 11 * along;
    const auto same = std::find_if(letters_at.begin(), letters_at.end(), [&](const auto& other) {
      return (other.first - at).norm() < 0.5 * caption_letters;
    });
    if (same != letters_at.end()) {
      same->second += axis.letter;
    } else {
      letters_at.emplace_back(at, axis.letter);
    }
  }
  for (const auto& [at, words] : letters_at)
    text(at, words, caption_letters - 1, black, Align::centre);
}

}  // namespace breast
