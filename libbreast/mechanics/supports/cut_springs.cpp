// SPDX-License-Identifier: GPL-3.0-or-later
// A cut on springs of the stiffness k per area in all directions. Skin and fascia are attached to the
// sternum, whereas the tissue around the rest of the breast is loose: an attachment to it has the
// stiffness s t², where t = max(0, n·m) for the outward normal n of an imaged face and the direction m to
// the sternum.
#include <algorithm>

#include "core/error.hpp"
#include "mechanics/supports/effects.hpp"
#include "mechanics/supports/supports.hpp"
#include "mechanics/terms/attachment.hpp"
#include "mechanics/terms/elastic_support.hpp"

namespace breast {

namespace {

class CutSprings final : public BodySupport {
 public:
  explicit CutSprings(std::vector<SupportNumber> stiffnesses)
      : BodySupport(SupportPlace::cut, "spring", std::move(stiffnesses)) {}

  std::string clause() const override {
    std::string text = message("its cut rests on springs of ", stiffness(), " kPa per mm");
    if (numbers().size() > 1) {
      text += message(" and is attached to the sternum with ", numbers()[1].value, " kPa per mm");
    }
    return text;
  }
  double stiffness() const override { return numbers()[0].value; }
  void attach(const SupportSite& site, SupportEffects& effects) const override;
};

void CutSprings::attach(const SupportSite& site, SupportEffects& effects) const {
  const HexMesh& mesh = site.mesh;
  if (stiffness() > 0) {
    const SupportStiffness around{stiffness(), stiffness()};
    effects.springs.push_back(
        {std::make_shared<ElasticSupport>(mesh, mesh.cut_faces, around), {{"cut", 1}}});
  }
  if (numbers().size() == 1) return;
  const Vec3 medial(-lateral_sign(mesh.side), 0, 0);
  const auto factor = [&medial](const Vec3& normal) {
    const double t = std::max(0.0, medial.dot(normal));
    return t * t;
  };
  effects.springs.push_back(
      {std::make_shared<Attachment>(mesh, mesh.cut_faces, numbers()[1].value, medial, factor),
       {{"sternum", 1}}});
}

SupportPtr read(const SupportText& text) {
  text.expect(1, 2);
  if (text.numbers.size() == 1) {
    return std::make_shared<CutSprings>(
        std::vector<SupportNumber>{{"cut", text.above_0(text.numbers[0], "KC")}});
  }
  return std::make_shared<CutSprings>(
      std::vector<SupportNumber>{{"cut", text.at_least_0(text.numbers[0], "KC")},
                                 {"sternum", text.above_0(text.numbers[1], "KS")}});
}

}  // namespace

const SupportKind& supports::cut_springs() {
  static const SupportKind kind{{SupportPlace::cut}, "spring", "spring:KC[,KS]",
                                "spring:0.01,0.4",   false,    read};
  return kind;
}

}  // namespace breast
