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

// A candidate and its direction, since skin may be too stiff as well as too soft.
struct Candidate {
  std::string what;
  double sign = 1;
};

SupportPtr& support_called(MechanicsOptions& options, const std::string& what) {
  return what == place_name(SupportPlace::wall) ? options.wall : options.cut;
}

std::vector<Candidate> candidates(const HexTopology& mesh, const MechanicsOptions& options) {
  std::vector<Candidate> all{{"tissue"}};
  const bool layer = std::count(mesh.tissue.begin(), mesh.tissue.end(), Tissue::skin) > 0;
  if (layer || (mesh.skin_model == SkinModel::membrane && !mesh.skin_faces.empty())) {
    all.push_back({"skin", -1});
    all.push_back({"skin", 1});
  }
  for (const SupportPtr& support : {options.wall, options.cut}) {
    const std::string what = place_name(support->place());
    if (!faces_at(mesh, support->place()).empty() && with_change(options, what, smallest)) {
      all.push_back({what});
    }
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
    return stands_(*with_change(options_, candidate.what, candidate.sign * size));
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

std::string Remedy::words() const {
  if (what == "tissue") return "fat and glandular tissue " + times(factor) + " times as stiff";
  if (what == "skin") return "skin " + times(factor) + " times as stiff";
  return message("springs of ", support, " kPa/mm at the ",
                 what == place_name(SupportPlace::wall) ? "chest wall" : "cut");
}

std::optional<MechanicsOptions> with_change(const MechanicsOptions& options,
                                            const std::string& what, double size) {
  MechanicsOptions out = options;
  const double factor = std::exp(size);
  if (what == "tissue" || what == "skin") {
    for (int t = 0; t < n_tissues; ++t) {
      if ((Tissue(t) == Tissue::skin) != (what == "skin")) continue;
      Law& law = out.materials.laws[std::size_t(t)];
      law = law.scaled(factor);
    }
    return out;
  }
  SupportPtr& support = support_called(out, what);
  support = support->stiffness() > 0
                ? support->stiffened(factor)
                : support->with_springs((factor - 1) * usual_sliding_stiffness);
  return support ? std::optional(out) : std::nullopt;
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
  if (best->what == "tissue" || best->what == "skin") return remedy;
  MechanicsOptions before = options, after = *with_change(options, best->what, size);
  remedy.support = support_called(after, best->what)->stiffness();
  if (!(support_called(before, best->what)->stiffness() > 0)) remedy.factor = 0;
  return remedy;
}

}  // namespace breast
