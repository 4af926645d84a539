// SPDX-License-Identifier: GPL-3.0-or-later
// A cut on springs that also carries the weight of the tissue beyond, which hangs on the body.
//
// A layer of the thickness h rests on the wall's supports of the stiffness KT per area. Far from the cut,
// gravity g moves it along the wall by ρ h g_t / KT, where g_t is the part of g along the wall. Springs of
// the stiffness KC per area at the cut pull the body towards the place to which the layer would move by
// itself, not to its stress-free place, so that they exert the additional traction
//
//     KC ρ h g_t / KT
//
// on the cut: the weight of a layer of the length KC h / KT. It does not depend on the deformed shape. h is
// a property of the body, not of the place of the cut, so that a cut farther out carries the same.
#include "core/error.hpp"
#include "mechanics/supports/effects.hpp"
#include "mechanics/supports/supports.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"

namespace breast {

namespace {

constexpr double thickness_beyond = 20;  // h, of the tissue around a breast, mm

class TissueBeyond final : public BodySupport {
 public:
  explicit TissueBeyond(SupportPtr springs)
      : BodySupport(SupportPlace::cut, "tissue", springs->numbers()),
        springs_(std::move(springs)) {}

  std::string clause() const override {
    return springs_->clause() + " and carries the weight of the tissue beyond";
  }
  double stiffness() const override { return springs_->stiffness(); }
  SupportPtr beside(const BodySupport& wall) const override {
    return wall.stiffness() > 0 ? nullptr : springs_;
  }
  void attach(const SupportSite& site, SupportEffects& effects) const override {
    springs_->attach(site, effects);
    check(site);
    for (const SpringShare& part : springs(site.mesh)) effects.loads.push_back(weight(site, part));
  }
  std::vector<SpringShare> springs(const HexMesh& mesh) const override {
    return springs_->springs(mesh);
  }

 private:
  void check(const SupportSite& site) const;
  SupportLoad weight(const SupportSite& site, const SpringShare& part) const;

  SupportPtr springs_;
};

void TissueBeyond::check(const SupportSite& site) const {
  if (!(site.wall.stiffness() > 0))
    throw input_error(
        "--cut ", text(), " with --wall ", site.wall.text(),
        ": the tissue beyond the cut rests on the wall's supports; give slide:KT with "
        "KT above 0, or --cut spring:KC");
  if (!site.surface)
    throw input_error("--cut tissue: the mesh has no chest-wall surface; use --cut spring:KC");
}

SupportLoad TissueBeyond::weight(const SupportSite& site, const SpringShare& part) const {
  const HexMesh& mesh = site.mesh;
  const double length = part.stiffness * thickness_beyond / site.wall.stiffness();
  const std::vector<double> area =
      nodal_faces(mesh, mesh.cut_faces, flatten(mesh.imaged), part.share).area;
  SupportLoad load;
  load.powers = {{part.parameter, 1}, {"wall", -1}};
  load.nodes = nodes_of(mesh, mesh.cut_faces);
  for (const int node : load.nodes) {
    const Vec3& at = mesh.imaged[std::size_t(node)];
    const std::optional<Level> level = site.surface->at(at);
    if (!level)
      throw input_error("--cut tissue: node ", node, " of the cut at (", at.x(), ", ", at.y(), ", ",
                        at.z(), ") mm lies beyond the chest-wall surface; use --cut spring:KC");
    const Vec3 normal = level->gradient.normalized();
    load.mass.push_back(site.density * length * area[std::size_t(node)] *
                        (Mat3::Identity() - normal * normal.transpose()));
  }
  return load;
}

SupportPtr read(const SupportText& text) {
  SupportText springs = text;
  springs.kind = "spring";
  return std::make_shared<TissueBeyond>(supports::cut_springs().read(springs));
}

}  // namespace

const SupportKind& supports::tissue() {
  static const SupportKind kind{
      {SupportPlace::cut},         "tissue", "tissue:KC[,KS][,medial=K]...",
      "tissue:0.01,0.4",           false,    read,
      supports::cut_springs().keys};
  return kind;
}

}  // namespace breast
