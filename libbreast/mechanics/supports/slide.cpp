// SPDX-License-Identifier: GPL-3.0-or-later
// A breast that stays on the chest-wall surface and moves along it against springs. They need no
// direction: the surface carries their normal part.
#include "core/error.hpp"
#include "core/table.hpp"
#include "mechanics/supports/effects.hpp"
#include "mechanics/supports/supports.hpp"
#include "mechanics/terms/elastic_support.hpp"

namespace breast {

namespace {

class Slide final : public BodySupport {
 public:
  explicit Slide(double along) : BodySupport(SupportPlace::wall, "slide", {{"wall", along}}) {}

  std::string clause() const override {
    return message("the breast slides on the chest wall against ", stiffness(), " kPa per mm");
  }
  double stiffness() const override { return numbers()[0].value; }
  SupportPtr with_springs(double stiffness) const override {
    return wall_support("slide:" + format_number(stiffness));
  }
  bool slides() const override { return true; }
  void attach(const SupportSite& site, SupportEffects& effects) const override {
    if (!site.surface) {
      throw input_error(
          "--wall slide: the mesh has no chest-wall surface to slide on; run fit-hermite and "
          "hexmesh again, or use --wall held");
    }
    if (stiffness() == 0) return;
    effects.springs.push_back(
        {std::make_shared<ElasticSupport>(site.mesh, site.mesh.pectoral_faces,
                                          SupportStiffness{stiffness(), stiffness()}),
         {{"wall", 1}}});
  }
};

SupportPtr read(const SupportText& text) {
  text.expect(0, 1);
  return std::make_shared<Slide>(text.numbers.empty() ? usual_sliding_stiffness
                                                      : text.at_least_0(text.numbers[0], "KT"));
}

}  // namespace

const SupportKind& supports::slide() {
  static const SupportKind kind{{SupportPlace::wall}, "slide", "slide[:KT]",
                                "slide:0.01",         false,   read};
  return kind;
}

}  // namespace breast
