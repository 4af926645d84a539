// SPDX-License-Identifier: GPL-3.0-or-later
// Writing of a 3D Slicer scene (.mrml) that opens files with chosen display settings.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace breast {

enum class SceneKind { volume, segmentation, model, transform, points, curve };

/// A file of the scene, named relative to it.
struct SceneItem {
  SceneKind kind = SceneKind::model;
  std::string name, file;
  bool visible = false;
  std::array<double, 3> colour{0.7, 0.7, 0.7};
  double opacity = 1;
  std::string description = {};
};

/// XML of MRML 4.4 and later: a node, its display and its storage for every item. The first volume
/// is the background of all slice views, and the second their foreground (faded out); positions are
/// LPS in every file.
std::string scene_xml(const std::vector<SceneItem>& items);

}  // namespace breast
