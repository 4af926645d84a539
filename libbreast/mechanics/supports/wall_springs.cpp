// SPDX-License-Identifier: GPL-3.0-or-later
// A breast on springs normal and tangential to the chest wall. If only the normal stiffness is given, the
// tangential one is a third of it, as for a thin layer of incompressible elastic tissue with free sides
// (E/h normal, G/h = E/3h tangential).
#include "core/error.hpp"
#include "core/table.hpp"
#include "mechanics/supports/effects.hpp"
#include "mechanics/supports/supports.hpp"
#include "mechanics/terms/elastic_support.hpp"

namespace breast {

namespace {

class WallSprings final : public BodySupport {
 public:
  WallSprings(double across, double along)
      : BodySupport(SupportPlace::wall, "spring", {{"wall", across}, {"wall", along}}) {}

  std::string clause() const override {
    return message("the breast rests on springs at the chest wall, ", numbers()[0].value,
                   " kPa per mm across it and ", stiffness(), " along it");
  }
  double stiffness() const override { return numbers()[1].value; }
  SupportPtr with_springs(double stiffness) const override {
    return wall_support("spring:" + format_number(numbers()[0].value) + "," +
                        format_number(stiffness));
  }
  bool follows_surface() const override { return true; }
  void attach(const SupportSite& site, SupportEffects& effects) const override {
    effects.springs.push_back({std::make_shared<ElasticSupport>(
                                   site.mesh, site.mesh.pectoral_faces,
                                   SupportStiffness{numbers()[0].value, stiffness()}, site.surface),
                               {{"wall", 1}}});
  }
};

SupportPtr read(const SupportText& text) {
  text.expect(1, 2);
  const double across = text.above_0(text.numbers[0], "KN");
  return std::make_shared<WallSprings>(
      across, text.numbers.size() == 2 ? text.at_least_0(text.numbers[1], "KT") : across / 3);
}

}  // namespace

const SupportKind& supports::wall_springs() {
  static const SupportKind kind{{SupportPlace::wall}, "spring", "spring:KN[,KT]",
                                "spring:0.5,0.2",     false,    read};
  return kind;
}

}  // namespace breast
