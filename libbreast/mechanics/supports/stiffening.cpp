// SPDX-License-Identifier: GPL-3.0-or-later
// Springs that stiffen, as an addition to any support with springs: fascia and skin give way at first and
// then stop. With the displacement r = |x − X| from the stress-free place, the energy per area of a spring
// of the stiffness k along the wall becomes
//
//     ½ k r² + ¼ k r⁴ / L²,
//
// so that its force k r (1 + r²/L²) is twice that of the plain spring at the length L. Where wall and cut
// stiffen over the same L, the weight of the tissue beyond the cut remains that of plain springs: k cancels
// in it, and so does the factor by which both are stiffer at the place to which the layer moves.
#include "core/error.hpp"
#include "core/units.hpp"
#include "mechanics/supports/effects.hpp"
#include "mechanics/supports/supports.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"

namespace breast {

namespace {

/// The part ¼ k r⁴ / L².
class StiffeningSprings final : public NodeSprings {
 public:
  StiffeningSprings(const HexMesh& mesh, const std::vector<Face>& faces, double stiffness,
                    double length) {
    const NodalFaces spread = nodal_faces(mesh, faces, flatten(mesh.imaged));
    cells_.nodes = nodes_of(mesh, faces);
    for (const int node : cells_.nodes) {
      factor_.push_back(stiffness * spread.area[std::size_t(node)] * pascal_per_kilopascal /
                        (length * length));
    }
  }

  std::string name() const override { return "stiffening springs"; }

 private:
  std::optional<Spring> spring(const State& state, int i) const override {
    const long at = 3L * cells_.nodes[std::size_t(i)];
    const double factor = factor_[std::size_t(i)];
    const Vec3 moved = state.x.segment<3>(at) - state.reference.segment<3>(at);
    const double square = moved.squaredNorm();
    Spring out;
    out.energy = 0.25 * factor * square * square;
    out.force = factor * square * moved;
    out.tangent = factor * (square * Mat3::Identity() + 2 * moved * moved.transpose());
    out.by_reference = -out.tangent;
    return out;
  }

  std::vector<double> factor_;  // µN/mm³: k A / L²
};

std::vector<SupportNumber> with_length(const BodySupport& plain, double length) {
  std::vector<SupportNumber> numbers = plain.numbers();
  numbers.push_back({std::string(place_name(plain.place())) + ".L", length, "mm", "L"});
  return numbers;
}

class Stiffening final : public BodySupport {
 public:
  Stiffening(SupportPtr plain, double length)
      : BodySupport(plain->place(), plain->kind(), with_length(*plain, length)),
        plain_(std::move(plain)) {}

  std::string clause() const override {
    return message(plain_->clause(), ", springs that are twice as stiff at ", length(), " mm");
  }
  double stiffness() const override { return plain_->stiffness(); }
  SupportPtr beside(const BodySupport& wall) const override {
    const SupportPtr rest = plain_->beside(wall);
    return rest ? std::make_shared<Stiffening>(rest, length()) : nullptr;
  }
  bool slides() const override { return plain_->slides(); }
  bool follows_surface() const override { return plain_->follows_surface(); }
  void constrain(const HexMesh& mesh, Constraints& constraints) const override {
    plain_->constrain(mesh, constraints);
  }
  void attach(const SupportSite& site, SupportEffects& effects) const override {
    plain_->attach(site, effects);
    const std::string stiffness_name = place_name(place());
    effects.springs.push_back({std::make_shared<StiffeningSprings>(
                                   site.mesh, faces_at(site.mesh, place()), stiffness(), length()),
                               {{stiffness_name, 1}, {stiffness_name + ".L", -2}}});
  }

 private:
  double length() const { return numbers().back().value; }

  SupportPtr plain_;
};

SupportPtr read(const SupportText& text) {
  SupportText rest = text;
  const double length = text.above_0(text.named.at("L"), "L");
  rest.named.erase("L");
  const SupportPtr plain = read_support(rest);
  if (!(plain->stiffness() > 0)) text.refuse("there are no springs to stiffen");
  return std::make_shared<Stiffening>(plain, length);
}

}  // namespace

const SupportKind& supports::stiffening() {
  static const SupportKind kind{
      {SupportPlace::wall, SupportPlace::cut}, "L", "L=MM", "L=20", true, read};
  return kind;
}

}  // namespace breast
