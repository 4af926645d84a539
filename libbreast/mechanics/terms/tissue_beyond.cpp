// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/terms/tissue_beyond.hpp"

#include "core/error.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"

namespace breast {

namespace {

/// KC h / KT, mm.
double length_beyond(const WallOption& wall, const CutOption& cut) {
  if (!carries_tissue_beyond(wall))
    throw input_error(
        "--cut ", describe(cut), " with --wall ", describe(wall),
        ": the tissue beyond the cut rests on the wall's supports; give slide:KT with "
        "KT above 0, or --cut spring:KC");
  return cut.stiffness * thickness_beyond / wall.stiffness.tangential;
}

}  // namespace

TissueBeyond::TissueBeyond(const HexMesh& mesh, const LevelSurface* wall, double density,
                           double length)
    : nodes_(nodes_of(mesh, mesh.cut_faces)) {
  if (wall == nullptr)
    throw input_error("--cut tissue: the mesh has no chest-wall surface; use --cut spring:KC");
  const std::vector<double> area = nodal_faces(mesh, mesh.cut_faces, flatten(mesh.imaged)).area;
  for (const int node : nodes_) {
    const Vec3& at = mesh.imaged[std::size_t(node)];
    const std::optional<Level> level = wall->at(at);
    if (!level)
      throw input_error("--cut tissue: node ", node, " of the cut at (", at.x(), ", ", at.y(), ", ",
                        at.z(), ") mm lies beyond the chest-wall surface; use --cut spring:KC");
    const Vec3 normal = level->gradient.normalized();
    mass_.push_back(density * length * area[std::size_t(node)] *
                    (Mat3::Identity() - normal * normal.transpose()));
  }
}

void TissueBeyond::add(const Vec3& gravity, Eigen::VectorXd& force) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    force.segment<3>(3L * nodes_[i]) += mass_[i] * gravity;
}

std::optional<TissueBeyond> tissue_at_cut(const HexMesh& mesh, const LevelSurface* wall,
                                          const MechanicsOptions& options) {
  if (options.cut.kind != Cut::tissue || mesh.cut_faces.empty()) return {};
  const double length = length_beyond(options.wall, options.cut);
  return TissueBeyond(mesh, wall, options.materials.density[std::size_t(Tissue::fat)], length);
}

}  // namespace breast
