// SPDX-License-Identifier: GPL-3.0-or-later
// All nodes stay in place: a held wall, and a fixed cut.
#include "mechanics/supports/supports.hpp"
#include "mesh/nodal.hpp"
#include "solve/constraints.hpp"

namespace breast {

namespace {

class Held final : public BodySupport {
 public:
  explicit Held(SupportPlace place)
      : BodySupport(place, place == SupportPlace::wall ? "held" : "fixed") {}

  std::string clause() const override {
    return place() == SupportPlace::wall
               ? "the breast is fixed everywhere on the chest wall, where "
                 "a living breast slides"
               : "its cut is fixed";
  }
  void constrain(const HexMesh& mesh, Constraints& constraints) const override {
    for (const int node : nodes_of(mesh, faces_at(mesh, place()))) constraints.hold(node);
  }
};

SupportPtr read(const SupportText& text) {
  text.expect(0, 0);
  return std::make_shared<Held>(text.place);
}

}  // namespace

const SupportKind& supports::held() {
  static const SupportKind kind{{SupportPlace::wall}, "held", "held", "held", false, read};
  return kind;
}

const SupportKind& supports::fixed() {
  static const SupportKind kind{{SupportPlace::cut}, "fixed", "fixed", "fixed", false, read};
  return kind;
}

}  // namespace breast
