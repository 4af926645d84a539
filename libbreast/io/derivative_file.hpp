// A mesh file with derivatives beside its shapes (sensitivity); see docs/file-formats.md.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/mesh_file.hpp"

namespace breast {

struct Derivatives {
  /// ∂points/∂parameter per node, by parameter: mm per relative change, degree or mm.
  std::map<std::string, std::vector<Vec3>> position;
  /// ∂(displacement of a landmark, mm)/∂(ln stiffness of the element), by landmark.
  std::map<std::string, std::vector<double>> influence;
};

/// As write_mesh, with the arrays; other readers of the file are not disturbed by them.
void write_mesh(const std::filesystem::path& file, const HexMesh& mesh,
                const Derivatives& derivatives);

/// The arrays of a file of `mesh`; empty when there are none. Throws Error (input) for wrong
/// shapes.
Derivatives read_derivatives(const std::filesystem::path& file, const HexMesh& mesh);

}  // namespace breast
