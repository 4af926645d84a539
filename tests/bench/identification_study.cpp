// SPDX-License-Identifier: GPL-3.0-or-later
// identify against truths it does not know, one row a draw on stdout:
//
//     identification_study same MESH.vtkhdf FIRST COUNT
//     identification_study misaligned MESH.vtkhdf FIRST COUNT
//     identification_study other MESH.vtkhdf FIRST COUNT FINER.vtkhdf
//     identification_study surface MESH.vtkhdf FIRST COUNT FINER.vtkhdf
//
// MESH is a breast imaged prone, with its wall surface. `same`: draws FIRST ... FIRST + COUNT - 1 of the set
// invivo from its own covariance, 30 landmarks whose marks err by 2.5 mm rms in space. In all others the
// rib cage is also shifted by 4 mm and turned by 2 degrees in random directions. `misaligned`: else as
// before. `other`: four bodies on a finer mesh of the same breast with other laws, ratios of gland to fat,
// skin and supports, COUNT draws of marks each. `surface`: draws as in misaligned, then these bodies, by the skin of
// the second posture alone. Rows may be put together; tabulate identification judges them.
#include <Eigen/Cholesky>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>
#include <string>

#include "core/error.hpp"
#include "core/report.hpp"
#include "core/units.hpp"
#include "fixtures/in_place.hpp"
#include "fixtures/seen_skin.hpp"
#include "identification/identify.hpp"
#include "io/mesh_file.hpp"
#include "material/set_parameter.hpp"
#include "mesh/locate.hpp"

