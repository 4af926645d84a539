// SPDX-License-Identifier: GPL-3.0-or-later
// The states of a breast on its way to a shape, as a time series: a folder with one mesh file (schema
// "mesh/1") a state, the table states.tsv, and states.vtkhdf.series, which ParaView opens as an
// animation; see docs/file-formats.md.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/table.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// A state as it stands in the table.
struct SeriesRow {
  /// Quantities of this state, with their units in the names; the first is its place on the way, which
  /// ParaView shows as time and which grows from state to state. The same names for all states. A value that
  /// is not finite is not known, its cell empty.
  std::vector<std::pair<std::string, double>> quantities;
  SolveStatus status = SolveStatus::not_converged;
  double residual = 0;  ///< relative to the load
  int iterations = 0;
  std::string reason;  ///< empty if converged
};

/// The folder NAME-states beside NAME.vtkhdf.
std::filesystem::path series_folder(const std::filesystem::path& output);
/// Throws Error (input) if the folder exists and holds anything but a series of ours.
void check_series_folder(const std::filesystem::path& folder);
/// Removes a series that belonged to an older output; nothing if there is none, or if the folder holds
/// anything else.
void remove_series(const std::filesystem::path& folder);

class StateSeries {
 public:
  /// `landmarks`: those whose places the table has. Throws Error (input) as check_series_folder.
  StateSeries(const std::filesystem::path& folder, std::vector<Landmark> landmarks);

  /// Writes the next state. `mesh` is null if it has no shape: then it has a row, and no file.
  void add(const SeriesRow& row, const HexMesh* mesh);
  /// Puts the series in the place of an older one. Throws Error (failed) naming the folder.
  void commit();

 private:
  std::filesystem::path folder_;
  AtomicFolder files_;
  Table table_;
  std::vector<Landmark> landmarks_;
  std::string files_and_times_;  // lines of the series
};

}  // namespace breast
