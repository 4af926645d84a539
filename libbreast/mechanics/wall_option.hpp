// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary conditions at the back of a breast: the chest wall, and the cut through the
// surrounding tissue.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mechanics/terms/elastic_support.hpp"
#include "surface/level_surface.hpp"

namespace breast {

enum class WallKind {
  held,    ///< all nodes of the chest wall stay in place
  slide,   ///< they stay on the wall surface and move along it against springs
  spring,  ///< springs normal and tangential to the wall
};

struct WallOption {
  WallKind kind = WallKind::held;
  SupportStiffness stiffness = {};  ///< slide: only `tangential` is used
  /// The surface on which the breast slides; null: that of the mesh's geometry.
  std::shared_ptr<const LevelSurface> surface = nullptr;

  WallOption() = default;
  WallOption(WallKind how, const SupportStiffness& springs) : kind(how), stiffness(springs) {}
  WallOption(const SupportStiffness& springs) : WallOption(WallKind::spring, springs) {}
};

enum class Cut {
  free,
  fixed,
  roller,  ///< slides on its mean plane
  spring,  ///< springs in all directions
  tissue,  ///< the same springs, and the weight of the tissue beyond (terms/tissue_beyond.hpp)
};

struct CutOption {
  Cut kind = Cut::free;
  double stiffness = 0;  ///< kPa/mm; spring and tissue only
  /// Stiffness of an attachment to the sternum, which only pulls, kPa/mm; none if absent.
  std::optional<double> sternal = {};

  bool has_springs() const { return kind == Cut::spring || kind == Cut::tissue; }

  CutOption(Cut how = Cut::free, double springs = 0, std::optional<double> at_sternum = {})
      : kind(how), stiffness(springs), sternal(at_sternum) {}
};

/// True if the wall has springs along it, against which the tissue beyond the cut rests, too.
inline bool carries_tissue_beyond(const WallOption& wall) {
  return wall.kind != WallKind::held && wall.stiffness.tangential > 0;
}

/// Resistance to sliding when none is given, kPa/mm.
inline constexpr double usual_sliding_stiffness = 0.01;

/// "held" ("fixed" of earlier versions), "slide", "slide:TANGENTIAL", "spring:NORMAL" or
/// "spring:NORMAL,TANGENTIAL", kPa/mm. If the second number of a spring is missing, its tangential
/// stiffness is a third of the normal one, as for a thin layer of incompressible elastic tissue
/// with free sides (E/h normal, G/h = E/3h tangential). Throws Error (input) for anything else.
WallOption parse_wall(const std::string& text);
/// "free", "fixed", "roller", "spring:STIFFNESS" or "spring:STIFFNESS,STERNAL" in kPa/mm, where the
/// second number is the stiffness of an attachment to the sternum, or the same with "tissue" instead of
/// "spring". Throws Error (input) otherwise.
CutOption parse_cut(const std::string& text);

/// The option's text as on a command line.
std::string describe(const WallOption& wall);
std::string describe(const CutOption& cut);

}  // namespace breast
