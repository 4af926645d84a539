// SPDX-License-Identifier: GPL-3.0-or-later
#include "extreme/table/cases.hpp"
#include "fixtures/in_place.hpp"

#include <chrono>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "fixtures/block.hpp"
#include "mesh/element_order.hpp"
#include "mesh/quality.hpp"

namespace breast::extreme {

namespace {

using Change = std::function<void(Problem&)>;
const Vec3 prone(0, -gravity_mm_s2, 0), hanging(gravity_mm_s2, 0, 0);

Problem base(int n) {
  Problem problem{analytic_breast_mesh(n), {}, prone};
  problem.options.materials = load_materials("seed2008");
  // A tumour of 10 mm radius at the landmark.
  HexMesh& mesh = problem.mesh;
  const Vec3 tumour = landmark_position(mesh, mesh.imaged, *mesh.landmark("tumour"));
  for (int e = 0; e < mesh.elements(); ++e) {
    if ((element_position(mesh, mesh.imaged, e, Vec3::Zero()) - tumour).norm() < 10) {
      mesh.tissue[e] = Tissue::tumour;
    }
  }
  mesh.tissue[mesh.landmark("tumour")->element] = Tissue::tumour;
  return problem;
}

/// A block of fat hanging from its face x = 0.
Problem hung_block(const fixtures::BlockSettings& settings) {
  Problem problem{fixtures::block(settings), {}, hanging};
  problem.options.materials = load_materials("seed2008");
  return problem;
}

Problem slab(std::array<int, 3> elements, const Vec3& size, const Vec3& gravity) {
  fixtures::BlockSettings settings;
  settings.elements = elements;
  settings.size = size;
  Problem problem = hung_block(settings);
  problem.gravity = gravity;
  return problem;
}

Change scale(const std::string& tissue, double percent) {
  return [=](Problem& p) {
    scale_materials(p.options.materials, {tissue + "=" + std::to_string(percent)});
  };
}
Change stiffness(double factor) {
  return [=](Problem& p) {
    for (Law& law : p.options.materials.laws) law = law.scaled(factor);
  };
}
Change gravity(double factor) {
  return [=](Problem& p) { p.gravity *= factor; };
}
Change towards(const Vec3& g) {
  return [=](Problem& p) { p.gravity = g; };
}
Change neo_hookean(double a10) {
  return [=](Problem& p) {
    for (Law& law : p.options.materials.laws) law = {"neo_hookean", {a10}};
  };
}
Change materials(const std::string& name) {
  return [=](Problem& p) { p.options.materials = load_materials(name); };
}
Change skin(double mm) {
  return [=](Problem& p) {
    p.mesh.skin_model = mm > 0 ? SkinModel::membrane : SkinModel::none;
    p.mesh.skin_thickness.assign(mm > 0 ? p.mesh.skin_faces.size() : 0, mm);
  };
}
Change cut(const std::string& how) {
  return [=](Problem& p) { p.options.cut = cut_support(how); };
}
Change plain() {
  return [](Problem& p) { p.options.invariants = Invariants::plain; };
}
Change bulk(double ratio) {
  return [=](Problem& p) { p.options.bulk_ratio = ratio; };
}
Change quadratic() {
  return [](Problem& p) {
    p.options.element = Element::q2p1;
    p.mesh = raise_order(p.mesh);
  };
}

/// Every element one of five stiffnesses from 1/100 to 100 times fat's, at random.
void random_contrast(Problem& p) {
  constexpr std::array<Tissue, 5> tissues{Tissue::fat, Tissue::fibroglandular, Tissue::muscle,
                                          Tissue::tumour, Tissue::other};
  const Law fat = p.options.materials.law(Tissue::fat);
  for (int k = 0; k < 5; ++k) {
    p.options.materials.laws[std::size_t(tissues[k])] = fat.scaled(std::pow(10.0, k - 2));
  }
  for (int e = 0; e < p.mesh.elements(); ++e) {
    p.mesh.tissue[e] = tissues[std::min(4, int(2.5 * (1 + fixtures::noise(e))))];
  }
}

/// The outermost layer of a block as solid skin, 1/100 as thick as it is wide.
Problem solid_layer() {
  Problem problem = slab({4, 4, 5}, Vec3(100, 100, 100), Vec3(0, 0, -gravity_mm_s2));
  HexMesh& mesh = problem.mesh;
  for (auto* shape : {&mesh.imaged, &mesh.reference, &mesh.points}) {
    for (Vec3& x : *shape) x.z() = x.z() > 99 ? 100.25 : x.z() * 1.25;
  }
  for (int e = 0; e < mesh.elements(); ++e) {
    if (element_position(mesh, mesh.imaged, e, Vec3::Zero()).z() > 100) {
      mesh.tissue[e] = Tissue::skin;
    }
  }
  return problem;
}

/// One inner node of a block moved until the worst scaled Jacobian is 0.02.
Problem poor_element() {
  Problem problem = slab({4, 4, 4}, Vec3(100, 100, 100), Vec3(0, 0, -gravity_mm_s2));
  HexMesh& mesh = problem.mesh;
  const int node = fixtures::node_at(mesh, Vec3(50, 50, 50));
  const Vec3 start = mesh.imaged[node];
  double low = 0, high = 25;
  for (int i = 0; i < 60; ++i) {
    const double moved = 0.5 * (low + high);
    mesh.imaged[node] = start + Vec3(moved, 0.9 * moved, 0.8 * moved);
    (mesh_quality(mesh, mesh.imaged).min_scaled_jacobian > 0.02 ? low : high) = moved;
  }
  mesh.points = mesh.reference = mesh.imaged;
  return problem;
}

Case varied(const std::string& name, bool tested, const std::vector<Change>& changes,
            const std::string& expected = "converged") {
  return {name, tested, 500, expected, [changes] {
            Problem problem = base(8);
            for (const Change& change : changes) change(problem);
            return problem;
          }};
}

Case sized(int n, bool tested) {
  return {message("block of ", n * n * n), tested, n * n * n, "converged", [n] {
            fixtures::BlockSettings settings;
            settings.elements = {n, n, n};
            return hung_block(settings);
          }};
}

std::vector<Case> one_factor() {
  const std::string no_body = "no_stress_free_body", unstable = "unstable_equilibrium";
  return {varied("base", true, {}),
          varied("all stiffness x0.02", true, {stiffness(0.02)}),
          varied("all stiffness x0.1", false, {stiffness(0.1)}),
          varied("all stiffness x10", false, {stiffness(10)}),
          varied("all stiffness x100", true, {stiffness(100)}),
          varied("fat x0.1", true, {scale("fat", 10)}),
          varied("fat x10", false, {scale("fat", 1000)}),
          varied("tumour x20", false, {scale("tumour", 2000)}),
          varied("tumour x1000", true, {scale("tumour", 1e5)}),
          varied("tumour x0.001", true, {scale("tumour", 0.1)}),
          varied("random contrast 1e4", true, {random_contrast}),
          varied("gravity x0", true, {gravity(0)}),
          varied("gravity x5", false, {gravity(5)}),
          varied("gravity x20", true, {gravity(20)}),
          varied("gravity sideways", false, {towards({gravity_mm_s2, 0, 0})}),
          varied("imaged supine", false, {towards(-prone)}),
          varied("wellman", false, {materials("wellman")}),
          varied("victre", false, {materials("victre")}),
          varied("mira2018", true, {materials("mira2018")}, unstable),
          varied("skin 0", true, {skin(0)}),
          varied("skin 0.5 mm", false, {skin(0.5)}),
          varied("skin 3 mm", true, {skin(3)}),
          varied("skin x10", false, {scale("skin", 1000)}),
          varied("cut fixed", false, {cut("fixed")}),
          varied("cut roller", false, {cut("roller")}),
          varied("plain invariants", false, {plain()}),
          varied("bulk ratio 100", false, {bulk(100)}),
          varied("q2p1", false, {quadratic()}),
          varied("prone shape gravity cannot make", false, {skin(0), neo_hookean(10)}, no_body),
          {"solid layer of aspect 100", true, 80, "converged", solid_layer},
          {"slab one element thick, on its face", true, 100, "converged",
           [] {
             return slab({1, 10, 10}, Vec3(10, 100, 100), prone);
           }},
          {"slab one element thick, by its edge", true, 100, "converged",
           [] {
             return slab({10, 10, 1}, Vec3(100, 100, 10), hanging);
           }},
          {"slab one element thick, cantilever", true, 100, "typed",
           [] {
             return slab({10, 10, 1}, Vec3(100, 100, 10), Vec3(0, 0, -gravity_mm_s2));
           }},
          {"scaled Jacobian 0.02", true, 64, "converged", poor_element},
          sized(2, true),
          sized(4, false),
          sized(8, false),
          sized(16, false),
          sized(32, false),
          sized(48, false)};
}

std::vector<Case> combinations() {
  return {varied("x0.1, skin 0", false, {stiffness(0.1), skin(0)}),
          varied("x0.1, gravity sideways", false, {stiffness(0.1), towards({gravity_mm_s2, 0, 0})}),
          varied("x0.02, gravity x5", false, {stiffness(0.02), gravity(5)}, "typed"),
          varied("x0.1, cut fixed", false, {stiffness(0.1), cut("fixed")}),
          varied("gravity x20, skin 3 mm", false, {gravity(20), skin(3)}),
          varied("gravity x20, imaged supine", false, {towards(-20 * prone)}),
          varied("tumour x1000, fat x0.1", false, {scale("tumour", 1e5), scale("fat", 10)}),
          varied("tumour x1000, q2p1", false, {scale("tumour", 1e5), quadratic()}),
          varied("random contrast 1e4, q2p1", false, {random_contrast, quadratic()}),
          varied("random contrast 1e4, gravity x20", false, {random_contrast, gravity(20)}),
          varied("random contrast 1e4, plain", false, {random_contrast, plain()}),
          varied("x0.02, q2p1", false, {stiffness(0.02), quadratic()}),
          varied("mira2018, skin 0", false, {materials("mira2018"), skin(0)}, "typed"),
          varied("mira2018 x3", false, {materials("mira2018"), stiffness(3)}, "typed"),
          varied("mira2018 x10", false, {materials("mira2018"), stiffness(10)})};
}

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

std::vector<Case> cases() {
  std::vector<Case> all = one_factor();
  for (Case& each : combinations()) all.push_back(std::move(each));
  return all;
}

std::vector<Row> solve(const Problem& problem) {
  HexMesh mesh = problem.mesh;
  std::vector<Row> rows;
  auto start = std::chrono::steady_clock::now();
  rows.push_back({"backward", fixtures::backward_into(mesh, problem.gravity, problem.options)});
  rows.back().seconds = since(start);
  if (!rows.back().summary.converged()) return rows;
  start = std::chrono::steady_clock::now();
  rows.push_back({"forward", fixtures::forward_into(mesh, problem.gravity, problem.options)});
  rows.back().seconds = since(start);
  for (int i = 0; i < mesh.nodes(); ++i) {
    rows.back().closure_mm =
        std::max(rows.back().closure_mm, (mesh.points[i] - mesh.imaged[i]).norm());
  }
  return rows;
}

}  // namespace breast::extreme