namespace {

using namespace breast;

constexpr int landmarks = 30;
constexpr double mark_mm = 2.5, shift_mm = 4, turn_deg = 2, skin_mm = 0.5;

using Stream = std::mt19937_64;

Vec3 normal_vector(Stream& stream) {
  std::normal_distribution<double> normal;
  const double x = normal(stream), y = normal(stream), z = normal(stream);
  return {x, y, z};
}

MechanicsOptions mechanics_with(const MaterialSet& set) {
  MechanicsOptions options;
  options.materials = set;
  take_supports_of_set(options);
  options.seek_remedy = false;
  return options;
}

// A breast in both postures, not of the identifier's making.
struct Truth {
  std::string name;
  HexMesh second;
  Eigen::VectorXd logarithms;  ///< of the identifier's own parameters; empty: it has none such
};

bool solve(HexMesh& mesh, const MechanicsOptions& options) {
  const Equilibrium free = solve_backward(mesh, posture_gravity(Posture::prone), options);
  if (!free.converged()) return false;
  store(free, mesh);
  const Equilibrium second = solve_forward(mesh, posture_gravity(Posture::supine), options);
  if (!second.converged()) return false;
  store(second, mesh);
  return true;
}

// Factors drawn from the prior until there is a stable body.
Truth draw_same(const HexMesh& mesh, const MaterialSet& set, Stream& stream) {
  const Sought sought{set_parameters(set), false};
  const Eigen::MatrixXd root = prior_covariance(set, sought.names, PriorKind::set).llt().matrixL();
  std::normal_distribution<double> normal;
  for (int i = 0; i < 50; ++i) {
    Eigen::VectorXd x(sought.count());
    for (double& one : x) one = normal(stream);
    x = root * x;
    Truth truth{"same", mesh, x};
    if (solve(truth.second, with_factors(mechanics_with(set), sought, x))) return truth;
  }
  throw failed_error("no stable body in 50 draws");
}

struct OtherLaw {
  const char* name;
  Law fat;
  double gland, skin, wall, cut;  ///< gland: of fat's law; the rest of invivo's
};

// Laws that stiffen otherwise than the polynomial (9), or not at all.
const OtherLaw other_laws[] = {
    {"neo-Hookean", {"neo_hookean", {300}}, 3, 0.5, 1.5, 0.8},
    {"Mooney-Rivlin", {"mooney_rivlin", {100, 100}}, 0.6, 2, 0.6, 1.3},
    {"Yeoh", {"yeoh", {40, 300, 200}}, 5, 1, 2, 1},
    {"exponential", {"exponential", {20, 6, 15}}, 1.5, 3, 0.5, 1.5},
};

Truth other_truth(const HexMesh& mesh, const OtherLaw& other) {
  MaterialSet set = load_materials("invivo");
  for (const Tissue tissue : {Tissue::fat, Tissue::muscle, Tissue::other})
    set.laws[std::size_t(tissue)] = other.fat;
  for (const Tissue tissue : {Tissue::fibroglandular, Tissue::tumour})
    set.laws[std::size_t(tissue)] = other.fat.scaled(other.gland);
  scale_set(set, "skin", other.skin);
  scale_set(set, "wall", other.wall);
  scale_set(set, "cut", other.cut);
  Truth truth{other.name, mesh, {}};
  if (!solve(truth.second, mechanics_with(set))) throw failed_error(other.name, ": no stable body");
  return truth;
}

struct Marks {
  Observations seen;
  std::vector<Vec3> true_places;  ///< in the frame of the marks
};

RigidMotion misaligned(const HexMesh& mesh, bool at_all, Stream& stream) {
  RigidMotion moved;
  if (!at_all) return moved;
  for (const int node : nodes_of(mesh, mesh.pectoral_faces))
    moved.centre = mesh.imaged[std::size_t(node)];
  moved.shift = shift_mm * normal_vector(stream).normalized();
  moved.turn = turn_deg * normal_vector(stream).normalized();
  return moved;
}

// `count` places anywhere in the body, marked in both postures.
Marks marked(const HexMesh& model, const Truth& truth, int count, const RigidMotion& moved,
             Stream& stream) {
  Marks marks;
  const HexMesh& mesh = truth.second;
  const Locator body(model, model.imaged);
  std::uniform_int_distribution<int> element(0, mesh.elements() - 1);
  std::uniform_real_distribution<double> local(-1, 1);
  for (int k = 0; k < count; ++k) {
    const int e = element(stream);
    const double a = local(stream), b = local(stream), c = local(stream);
    const Location at{e, Vec3(a, b, c), 0};
    const Vec3 place = moved(element_position(mesh, mesh.points, at.element, at.local));
    const double deviation = coordinate_deviation(mark_mm);
    marks.true_places.push_back(place);
    const Location own = body.nearest(element_position(mesh, mesh.imaged, at.element, at.local));
    marks.seen.points.push_back(
        {"mark" + std::to_string(k), own, place + deviation * normal_vector(stream), deviation});
  }
  return marks;
}

IdentifyOptions options_of(bool align) {
  IdentifyOptions options;
  options.mechanics = mechanics_with(load_materials("invivo"));
  options.align = align;
  options.shift_mm = shift_mm, options.turn_deg = turn_deg;
  return options;
}

// Directions known to 5 %: how many of them meet the truth within 10 % and within two deviations.
struct Met {
  int identifiable = 0, within_10_percent = 0, within_2_sd = 0, all_within_2_sd = 0;
};
Met met(const Identified& found, const Eigen::VectorXd& truth) {
  Met out;
  if (truth.size() == 0) return out;
  const Eigen::VectorXd off = found.fit.x.head(truth.size()) - truth;
  for (const KnownDirection& one : found.directions) {
    const double error = std::abs(one.weights.dot(off));
    out.all_within_2_sd += error <= 2 * one.deviation;
    if (one.deviation > 0.05 || one.from_data() < 0.5) continue;
    ++out.identifiable;
    out.within_10_percent += error <= std::log(1.1);
    out.within_2_sd += error <= 2 * one.deviation;
  }
  return out;
}

void header() {
  std::puts(
      "study\ttruth\tdraw\telements\tpairs\tjacobians\tcpu_s\tconverged\tidentifiable\twithin_10_percent"
      "\twithin_2_sd\tdirections\tall_within_2_sd\tmotion_mm\tresidual_mm\tleft_out_mm\ttrue_mm"
      "\tprobability\tdiscount\tdecided");
}

// Means over the landmarks, mm: motion, residual, left out as seen, and against the true place.
void row(const char* study, const Truth& truth, int draw, const HexMesh& mesh,
         const Identified& found, const Marks& marks, const std::vector<Vec3>& predicted,
         double cpu) {
  double motion = 0, residual = 0, left_out = 0, true_mm = 0;
  const double n = double(marks.true_places.size());
  for (std::size_t k = 0; k < marks.true_places.size(); ++k) {
    const Location& at = marks.seen.points[k].at;
    motion +=
        (marks.true_places[k] - element_position(mesh, mesh.imaged, at.element, at.local)).norm() /
        n;
    true_mm += (predicted[k] - marks.true_places[k]).norm() / n;
    if (found.landmarks.empty()) continue;
    residual += found.landmarks[k].residual / n;
    left_out += found.landmarks[k].left_out / n;
  }
  const Met m = met(found, truth.logarithms);
  std::printf(
      "%s\t%s\t%d\t%d\t%d\t%d\t%.2f\t%d\t%d\t%d\t%d\t%d\t%d\t%.2f\t%.3f\t%.3f\t%.3f\t%.4g\t%.3f\t%.3f\n",
      study, truth.name.c_str(), draw, mesh.elements(), found.pairs, found.fit.jacobians, cpu,
      int(found.fit.converged), m.identifiable, m.within_10_percent, m.within_2_sd,
      int(truth.logarithms.size()), m.all_within_2_sd, motion, residual, left_out, true_mm,
      found.misfit.probability, found.discount, found.decided);
  std::fflush(stdout);
}

void by_landmarks(const char* study, const HexMesh& mesh, const Truth& truth, int draw,
                  Stream& stream) {
  const bool align = std::strcmp(study, "same") != 0;
  const Marks marks = marked(mesh, truth, landmarks, misaligned(mesh, align, stream), stream);
  const double start = cpu_seconds();
  const Identified found = identify(mesh, marks.seen, options_of(align));
  std::vector<Vec3> without;
  for (const LandmarkFit& one : found.landmarks) without.push_back(one.without);
  row(study, truth, draw, mesh, found, marks, without, cpu_seconds() - start);
}

void by_surface(const HexMesh& mesh, const Truth& truth, int draw, Stream& stream) {
  const RigidMotion moved = misaligned(mesh, true, stream);
  const Marks marks = marked(mesh, truth, landmarks, moved, stream);
  Observations seen;
  seen.surface = fixtures::seen_skin(truth.second, 4);
  std::normal_distribution<double> normal;
  for (std::size_t k = 0; k < seen.surface->points.size(); ++k) {
    Vec3& point = seen.surface->points[k];
    point = moved(point + skin_mm * normal(stream) * seen.surface->normals[k]);
    seen.surface->normals[k] = moved.rotation() * seen.surface->normals[k];
  }
  const double start = cpu_seconds();
  const Identified found = identify(mesh, seen, options_of(true));
  std::vector<Vec3> places;
  for (const SeenPoint& one : marks.seen.points) {
    places.push_back(found.motion(
        element_position(found.second, found.second.points, one.at.element, one.at.local)));
  }
  row("surface", truth, draw, mesh, found, marks, places, cpu_seconds() - start);
}

void run(const std::string& study, const HexMesh& mesh, int first, int count,
         const HexMesh& finer) {
  const MaterialSet set = load_materials("invivo");
  header();
  if (study != "other") {
    for (int draw = first; draw < first + count; ++draw) {
      Stream stream(std::uint64_t(1000 + draw));
      const Truth truth = draw_same(mesh, set, stream);
      study == "surface" ? by_surface(mesh, truth, draw, stream)
                         : by_landmarks(study.c_str(), mesh, truth, draw, stream);
    }
  }
  if (study == "same" || study == "misaligned") return;
  for (const OtherLaw& other : other_laws) {
    const Truth truth = other_truth(finer, other);
    for (int draw = first; draw < first + count; ++draw) {
      Stream stream(std::uint64_t(2000 + draw));
      study == "other" ? by_landmarks("other", mesh, truth, draw, stream)
                       : by_surface(mesh, truth, draw, stream);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string study = argc > 1 ? argv[1] : "";
  const bool two_meshes = study == "other" || study == "surface";
  if (argc != (two_meshes ? 6 : 5)) {
    std::fprintf(stderr,
                 "identification_study same|misaligned MESH.vtkhdf FIRST COUNT\n"
                 "identification_study other|surface MESH.vtkhdf FIRST COUNT FINER.vtkhdf\n");
    return 2;
  }
  try {
    const auto mesh = [&](int at) { return breast::read_mesh(argv[at], {.geometry = true}); };
    run(study, mesh(2), std::atoi(argv[3]), std::atoi(argv[4]), mesh(two_meshes ? 5 : 2));
  } catch (const breast::Error& error) {
    std::fprintf(stderr, "identification_study: %s\n", error.what());
    return error.exit_code();
  }
}
