// SPDX-License-Identifier: GPL-3.0-or-later
// Implementation of the canvas, shared by its source files only, because it exposes VTK.
#pragma once

#include <vtkLightKit.h>
#include <vtkNew.h>
#include <vtkProp.h>
#include <vtkRenderer.h>

#include "figures/canvas.hpp"

namespace breast {

/// Pictures are drawn larger by this factor and averaged, for smooth edges also of translucent
/// surfaces.
inline constexpr int supersampling = 2;

struct Panel::Impl {
  vtkNew<vtkRenderer> renderer, front;  ///< `front` is drawn over `renderer` with the same camera
  vtkNew<vtkLightKit> lights, front_lights;
  bool through = false;
  Vec2 pixels{1, 1};
  std::vector<Vec3> shown;  ///< points the camera must see
  Vec3 forward{0, 0, -1}, right{1, 0, 0}, top{0, 1, 0}, centre{0, 0, 0};
  double height_mm = 1;

  void extend(const Vec3& x) { shown.push_back(x); }
  void add(vtkProp* prop) { (through ? front : renderer)->AddViewProp(prop); }
  void add(vtkProp* prop, const std::vector<Vec3>& points) {
    add(prop);
    shown.insert(shown.end(), points.begin(), points.end());
  }
};

}  // namespace breast
