// The options of compression that have a small language of their own, from their text.
#pragma once

#include <optional>
#include <string>

#include "contact/elastic_wall.hpp"

namespace breast {

/// "fixed": none; "spring:NORMAL" or "spring:NORMAL,TANGENTIAL" in kPa/mm. Without the second: a
/// third of the first, as for a thin layer of incompressible elastic tissue whose sides are free
/// (E/h across, G/h = E/3h along). Throws Error (input) for anything else.
std::optional<WallSprings> parse_wall(const std::string& text);

/// mm by which the detector lifts the breast: "raised" infinite, "fixed" 0, or a number ≥ 0. Throws
/// Error (input) for anything else.
double parse_detector(const std::string& text);

}  // namespace breast
