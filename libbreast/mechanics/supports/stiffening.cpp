// SPDX-License-Identifier: GPL-3.0-or-later
// Springs that stiffen, as an addition to any support with springs: fascia and skin give way at first and
// then stop. With the displacement r = |x − X| from the stress-free place, the force of a spring of the
// stiffness k along the wall becomes
//
//     k r (1 + (r/L)^p),
//
// twice that of the plain spring at the length L; its energy per area is ½ k r² + k r² (r/L)^p / (p + 2). The
// exponent p is 2 unless the text gives another. Where wall and cut stiffen over the same L, the weight of the
// tissue beyond the cut remains that of plain springs: k cancels in it, and so does the factor by which both
// are stiffer at the place to which the layer moves.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "mechanics/supports/effects.hpp"
#include "mechanics/supports/supports.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"

namespace breast {

namespace {

constexpr double usual_exponent = 2;

/// The part k r² (r/L)^p / (p + 2).
class StiffeningSprings final : public NodeSprings {
 public:
  StiffeningSprings(const HexMesh& mesh, const std::vector<Face>& faces, const SpringShare& springs,
                    double length, double exponent)
      : length_(length), exponent_(exponent) {
    const NodalFaces spread = nodal_faces(mesh, faces, flatten(mesh.imaged), springs.share);
    cells_.nodes = nodes_of(mesh, faces);
    for (const int node : cells_.nodes) {
      stiffness_.push_back(springs.stiffness * spread.area[std::size_t(node)] *
                           pascal_per_kilopascal);
    }
  }

  std::string name() const override { return "stiffening springs"; }

 private:
  std::optional<Spring> spring(const State& state, int i) const override {
    const long at = 3L * cells_.nodes[std::size_t(i)];
    const Vec3 moved = state.x.segment<3>(at) - state.reference.segment<3>(at);
    const double square = moved.squaredNorm();
    Spring out;
    if (square == 0) return out;
    const double share = exponent_ == 2 ? square / (length_ * length_)
                                        : std::pow(std::sqrt(square) / length_, exponent_);
    const double factor = stiffness_[std::size_t(i)] * share;
    out.energy = factor * square / (exponent_ + 2);
    out.force = factor * moved;
    out.tangent = factor * (Mat3::Identity() + exponent_ / square * moved * moved.transpose());
    out.by_reference = -out.tangent;
    return out;
  }

  double length_, exponent_;       // mm, 1
  std::vector<double> stiffness_;  // µN/mm: k A
};

std::vector<SupportNumber> with_law(const BodySupport& plain, double length, double exponent) {
  std::vector<SupportNumber> numbers = plain.numbers();
  numbers.push_back({std::string(place_name(plain.place())) + ".L", length, "mm", "L"});
  if (exponent != usual_exponent) numbers.push_back({"", exponent, "1", "P"});
  return numbers;
}

class Stiffening final : public BodySupport {
 public:
  Stiffening(SupportPtr plain, double length, double exponent)
      : BodySupport(plain->place(), plain->kind(), with_law(*plain, length, exponent)),
        plain_(std::move(plain)),
        length_(length),
        exponent_(exponent) {}

  std::string clause() const override {
    return message(plain_->clause(), ", springs that are twice as stiff at ", length_, " mm") +
           (exponent_ == usual_exponent
                ? ""
                : message(", stiffening with the power ", exponent_, " of the displacement"));
  }
  double stiffness() const override { return plain_->stiffness(); }
  std::vector<SpringShare> springs(const HexMesh& mesh) const override {
    return plain_->springs(mesh);
  }
  SupportPtr beside(const BodySupport& wall) const override {
    const SupportPtr rest = plain_->beside(wall);
    return rest ? std::make_shared<Stiffening>(rest, length_, exponent_) : nullptr;
  }
  bool slides() const override { return plain_->slides(); }
  bool follows_surface() const override { return plain_->follows_surface(); }
  void constrain(const HexMesh& mesh, Constraints& constraints) const override {
    plain_->constrain(mesh, constraints);
  }
  void attach(const SupportSite& site, SupportEffects& effects) const override {
    plain_->attach(site, effects);
    const std::string length_name = std::string(place_name(place())) + ".L";
    const std::vector<Face>& faces = faces_at(site.mesh, place());
    for (const SpringShare& part : springs(site.mesh)) {
      if (!(part.stiffness > 0)) continue;
      effects.springs.push_back(
          {std::make_shared<StiffeningSprings>(site.mesh, faces, part, length_, exponent_),
           {{part.parameter, 1}, {length_name, -exponent_}}});
    }
  }

 private:
  SupportPtr plain_;
  double length_, exponent_;
};

SupportPtr read(const SupportText& text) {
  SupportText rest = text;
  const double length = text.above_0(text.named.at("L"), "L");
  rest.named.erase("L");
  double exponent = usual_exponent;
  if (const auto given = text.named.find("P"); given != text.named.end()) {
    exponent = given->second;
    if (!(exponent >= 1 && exponent <= 12))
      text.refuse(message("P ", exponent, " must lie between 1 and 12"));
    rest.named.erase("P");
  }
  const SupportPtr plain = read_support(rest);
  const bool stiffens =
      std::any_of(plain->numbers().begin(), plain->numbers().end(),
                  [](const SupportNumber& one) { return one.unit == "kPa/mm" && one.value > 0; });
  if (plain->stiffness() == 0 && !stiffens) text.refuse("there are no springs to stiffen");
  return std::make_shared<Stiffening>(plain, length, exponent);
}

}  // namespace

const SupportKind& supports::stiffening() {
  static const SupportKind kind{
      {SupportPlace::wall, SupportPlace::cut}, "L", "L=MM[,P=EXPONENT]", "L=20", true, read};
  return kind;
}

}  // namespace breast
