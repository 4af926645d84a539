// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/temporary_folder.hpp"
#include "fixtures/laws.hpp"
#include "material/curves.hpp"
#include "material/material_set.hpp"
#include "material/stability.hpp"

namespace breast {
namespace {

TEST(Law, DerivativesAgreeWithDifferences) {
  const double h = 1e-4, i1 = 3.31, i2 = 3.27;
  for (const Law& law : every_law()) {
    const LawValue v = law.evaluate(i1, i2);
    const LawValue up = law.evaluate(i1 + h, i2), down = law.evaluate(i1 - h, i2);
    const LawValue right = law.evaluate(i1, i2 + h), left = law.evaluate(i1, i2 - h);
    const double scale = std::abs(v.w1) + std::abs(v.w2) + std::abs(v.w11);
    EXPECT_NEAR((up.w - down.w) / (2 * h), v.w1, 1e-6 * scale) << law.describe();
    EXPECT_NEAR((right.w - left.w) / (2 * h), v.w2, 1e-6 * scale) << law.describe();
    EXPECT_NEAR((up.w1 - down.w1) / (2 * h), v.w11, 1e-6 * scale) << law.describe();
    EXPECT_NEAR((up.w2 - down.w2) / (2 * h), v.w12, 1e-6 * scale) << law.describe();
    EXPECT_NEAR((right.w2 - left.w2) / (2 * h), v.w22, 1e-6 * scale) << law.describe();
    EXPECT_NEAR(law.evaluate(3, 3).w, 0, 1e-12) << law.describe();
  }
}

TEST(Law, EveryLawIsAmongThoseTested) {
  for (const LawKind* kind : law_kinds()) {
    EXPECT_EQ(std::count_if(every_law().begin(), every_law().end(),
                            [&](const Law& law) { return law.kind == kind; }),
              1)
        << kind->name;
  }
  for (const Law& law : every_law()) EXPECT_NO_THROW(check_law(law, "test")) << law.describe();
}

// What a law declares of its constants is so: the derivative by each, and a factor on the stiffnesses is
// one on the energy.
TEST(Law, IsLinearInTheConstantsThatItDeclaresSo) {
  const double i1 = 3.31, i2 = 3.27;
  for (const Law& law : every_law()) {
    const LawValue v = law.evaluate(i1, i2);
    for (std::size_t k = 0; k < law.constants.size(); ++k) {
      const double h = 1e-5 * law.constants[k];
      Law up = law, down = law;
      up.constants[k] += h, down.constants[k] -= h;
      const LawValue above = up.evaluate(i1, i2), below = down.evaluate(i1, i2);
      const LawSlope slope = law.slope(k, i1, i2);
      const double scale = 1e-8 * (std::abs(v.w1) + std::abs(v.w2)) / std::abs(law.constants[k]);
      EXPECT_NEAR((above.w1 - below.w1) / (2 * h), slope.w1, scale) << law.describe() << k;
      EXPECT_NEAR((above.w2 - below.w2) / (2 * h), slope.w2, scale) << law.describe() << k;
    }
    const LawValue twice = law.scaled(2).evaluate(i1, i2);
    EXPECT_NEAR(twice.w, 2 * v.w, 1e-12 * v.w) << law.describe();
    EXPECT_NEAR(twice.w12, 2 * v.w12, 1e-12 * std::abs(v.w12)) << law.describe();
    EXPECT_NEAR(law.scale_slope(i1, i2).w1, v.w1, 1e-12 * std::abs(v.w1)) << law.describe();
  }
}

TEST(Law, RefusesByNameWhatItDoesNotDeclare) {
  LawKind kind = law_kind("exponential");
  kind.name = "unfinished", kind.shape_slope = nullptr;
  Law law{"exponential", {92.39, 4.4, -203.40}};
  law.kind = &kind;
  EXPECT_NO_THROW(law.slope(0, 3.1, 3.1));
  try {
    law.slope(1, 3.1, 3.1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(
        std::string(error.what()).find("unfinished: it declares no derivative with respect to b"),
        std::string::npos)
        << error.what();
  }
  EXPECT_THROW(Law("rubber", {1}), Error);
}

TEST(Law, ShearModuliOfThePaper) {
  const MaterialSet set = load_materials("seed2008");
  EXPECT_DOUBLE_EQ(set.law(Tissue::fat).shear_modulus(), 1220);
  EXPECT_DOUBLE_EQ(set.law(Tissue::fibroglandular).shear_modulus(), 1220);
  EXPECT_NEAR(set.law(Tissue::skin).shear_modulus(), 2 * (92.39 * 4.4 - 203.40), 1e-9);
  EXPECT_EQ(set.law(Tissue::tumour).constants, set.law(Tissue::fibroglandular).constants);
}

TEST(Law, ScalingLeavesTheExponentAlone) {
  const Law scaled = Law{"exponential", {92.39, 4.4, -203.40}}.scaled(2);
  EXPECT_EQ(scaled.constants, (std::vector<double>{184.78, 4.4, -406.80}));
  EXPECT_NEAR(scaled.shear_modulus(), 2 * 406.232, 1e-9);
}

TEST(Law, ExponentialGuardsAgainstOverflow) {
  const Law skin{"exponential", {92.39, 4.4, -203.40}};
  EXPECT_TRUE(skin.in_range(3 + 49.9 / 4.4, 3));
  EXPECT_FALSE(skin.in_range(3 + 50.1 / 4.4, 3));
  EXPECT_FALSE(skin.in_range(std::nan(""), 3));
}

TEST(Gent, IsThatOfItsClosedFormsAndEndsAtAStretch) {
  constexpr double mu = 500, limit = 2;
  const Law law{"gent", {mu, limit}};
  EXPECT_NEAR(law.shear_modulus(), mu, 1e-12 * mu);
  for (const double s : {0.85, 0.9, 1.2, 1.5}) {
    const auto expect = [&](double stress, double u, double strain) {
      const double exact = mu * limit / (limit - u) * strain;
      EXPECT_NEAR(stress, exact, 1e-12 * std::abs(exact)) << s;
    };
    expect(uniaxial_stress(law, s), s * s + 2 / s - 3, s - 1 / (s * s));
    expect(equibiaxial_stress(law, s), 2 * s * s + std::pow(s, -4) - 3, s - std::pow(s, -5));
    expect(pure_shear_stress(law, s), s * s + 1 / (s * s) - 2, s - std::pow(s, -3));
    expect(simple_shear_stress(law, s - 0.2), (s - 0.2) * (s - 0.2), s - 0.2);
  }
  // λ² + 2/λ − 3 = 2 at λ = 2.
  EXPECT_GT(uniaxial_stress(law, 1.9999), 5e3 * mu);
  EXPECT_TRUE(std::isnan(uniaxial_stress(law, 2)));
  EXPECT_NEAR(stable_range(law).tension, 2, 0.05);
  EXPECT_EQ(ellipticity_margin(law).value, 1);
  EXPECT_THROW(check_law({"gent", {mu, 0}}, "fat"), Error);
}

// The shear modulus along ε m⊗n is the second difference of W.
TEST(Stability, DirectionalModulusIsTheSecondDifference) {
  Mat3 f;
  f << 1.2, 0.3, -0.1, 0.05, 0.9, 0.2, 0.1, -0.15, 1.1;
  f /= std::cbrt(f.determinant());
  const Vec3 n = Vec3(1, 2, -1).normalized(), m = Vec3(1, 0, 1).normalized();
  const auto energy = [&](const Law& law, double e) {
    const Mat3 g = (Mat3::Identity() + e * m * n.transpose()) * f;
    const Mat3 c = g.transpose() * g;
    return law.evaluate(c.trace(), c.inverse().trace()).w;
  };
  for (const Law& law : every_law()) {
    const double h = 1e-3;
    const double difference = (energy(law, h) - 2 * energy(law, 0) + energy(law, -h)) / (h * h);
    const double exact = directional_shear_modulus(law, f * f.transpose(), m, n);
    EXPECT_NEAR(difference, exact, 1e-4 * std::abs(exact)) << law.describe();
  }
}

TEST(Stability, SkinOfThePaperKeepsNineTenthsOfItsShear) {
  const StableRange range = stable_range({"exponential", {92.39, 4.4, -203.40}}, 0.3, 3);
  EXPECT_NEAR(range.weakest, 0.916, 0.004);
  EXPECT_NEAR(range.compression, 0.3, 1e-9);
  EXPECT_NEAR(range.tension, 3, 1e-9);
}

TEST(Stability, RefusesLawsThatLoseEllipticity) {
  EXPECT_NO_THROW(check_law({"exponential", {92.39, 4.4, -0.92 * 92.39 * 4.4}}, "skin"));
  EXPECT_THROW(check_law({"exponential", {92.39, 4.4, -0.94 * 92.39 * 4.4}}, "skin"), Error);
  EXPECT_THROW(check_law({"neo_hookean", {-1}}, "fat"), Error);
  EXPECT_THROW(check_law({"neo_hookean", {std::nan("")}}, "fat"), Error);
  EXPECT_THROW(check_law({"polynomial", {310, 300}}, "fat"), Error);
  EXPECT_THROW(check_law({"yeoh", {610, -900, 0}}, "fat"), Error);
}

// The bound of -c / ab, from the margin of a constant c within it.
double exponential_bound(double b) {
  return 0.1 / (1 - ellipticity_margin({"exponential", {1, b, -0.1 * b}}).value);
}

// The bound on c depends on b: against the least of the function on a fine grid, and against the
// shears of a uniaxially stretched body.
TEST(Stability, BoundOfTheExponentialLawDependsOnItsExponent) {
  for (const double b : {0.05, 0.3, 1.0, 4.4, 30.0}) {
    double least = 1;
    for (double stretch = 1; stretch < 40; stretch *= 1.00005) {
      const double square = stretch * stretch;
      least = std::min(least, std::exp(b * (square + 2 / stretch - 3)) / square);
    }
    EXPECT_NEAR(exponential_bound(b), least, 1e-7) << b;
  }
  EXPECT_NEAR(exponential_bound(4.4), 0.929, 5e-4);
  const double a = 100, b = 1;
  const Law beyond{"exponential", {a, b, -0.8 * a * b}};
  EXPECT_LT(stable_range(beyond, 0.5, 3).tension, 2.9);  // a shear loses its stiffness on the way
  EXPECT_FALSE(always_elliptic(beyond));
  EXPECT_THROW(check_law(beyond, "skin"), Error);
  EXPECT_NO_THROW(check_law({"exponential", {a, b, -0.7 * a * b}}, "skin"));
}

TEST(Stability, MarginOfTheConstants) {
  const EllipticityMargin skin = ellipticity_margin({"exponential", {92.39, 4.4, -203.40}});
  EXPECT_NEAR(skin.value, 1 - 203.40 / (exponential_bound(4.4) * 92.39 * 4.4), 1e-12);
  EXPECT_TRUE(skin.every_stretch);
  const EllipticityMargin fat = ellipticity_margin({"polynomial", {310, 300, 2250, 3800, 4720}});
  EXPECT_NEAR(fat.value, 1 - 4720.0 * 4720 / (4 * 2250.0 * 3800), 1e-12);
  EXPECT_EQ(ellipticity_margin({"mooney_rivlin", {310, 300}}).value, 1);
  // A negative constant: scanned, and weaker than at rest.
  const EllipticityMargin scanned = ellipticity_margin({"yeoh", {610, -20, 10}});
  EXPECT_FALSE(scanned.every_stretch);
  EXPECT_GT(scanned.value, 0);
  EXPECT_LT(scanned.value, 1);
  // At the bound the margin vanishes.
  EXPECT_LT(ellipticity_margin({"exponential", {100, 4, -0.928 * 400}}).value, 2e-3);
}

TEST(Materials, EmbeddedSetsLoadAndScale) {
  EXPECT_EQ(material_set_names(),
            (std::vector<std::string>{"invivo", "invivo-borders", "invivo-sternum", "mira2018",
                                      "phantom2026", "seed2008", "victre", "wellman"}));
  for (const std::string& name : material_set_names()) {
    MaterialSet set = load_materials(name);
    for (const Law& law : set.laws) EXPECT_GT(law.shear_modulus(), 0) << name;
    const double before = set.law(Tissue::fat).shear_modulus();
    scale_materials(set, {"fat=50"});
    EXPECT_NEAR(set.law(Tissue::fat).shear_modulus(), before / 2, 1e-9 * before);
  }
  EXPECT_EQ(load_materials("seed2008").skin.kept, 1);
  EXPECT_EQ(load_materials("seed2008").wall, "");
  MaterialSet set = load_materials("seed2008");
  for (const char* bad : {"fat", "fat=", "fat=-5", "fat=0", "fat=x", "bone=50", "=50"}) {
    EXPECT_THROW(scale_materials(set, {bad}), Error) << bad;
  }
  EXPECT_THROW(load_materials("no-such-set"), Error);
}

TEST(MaterialTable, ReadsBackAsWritten) {
  for (const std::string& name : material_set_names()) {
    MaterialSet set = load_materials(name);
    set.wall = "slide:0.0333", set.cut = "tissue:0.02,0.3";
    set.corner_bulk[std::size_t(Tissue::muscle)] = 1234.5;
    set.uncertainty.parameters = {"low_order", "wall"};
    set.uncertainty.covariance.resize(2, 2);
    set.uncertainty.covariance << 0.25, -0.03, -0.03, 0.04;
    const TemporaryFolder folder;
    write_table(folder.path() / "set.tsv", material_table(set));
    const MaterialSet back = load_materials((folder.path() / "set.tsv").string());
    for (const Tissue tissue :
         {Tissue::fat, Tissue::fibroglandular, Tissue::skin, Tissue::tumour}) {
      EXPECT_EQ(back.law(tissue).kind, set.law(tissue).kind) << name;
      EXPECT_EQ(back.law(tissue).constants, set.law(tissue).constants) << name;
    }
    EXPECT_EQ(back.density, set.density) << name;
    EXPECT_EQ(back.corner_bulk, set.corner_bulk) << name;
    EXPECT_NEAR(back.skin.kept, set.skin.kept, 1e-15);
    EXPECT_EQ(back.wall, set.wall);
    EXPECT_EQ(back.cut, set.cut);
    EXPECT_EQ(back.uncertainty.parameters, set.uncertainty.parameters);
    EXPECT_LT((back.uncertainty.covariance - set.uncertainty.covariance).norm(), 1e-15);
  }
}

TEST(MaterialTable, ImpossibleUncertaintyIsRefused) {
  MaterialSet set = load_materials("seed2008");
  set.uncertainty.parameters = {"skin"};
  set.uncertainty.covariance = Eigen::MatrixXd::Constant(1, 1, 0.01);
  Table table = material_table(set);
  table.rows.back()[std::size_t(table.column("correlation_skin"))] = "1.5";
  const TemporaryFolder folder;
  write_table(folder.path() / "set.tsv", table);
  EXPECT_THROW(load_materials((folder.path() / "set.tsv").string()), Error);
}

}  // namespace
}  // namespace breast
