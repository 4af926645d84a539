// SPDX-License-Identifier: GPL-3.0-or-later
// What holds a breast at its back: the support of the chest wall, and that of the cut through the
// surrounding tissue. Every support is one file of this folder and one line of its registry
// (supports.hpp); whatever needs one asks it through this interface.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/hex_mesh.hpp"
#include "mesh/nodal_faces.hpp"

namespace breast {

class Constraints;
struct SupportSite;
struct SupportEffects;

enum class SupportPlace { wall, cut };
/// "wall" and "cut".
const char* place_name(SupportPlace place);
/// The faces of the chest wall or of the cut.
const std::vector<Face>& faces_at(const HexTopology& mesh, SupportPlace place);

/// A number of a support. Numbers with the same parameter change together.
struct SupportNumber {
  /// "wall", "cut", "sternum", ...: also a parameter of a material set. Empty: a number of the support's
  /// law that is chosen, not varied.
  std::string parameter;
  double value = 0;
  std::string unit = "kPa/mm";
  std::string key = {};  ///< it is written as KEY=NUMBER; empty: it has a fixed place
};

/// Springs of one stiffness on all faces of a support.
struct SpringShare {
  double stiffness = 0;   ///< kPa/mm along the wall, for small displacements
  std::string parameter;  ///< of the stiffness
  FaceWeight share =
      {};  ///< of the stiffness, that a place of the imaged faces has; empty: all of it
};

class BodySupport;
using SupportPtr = std::shared_ptr<const BodySupport>;

class BodySupport {
 public:
  virtual ~BodySupport() = default;

  SupportPlace place() const { return place_; }
  const std::string& kind() const { return kind_; }  ///< "slide"
  /// The text as on a command line: KIND, or KIND:NUMBER,...,KEY=NUMBER. Numbers read back exactly.
  std::string text() const;
  /// Describes the support in a clause: "the breast slides on the chest wall against 0.01 kPa per mm".
  virtual std::string clause() const = 0;

  const std::vector<SupportNumber>& numbers() const { return numbers_; }
  /// The names of its parameters that are not zero.
  std::vector<std::string> parameters() const;
  /// The same support with other numbers.
  SupportPtr with_numbers(const std::function<double(const SupportNumber&)>& value) const;
  /// With the numbers of one parameter, or all stiffnesses, multiplied.
  SupportPtr scaled(std::string_view parameter, double factor) const;
  SupportPtr stiffened(double factor) const;

  /// Stiffness of its springs along the wall for small displacements, kPa/mm; 0 without springs.
  virtual double stiffness() const { return 0; }
  /// Its springs on a mesh; together they have `stiffness()` unless it differs from place to place.
  virtual std::vector<SpringShare> springs(const HexMesh&) const {
    return {{stiffness(), place_name(place_), {}}};
  }
  /// A support of this kind, or of the nearest one, that has springs of this stiffness (kPa/mm); null if
  /// the support holds the body anyway.
  virtual SupportPtr with_springs(double) const { return nullptr; }
  /// What remains of it beside this support of the chest wall; null if all of it does.
  virtual SupportPtr beside(const BodySupport&) const { return nullptr; }

  /// Whether its nodes stay on the chest-wall surface.
  virtual bool slides() const { return false; }
  /// Whether its forces depend on the chest-wall surface, or on normals in its place.
  virtual bool follows_surface() const { return slides(); }
  /// Adds the constraints that do not depend on the deformed shape.
  virtual void constrain(const HexMesh&, Constraints&) const {}
  /// Adds its terms and loads with their derivatives. Throws Error (input) if it cannot stand there.
  virtual void attach(const SupportSite&, SupportEffects&) const {}

 protected:
  BodySupport(SupportPlace place, std::string kind, std::vector<SupportNumber> numbers = {})
      : place_(place), kind_(std::move(kind)), numbers_(std::move(numbers)) {}

 private:
  SupportPlace place_;
  std::string kind_;
  std::vector<SupportNumber> numbers_;
};

/// A support's text in its parts.
struct SupportText {
  SupportPlace place;
  std::string whole, kind;
  std::vector<double> numbers;
  std::map<std::string, double> named;  ///< by their KEY

  /// Error (input) that names the option, the text and the reason.
  [[noreturn]] void refuse(const std::string& reason) const;
  /// Throws Error (input) unless there are `least` to `most` numbers without a key.
  void expect(std::size_t least, std::size_t most) const;
  /// Throws Error (input) unless the number called `name` is at least 0, or above 0.
  double at_least_0(double value, const char* name) const;
  double above_0(double value, const char* name) const;
};

/// How a support is read.
struct SupportKind {
  std::vector<SupportPlace> places;
  std::string_view name;     ///< KIND, or the KEY of an addition
  std::string_view form;     ///< in messages: "slide[:KT]"
  std::string_view example;  ///< "slide:0.01"; of an addition: what is added
  bool addition;             ///< it is written as KEY=NUMBER in the text of another support
  SupportPtr (*read)(const SupportText& text);
  std::vector<std::string_view> keys = {};  ///< of numbers that may follow as KEY=NUMBER
};
const std::vector<const SupportKind*>& support_kinds();

/// The support that a text stands for. Throws Error (input) naming the forms.
SupportPtr read_support(SupportPlace place, const std::string& text);
SupportPtr read_support(const SupportText& text);
inline SupportPtr wall_support(const std::string& text) {
  return read_support(SupportPlace::wall, text);
}
inline SupportPtr cut_support(const std::string& text) {
  return read_support(SupportPlace::cut, text);
}
/// A held wall and a free cut.
const SupportPtr& default_support(SupportPlace place);

/// Resistance to sliding when none is given, kPa/mm.
inline constexpr double usual_sliding_stiffness = 0.01;

}  // namespace breast
