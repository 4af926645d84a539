// SPDX-License-Identifier: GPL-3.0-or-later
// Report entries and doubts of hexmesh.
#pragma once

#include <string>
#include <vector>

#include "core/report.hpp"
#include "mesh/quality.hpp"
#include "meshing/body_mesh.hpp"
#include "meshing/tissue.hpp"

namespace breast {

/// Writes shape, volumes and landmarks of a mesh under the keys of docs/file-formats.md (elements,
/// min_scaled_jacobian, volumes_ml, landmarks).
void write_report(const HexMesh& mesh, const MeshQuality& quality, const BodyMeshReport& body,
                  const TissueReport& tissue, Report& report);
/// Warnings about elements so thin that solves will be slower.
std::vector<std::string> doubts(const MeshQuality& quality);

}  // namespace breast
