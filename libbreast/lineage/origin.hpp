// SPDX-License-Identifier: GPL-3.0-or-later
// Where the content of a file comes from, as far as the file says: its history, its side, its place
// in the frame of the scan.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/provenance.hpp"
#include "core/table.hpp"
#include "image/label_volume.hpp"
#include "mesh/hex_mesh.hpp"
#include "projection/mammogram.hpp"
#include "surface/hermite.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// The stages at which a chain of files can part, from the scan on: files that share a content of one
/// stage share those before it.
enum class Stage { scan, labels, geometry, mesh, reference, result };

/// What is known of a file. The pointers point into what the file contained, which must outlive it.
struct Origin {
  std::filesystem::path file;
  Stage stage = Stage::result;  ///< of this file itself
  std::string content_sha256 = {};
  const History* history = nullptr;
  std::string scan_sha256 =
      {};  ///< stated without a history: by a segmentation's tag or a table's column
  std::optional<Side> side = {};
  Eigen::AlignedBox3d place = {};   ///< mm, LPS, in the frame of the scan; empty if not known
  std::optional<Vec3> nipple = {};  ///< mm, LPS, in the frame of the scan
  const HexMesh* mesh = nullptr;
  const LabelVolume* labels = nullptr;
  std::string patient = {};  ///< DICOM's Patient ID
};

Origin origin_of(const std::filesystem::path& file, const HexMesh& mesh);
/// `states_side` is false for labels of another program, which contain no side.
Origin origin_of(const std::filesystem::path& file, const LabelVolume& labels,
                 bool states_side = true);
Origin origin_of(const std::filesystem::path& file, const BreastGeometry& geometry);
Origin origin_of(const std::filesystem::path& file, const Mammogram& image);
/// Of a surface or point set in the frame of the scan.
Origin origin_of(const std::filesystem::path& file, const TriMesh& surface);
Origin origin_of(const std::filesystem::path& file, const PolyLines& lines);
/// Of a scan with this content on this grid.
Origin origin_of_scan(const std::filesystem::path& file, const std::string& sha256,
                      const Grid& grid);
/// The column of a table of true landmarks that states the content of the scan.
inline constexpr const char* truth_scan_column = "scan_sha256";
/// Of the rows of one side of a table of true landmarks (phantom --truth, truth-table).
Origin origin_of_truth(const std::filesystem::path& file, const Table& truth, Side side);
/// Of points without a history, in the frame of the scan.
Origin origin_of_points(const std::filesystem::path& file, const std::vector<Vec3>& points);

}  // namespace breast
