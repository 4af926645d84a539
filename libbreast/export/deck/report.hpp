// SPDX-License-Identifier: GPL-3.0-or-later
// Report entries of export-deck about an exported model and another program's solution.
#pragma once

#include <string>

#include "core/report.hpp"
#include "core/table.hpp"
#include "export/deck/results.hpp"
#include "export/deck/scene.hpp"

namespace breast {

/// Reports elements, nodes and held nodes of an input file; `element` is the name of its element
/// type.
void write_report(const DeckScene& scene, const std::string& element, Report& report);

/// Writes the balance of weight and `reaction` (µN), which must vanish, relative to the weight.
/// Writes nothing for a scene with rollers, because `reaction` does not include their part.
void write_balance(const DeckScene& scene, const Vec3& reaction, Report& report);

/// Distance between two shapes of `mesh`, also as a table of one row.
Table write_difference(const NodeDifference& difference, const HexMesh& mesh, Report& report);

}  // namespace breast
