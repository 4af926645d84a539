// SPDX-License-Identifier: GPL-3.0-or-later
// A cut on springs of the stiffness k per area in all directions. The medial and superior borders of a
// breast are fixed, the lateral and inferior ones mobile (Mercer et al. 2015), so that each border may have
// a stiffness of its own: a place of the imaged cut that is seen in the direction u from the middle of the
// cut's box in the coronal plane, in units of its half widths, has the share max(0, u·m)² / |u|² of that of the
// border in the direction m. The shares add up to one, and the stiffness changes gradually along the rim; where it
// jumps, elements fold between a node that is held and its neighbour that is not. Skin and fascia are attached to the sternum: such an attachment has the stiffness
// s t², where t = max(0, n·m) for the outward normal n of an imaged face and the direction m to the
// sternum.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "core/table.hpp"
#include "mechanics/supports/effects.hpp"
#include "mechanics/supports/supports.hpp"
#include "mechanics/terms/attachment.hpp"
#include "mechanics/terms/elastic_support.hpp"
#include "surface/rim_border.hpp"

namespace breast {

namespace {

constexpr std::array<RimBorder, n_rim_borders> borders{RimBorder::medial, RimBorder::superior,
                                                       RimBorder::lateral, RimBorder::inferior};

std::string parameter_at(RimBorder border) {
  return "cut." + std::string(border_name(border));
}

class CutSprings final : public BodySupport {
 public:
  explicit CutSprings(std::vector<SupportNumber> stiffnesses)
      : BodySupport(SupportPlace::cut, "spring", std::move(stiffnesses)) {}

  std::string clause() const override;
  double stiffness() const override { return numbers()[0].value; }
  std::vector<SpringShare> springs(const HexMesh& mesh) const override;
  void attach(const SupportSite& site, SupportEffects& effects) const override;

 private:
  const SupportNumber* number(const std::string& parameter) const {
    const auto found =
        std::find_if(numbers().begin(), numbers().end(),
                     [&](const SupportNumber& one) { return one.parameter == parameter; });
    return found == numbers().end() ? nullptr : &*found;
  }
};

std::string CutSprings::clause() const {
  std::string text = message("its cut rests on springs of ", stiffness(), " kPa per mm");
  for (const RimBorder border : borders) {
    if (const SupportNumber* own = number(parameter_at(border)))
      text += message(", at the ", border_name(border), " border of ", own->value);
  }
  if (const SupportNumber* sternum = number("sternum"))
    text += message(" and is attached to the sternum with ", sternum->value, " kPa per mm");
  return text;
}

// The direction out of the breast at a border, in the coronal plane.
Vec3 outward(RimBorder border, Side side) {
  switch (border) {
    case RimBorder::medial:
      return {-lateral_sign(side), 0, 0};
    case RimBorder::lateral:
      return {lateral_sign(side), 0, 0};
    case RimBorder::superior:
      return {0, 0, 1};
    default:
      return {0, 0, -1};
  }
}

std::vector<SpringShare> CutSprings::springs(const HexMesh& mesh) const {
  if (std::none_of(borders.begin(), borders.end(),
                   [&](RimBorder border) { return number(parameter_at(border)) != nullptr; })) {
    return BodySupport::springs(mesh);
  }
  Eigen::AlignedBox3d box;
  for (const int node : nodes_of(mesh, mesh.cut_faces)) box.extend(mesh.imaged[std::size_t(node)]);
  const Vec3 middle = box.center(), half = 0.5 * box.sizes();
  std::vector<SpringShare> all;
  for (const RimBorder border : borders) {
    const SupportNumber* own = number(parameter_at(border));
    const SupportNumber& stiffness = own != nullptr ? *own : numbers()[0];
    const Vec3 out = outward(border, mesh.side);
    all.push_back({stiffness.value, stiffness.parameter, [=](const Vec3& at, const Vec3&) {
                     const double x = (at - middle).x() / half.x(),
                                  z = (at - middle).z() / half.z();
                     const double t = std::max(0.0, out.x() * x + out.z() * z);
                     return t * t / (x * x + z * z);
                   }});
  }
  return all;
}

void CutSprings::attach(const SupportSite& site, SupportEffects& effects) const {
  const HexMesh& mesh = site.mesh;
  for (const SpringShare& part : springs(mesh)) {
    if (!(part.stiffness > 0)) continue;
    const SupportStiffness around{part.stiffness, part.stiffness};
    effects.springs.push_back(
        {std::make_shared<ElasticSupport>(mesh, mesh.cut_faces, around, nullptr, part.share),
         {{part.parameter, 1}}});
  }
  const SupportNumber* sternum = number("sternum");
  if (sternum == nullptr) return;
  const Vec3 medial(-lateral_sign(mesh.side), 0, 0);
  const auto factor = [&medial](const Vec3&, const Vec3& normal) {
    const double t = std::max(0.0, medial.dot(normal));
    return t * t;
  };
  effects.springs.push_back(
      {std::make_shared<Attachment>(mesh, mesh.cut_faces, sternum->value, medial, factor),
       {{"sternum", 1}}});
}

SupportPtr read(const SupportText& text) {
  text.expect(1, 2);
  const bool alone = text.numbers.size() == 1 && text.named.empty();
  std::vector<SupportNumber> numbers{{"cut", alone ? text.above_0(text.numbers[0], "KC")
                                                   : text.at_least_0(text.numbers[0], "KC")}};
  if (text.numbers.size() == 2) numbers.push_back({"sternum", text.above_0(text.numbers[1], "KS")});
  for (const RimBorder border : borders) {
    const std::string key(border_name(border));
    const auto own = text.named.find(key);
    if (own == text.named.end()) continue;
    numbers.push_back(
        {parameter_at(border), text.at_least_0(own->second, key.c_str()), "kPa/mm", key});
  }
  return std::make_shared<CutSprings>(numbers);
}

}  // namespace

const SupportKind& supports::cut_springs() {
  static const SupportKind kind{
      {SupportPlace::cut},
      "spring",
      "spring:KC[,KS][,medial=K][,superior=K][,lateral=K][,inferior=K]",
      "spring:0.01,0.4",
      false,
      read,
      {border_name(RimBorder::medial), border_name(RimBorder::superior),
       border_name(RimBorder::lateral), border_name(RimBorder::inferior)}};
  return kind;
}

}  // namespace breast
