// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/stability/remedy.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"

namespace breast {

namespace {

// Sizes of changes are logarithms of ratios: 2 %, a third, a hundredfold.
constexpr double smallest = 0.02, usual = 0.3, largest = 4.6;
// A change is determined to this relative accuracy; another one is better only if it is smaller by
// as much.
constexpr double resolution = 0.1;

double* stiffness_of(MechanicsOptions& options, Changed what) {
  return what == Changed::wall ? &options.wall.stiffness.tangential : &options.cut.stiffness;
}

// A candidate and its direction, since skin may be too stiff as well as too soft.
struct Candidate {
  Changed what;
  double sign = 1;
};

std::vector<Candidate> candidates(const HexMesh& mesh, const MechanicsOptions& options) {
  std::vector<Candidate> all{{Changed::tissue}};
  const bool layer = std::count(mesh.tissue.begin(), mesh.tissue.end(), Tissue::skin) > 0;
  if (layer || (mesh.skin_model == SkinModel::membrane && !mesh.skin_faces.empty())) {
    all.push_back({Changed::skin, -1});
    all.push_back({Changed::skin, 1});
  }
  if (options.wall.kind != WallKind::held) all.push_back({Changed::wall});
  const Cut cut = options.cut.kind;
  if (!mesh.cut_faces.empty() && (cut == Cut::free || options.cut.has_springs())) {
    all.push_back({Changed::cut});
  }
  return all;
}

class Search {
 public:
  Search(const MechanicsOptions& options, const Stands& stands)
      : options_(options), stands_(stands) {}

  /// The smallest size below `bound` that gives a stable solution; none if even `bound` does not.
  std::optional<double> below(const Candidate& candidate, double bound) const {
    const double most = (1 - resolution) * bound;
    if (!stands(candidate, most)) return {};
    return refine(candidate, 0, most);
  }
  /// The smallest size of all, searched from `guess` on.
  std::optional<double> from(const Candidate& candidate, double guess) const {
    double fails = 0, does = std::clamp(guess, smallest, largest);
    while (!stands(candidate, does)) {
      if (does == largest) return {};
      fails = does;
      does = std::min(2 * does, largest);
    }
    while (fails == 0 && does > smallest) {
      (stands(candidate, 0.5 * does) ? does : fails) = 0.5 * does;
    }
    return refine(candidate, fails, does);
  }

 private:
  bool stands(const Candidate& candidate, double size) const {
    return stands_(with_change(options_, candidate.what, candidate.sign * size));
  }
  double refine(const Candidate& candidate, double fails, double does) const {
    while (does - fails > resolution * does && does > smallest) {
      const double middle = 0.5 * (fails + does);
      (stands(candidate, middle) ? does : fails) = middle;
    }
    return does;
  }

  const MechanicsOptions& options_;
  const Stands& stands_;
};

std::string times(double factor) {
  return message(factor < 1 ? std::floor(100 * factor) / 100 : std::ceil(100 * factor) / 100);
}

}  // namespace

const char* changed_name(Changed what) {
  switch (what) {
    case Changed::tissue:
      return "tissue";
    case Changed::skin:
      return "skin";
    case Changed::wall:
      return "wall";
    case Changed::cut:
      return "cut";
  }
  return "";
}

std::string Remedy::words() const {
  switch (what) {
    case Changed::tissue:
      return "fat and glandular tissue " + times(factor) + " times as stiff";
    case Changed::skin:
      return "skin " + times(factor) + " times as stiff";
    case Changed::wall:
      return message("a resistance to sliding of ", support, " kPa/mm at the chest wall");
    case Changed::cut:
      return message("supports of ", support, " kPa/mm at the cut");
  }
  return "";
}

MechanicsOptions with_change(const MechanicsOptions& options, Changed what, double size) {
  MechanicsOptions out = options;
  const double factor = std::exp(size);
  if (what == Changed::tissue || what == Changed::skin) {
    for (int t = 0; t < n_tissues; ++t) {
      if ((Tissue(t) == Tissue::skin) != (what == Changed::skin)) continue;
      Law& law = out.materials.laws[std::size_t(t)];
      law = law.scaled(factor);
    }
    return out;
  }
  if (what == Changed::cut) {
    if (!out.cut.has_springs()) out.cut.kind = Cut::spring;
    if (out.cut.sternal) *out.cut.sternal *= factor;
  }
  double& stiffness = *stiffness_of(out, what);
  stiffness = stiffness > 0 ? factor * stiffness : (factor - 1) * usual_sliding_stiffness;
  return out;
}

std::optional<Remedy> smallest_remedy(const HexMesh& mesh, const MechanicsOptions& options,
                                      const Stands& stands, double all_factor) {
  const Search search(options, stands);
  const double guess = all_factor > 1 ? std::log(all_factor) : usual;
  std::optional<Candidate> best;
  double size = 0;
  for (const Candidate& candidate : candidates(mesh, options)) {
    const std::optional<double> found =
        best ? search.below(candidate, size) : search.from(candidate, guess);
    if (!found) continue;
    best = candidate;
    size = *found;
  }
  if (!best) return {};
  Remedy remedy{best->what, std::exp(best->sign * size)};
  if (best->what == Changed::wall || best->what == Changed::cut) {
    MechanicsOptions before = options, after = with_change(options, best->what, size);
    remedy.support = *stiffness_of(after, best->what);
    if (!(*stiffness_of(before, best->what) > 0)) remedy.factor = 0;
  }
  return remedy;
}

}  // namespace breast
