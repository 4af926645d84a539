// SPDX-License-Identifier: GPL-3.0-or-later
// Decks: what is written is the scene; what is read back lands on the right nodes.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/error.hpp"
#include "core/units.hpp"
#include "export/deck/calculix.hpp"
#include "export/deck/febio.hpp"
#include "export/deck/results.hpp"
#include "export/deck/serendipity.hpp"
#include "fixtures/scratch_folder.hpp"
#include "fixtures/shapes.hpp"
#include "mesh/element_order.hpp"
#include "mesh/shape.hpp"

namespace breast {
namespace {

const Vec3 gravity(0, gravity_mm_s2, 0);

HexMesh small_cap(bool with_cut = false) {
  return fixtures::cap({.elements = 4, .skin_mm = 0, .with_cut = with_cut});
}

MechanicsOptions options() {
  MechanicsOptions o;
  o.materials = load_materials("seed2008");
  o.bulk_ratio = 1000;
  return o;
}

// Data lines of an .inp file under each keyword line, continuation lines joined, in order.
struct Section {
  std::string keyword;
  std::vector<std::vector<std::string>> lines;
};
std::vector<Section> parse_inp(const std::string& text) {
  std::vector<Section> sections;
  std::istringstream in(text);
  bool joined = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("**")) continue;
    if (line.starts_with("*")) {
      sections.push_back({line, {}});
      continue;
    }
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    auto& lines = sections.back().lines;
    if (joined) {
      lines.back().insert(lines.back().end(), cells.begin(), cells.end());
    } else {
      lines.push_back(cells);
    }
    joined = line.ends_with(",");
  }
  return sections;
}
const Section& section(const std::vector<Section>& all, const std::string& start) {
  for (const Section& s : all) {
    if (s.keyword.starts_with(start)) return s;
  }
  throw std::runtime_error("no section " + start);
}

class DeckElements : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Orders, DeckElements, testing::Values(1, 2));

TEST_P(DeckElements, CalculixDeckReadsBackAsTheScene) {
  HexMesh mesh = small_cap();
  MechanicsOptions o = options();
  if (GetParam() == 2) {
    mesh = raise_order(mesh);
    o.element = Element::q2p1;
  }
  const DeckScene scene = deck_scene(mesh, o, gravity, false);
  const int n = scene.nodes_per_element;
  const std::string element = n == 8 ? "C3D8I" : "C3D20R";
  const std::vector<Section> deck = parse_inp(calculix_deck(scene, element));

  const Section& nodes = section(deck, "*NODE, NSET=ALL");
  ASSERT_EQ(nodes.lines.size(), scene.nodes.size());
  for (std::size_t i = 0; i < nodes.lines.size(); ++i) {
    EXPECT_EQ(std::stoul(nodes.lines[i][0]), i + 1);
    for (int k = 0; k < 3; ++k) {
      EXPECT_LE(nodes.lines[i][k + 1].size(), 20u);  // CalculiX reads no more
      EXPECT_NEAR(std::stod(nodes.lines[i][k + 1]), scene.nodes[i][k], 1e-9);
    }
  }
  int elements = 0;
  for (const Section& s : deck) {
    if (!s.keyword.starts_with("*ELEMENT")) continue;
    EXPECT_NE(s.keyword.find("TYPE=" + element + ","), std::string::npos);
    for (const auto& line : s.lines) {
      ASSERT_EQ(line.size(), std::size_t(n) + 1);
      const int e = std::stoi(line[0]) - 1;
      ++elements;
      EXPECT_NE(s.keyword.find(mesh.tissue[e] == Tissue::fat ? "=FAT" : "=FIBROGLANDULAR"),
                std::string::npos);
      for (int a = 0; a < n; ++a) {
        EXPECT_EQ(std::stoi(line[a + 1]) - 1, scene.connectivity[std::size_t(e) * n + a]);
        EXPECT_EQ(scene.nodes[std::stoi(line[a + 1]) - 1], mesh.reference[mesh.element(e)[a]]);
      }
    }
  }
  EXPECT_EQ(elements, mesh.elements());
  const Section& held = section(deck, "*NSET, NSET=HELD");
  ASSERT_EQ(held.lines.size(), scene.held.size());
  for (const int node : scene.held) EXPECT_NEAR(scene.nodes[node].y(), 0, 1e-9);
  Vec3 weight = Vec3::Zero(), free = Vec3::Zero(), written = Vec3::Zero();
  for (const Vec3& force : scene.load) weight += force;
  for (const Vec3& force : free_load(scene)) free += force;
  for (const auto& line : section(deck, "*CLOAD").lines) {
    written[std::stoi(line[1]) - 1] += std::stod(line[2]);
  }
  EXPECT_LT((written - free).norm(), 1e-9 * weight.norm());
  EXPECT_LT(free.y(), weight.y());
  // ρgV; 20 nodes carry the same weight as 27.
  double volume = 0;
  for (int e = 0; e < mesh.elements(); ++e) {
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-1.0, 1.0}) {
        for (const double c : {-1.0, 1.0}) {
          const HexShape shape = hex_shape(mesh.order, Vec3(a, b, c) / std::sqrt(3.0));
          Mat3 jacobian = Mat3::Zero();
          for (int i = 0; i < mesh.nodes_per_element(); ++i) {
            jacobian += mesh.imaged[mesh.element(e)[i]] * shape.gradients.col(i).transpose();
          }
          volume += jacobian.determinant();
        }
      }
    }
  }
  constexpr double density = 1e-3;  // g/mm3
  EXPECT_NEAR(weight.y() / (density * gravity_mm_s2 * volume), 1, 1e-9);
  EXPECT_NEAR(weight.x(), 0, 1e-9 * weight.y());
}

TEST(Deck, CalculixConstants) {
  const std::vector<Section> deck =
      parse_inp(calculix_deck(deck_scene(small_cap(), options(), gravity, false), "C3D8"));
  const Section& law = section(deck, "*HYPERELASTIC");
  EXPECT_EQ(law.keyword, "*HYPERELASTIC, POLYNOMIAL, N=2");
  // C10 C01 C20 C11 C02 D1 D2 from (310, 300, 2250, 3800, 4720) in the order a10 a01 a20 a02 a11.
  const std::vector<double> expected{310, 300, 2250, 4720, 3800, 2 / 1.22e6, 1e20};
  ASSERT_EQ(law.lines.at(0).size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(std::stod(law.lines[0][i]), expected[i], 1e-11 * (1 + expected[i])) << i;
  }
}

TEST(Deck, RollersAreEquations) {
  MechanicsOptions o = options();
  o.cut = cut_support("roller");
  const DeckScene scene = deck_scene(small_cap(true), o, gravity, false);
  ASSERT_FALSE(scene.rolling.empty());
  std::size_t equations = 0;
  for (const Section& s : parse_inp(calculix_deck(scene, "C3D8"))) {
    if (s.keyword != "*EQUATION") continue;
    const auto& terms = s.lines.at(1);
    const DeckRoller& roller = scene.rolling[equations++];
    ASSERT_EQ(terms.size(), 9u);
    EXPECT_GE(std::abs(std::stod(terms[2])), 0.577);  // the eliminated component is not a small one
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(std::stoi(terms[3 * k]) - 1, roller.node);
      EXPECT_NEAR(std::stod(terms[3 * k + 2]), roller.normal[std::stoi(terms[3 * k + 1]) - 1],
                  1e-11);
    }
  }
  EXPECT_EQ(equations, scene.rolling.size());
  EXPECT_THROW(febio_deck(scene), Error);
}

std::vector<std::string> all_between(const std::string& text, const std::string& open,
                                     const std::string& close) {
  std::vector<std::string> found;
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at + 1)) {
    const std::size_t from = at + open.size();
    found.push_back(text.substr(from, text.find(close, from) - from));
  }
  return found;
}

// FEBio is not run here: structure and constants only.
TEST(Deck, FebioStructure) {
  MechanicsOptions o = options();
  o.materials.laws[std::size_t(Tissue::fibroglandular)] = {"exponential", {92.39, 4.4, -203.4}};
  const DeckScene scene = deck_scene(small_cap(), o, gravity, false);
  const std::string text = febio_deck(scene);
  EXPECT_EQ(all_between(text, "<node id=\"", "</node>").size(), scene.nodes.size());
  EXPECT_EQ(all_between(text, "<elem id=\"", "</elem>").size(), std::size_t(scene.elements()));
  const std::string last = all_between(text, "<node id=\"", "</node>").back();
  std::istringstream position(last.substr(last.find('>') + 1));
  for (int k = 0; k < 3; ++k) {
    std::string cell;
    std::getline(position, cell, ',');
    EXPECT_NEAR(std::stod(cell), scene.nodes.back()[k], 1e-9);
  }
  EXPECT_EQ(all_between(text, "<k>", "</k>"), (std::vector<std::string>{"1220000", "406232"}));
  EXPECT_EQ(all_between(text, "<W>", "</W>").at(0),
            "(310)*(I1-3)+(300)*(I2-3)+(2250)*(I1-3)^2+(3800)*(I2-3)^2+(4720)*(I1-3)*(I2-3)");
  EXPECT_EQ(all_between(text, "<W>", "</W>").at(1),
            "(92.39)*(exp((4.4)*(I1-3))-1)+(-203.4)*(I2-3)");
  EXPECT_EQ(all_between(text, "<y lc=\"1\">", "</y>").at(0), "-9810");  // pulls along +y
  // Every tag is closed in order.
  std::vector<std::string> open;
  for (const std::string& tag : all_between(text, "<", ">")) {
    if (tag[0] == '?' || tag[0] == '!' || tag.back() == '/') continue;
    const std::string name = tag.substr(tag[0] == '/', tag.find(' ') - (tag[0] == '/'));
    if (tag[0] != '/') {
      open.push_back(name);
    } else {
      ASSERT_FALSE(open.empty());
      EXPECT_EQ(open.back(), name);
      open.pop_back();
    }
  }
  EXPECT_TRUE(open.empty());
}

TEST(Deck, RefusesWhatAnotherProgramCannotSay) {
  const HexMesh skinned = fixtures::cap({.elements = 4});
  EXPECT_THROW(deck_scene(skinned, options(), gravity, false), Error);
  EXPECT_EQ(deck_scene(skinned, options(), gravity, true).elements(), skinned.elements());
  MechanicsOptions o = options();
  o.bulk_ratio = 0;
  EXPECT_THROW(deck_scene(small_cap(), o, gravity, false), Error);
  o = options();
  o.invariants = Invariants::plain;
  EXPECT_THROW(deck_scene(small_cap(), o, gravity, false), Error);
  o = options();
  o.materials.laws[std::size_t(Tissue::fat)] = {"exponential", {92.39, 4.4, -203.4}};
  const DeckScene scene = deck_scene(small_cap(), o, gravity, false);
  EXPECT_THROW(calculix_deck(scene, "C3D8"), Error);
  EXPECT_THROW(calculix_deck(scene, "C3D20R"), Error);
  EXPECT_THROW(calculix_deck(scene, "S4"), Error);
}

// A quadratic displacement without the terms 20 nodes do not have comes back exactly.
TEST(Deck, CentresOfQuadraticElements) {
  const HexMesh mesh = raise_order(small_cap());
  const auto field = [](const Vec3& x) {
    return Vec3(1 + x.x() * x.y(), x.z() - 2 * x.y(), x.x() + x.y() * x.z());
  };
  const auto values = serendipity_shape(Vec3(0.3, -0.2, 0.7));
  double sum = 0;
  Vec3 at = Vec3::Zero();
  for (int a = 0; a < 20; ++a) {
    sum += values[a];
    at += values[a] * hex_node_local(2, a);
  }
  EXPECT_NEAR(sum, 1, 1e-14);
  EXPECT_LT((at - Vec3(0.3, -0.2, 0.7)).norm(), 1e-14);
  // On a box the field in x is the same polynomial in the local coordinates.
  HexMesh box = raise_order(fixtures::block({.elements = {2, 1, 1}, .size = {4, 3, 2}}));
  std::vector<Vec3> displacement;
  for (const int node : deck_nodes(box)) displacement.push_back(0.5 * field(box.reference[node]));
  EXPECT_EQ(displacement.size(), 32u);
  apply_displacement(box, displacement);
  for (int i = 0; i < box.nodes(); ++i) {
    EXPECT_LT((box.points[i] - box.reference[i] - 0.5 * field(box.reference[i])).norm(), 1e-12);
  }
  // gather is the transpose of interpolate: the same work.
  std::vector<Vec3> u(std::size_t(mesh.nodes()), Vec3::Zero()), f = u;
  for (int i = 0; i < mesh.nodes(); ++i) {
    u[i] = field(mesh.imaged[i]);
    f[i] = Vec3(fixtures::noise(3 * i), fixtures::noise(3 * i + 1), fixtures::noise(3 * i + 2));
  }
  interpolate_centres(mesh, u);
  double work = 0, gathered = 0, size = 0;
  for (int i = 0; i < mesh.nodes(); ++i) {
    work += u[i].dot(f[i]);
    size += std::abs(u[i].dot(f[i]));
  }
  gather_centres(mesh, f);
  for (int i = 0; i < mesh.nodes(); ++i) gathered += u[i].dot(f[i]);
  EXPECT_NEAR(work, gathered, 1e-12 * size);
}

class Results : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  ScratchFolder folder_;
};

const std::string frd_head = "  100CL  101 1.000000000           2                     0    1\n";
const std::string frd_data =
    " -4  DISP        4    1\n -5  D1          1    2    1    0\n"
    " -1         1 0.00000E+00 1.00000E-01-2.00000E+00\n"
    " -1         2-1.50000E+01 3.00000E+00 4.00000E+00\n -3\n";

TEST_F(Results, Frd) {
  write("run.dat",
        " total force (fx,fy,fz) for set HELD and time  0.1E+01\n\n  1.0E+00 2.0 -3.0\n");
  const DeckResult result = read_deck_result(write("run.frd", frd_head + frd_data), 2);
  EXPECT_EQ(result.displacement[0], Vec3(0, 0.1, -2));
  EXPECT_EQ(result.displacement[1], Vec3(-15, 3, 4));
  ASSERT_TRUE(result.reaction);
  EXPECT_EQ(*result.reaction, Vec3(1, 2, -3));
}

// As ccx writes them: %12.5E takes 13 columns for a negative number with an exponent of three digits.
TEST_F(Results, FrdWithExponentsOfThreeDigits) {
  const std::string data =
      " -4  DISP        4    1\n"
      " -1         1-3.22000E-104 1.00000E-011.00000E-104\n"
      " -1         2-1.50000E+01-3.22000E-104-4.00000E+00\n"
      " -1         31.00000E-1041.00000E-104-2.00000E-100\n -3\n";
  const auto u = read_deck_result(write("run.frd", frd_head + data), 3).displacement;
  EXPECT_EQ(u[0], Vec3(-3.22e-104, 0.1, 1e-104));
  EXPECT_EQ(u[1], Vec3(-15, -3.22e-104, -4));
  EXPECT_EQ(u[2], Vec3(1e-104, 1e-104, -2e-100));
}

TEST_F(Results, FrdInTheShortForm) {
  std::string head = frd_head;
  head.resize(63);  // behind the number of the step
  const std::string data =
      " -4  DISP        4    1\n"
      " -1    1 0.00000E+00 1.00000E-01-2.00000E+00\n"
      " -1    2-1.50000E+01 3.00000E+00-4.00000E-101\n -3\n";
  const auto u = read_deck_result(write("run.frd", head + std::string(10, ' ') + " 0\n" + data), 2)
                     .displacement;
  EXPECT_EQ(u[0], Vec3(0, 0.1, -2));
  EXPECT_EQ(u[1], Vec3(-15, 3, -4e-101));
  try {
    read_deck_result(write("run.frd", head + std::string(10, ' ') + " 2\n" + data), 2);
    ADD_FAILURE() << "binary";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("format 2"), std::string::npos) << error.what();
  }
}

TEST_F(Results, OnesFartherThanTheBreastIsLargeAreRefused) {
  HexMesh box = fixtures::block({.elements = {2, 1, 1}, .size = {4, 3, 2}});
  std::vector<Vec3> displacement(deck_nodes(box).size(), Vec3(5, 0, 0));
  apply_displacement(box, displacement);  // the box is 5.4 mm large
  displacement[3] = Vec3(0, 0, 1e5);
  try {
    apply_displacement(box, displacement);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_NE(std::string(error.what()).find("node 4 is 100000 mm: must be at most 10.77"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(Results, LastBlockOfALogCounts) {
  const DeckResult result =
      read_deck_result(write("d.log",
                             "*Step  = 1\n*Time  = 0.5\n*Data  = ux;uy;uz\n1,9,9,9\n2,9,9,9\n"
                             "*Step  = 2\n*Time  = 1\n*Data  = ux;uy;uz\n1,1,2,3\n2,4e-1,5,-6\n"),
                       2);
  EXPECT_EQ(result.displacement[0], Vec3(1, 2, 3));
  EXPECT_EQ(result.displacement[1], Vec3(0.4, 5, -6));
  EXPECT_FALSE(result.reaction);
}

// Every word of a line takes sixteen times its bytes.
TEST_F(Results, EndlessLinesAreRefused) {
  for (const char* name : {"long.log", "long.dat", "long.frd"}) {
    std::string line;
    for (int n = 0; n < 100000; ++n) line += " 1";
    try {
      read_deck_result(write(name, line), 2);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      EXPECT_NE(std::string(error.what()).find("a line of more than"), std::string::npos)
          << error.what();
    }
  }
}

TEST_F(Results, IncompleteOnesAreRefused) {
  const auto kind_of = [&](const std::string& name, const std::string& text, int nodes) {
    try {
      read_deck_result(write(name, text), nodes);
    } catch (const Error& error) {
      return int(error.kind());
    }
    return -1;
  };
  const int input = int(ErrorKind::input), stopped = int(ErrorKind::not_converged);
  EXPECT_EQ(kind_of("a.frd", frd_head + frd_data, 3), input);  // a node is missing
  EXPECT_EQ(kind_of("b.frd", frd_head + frd_data, 1), input);  // one too many
  EXPECT_EQ(kind_of("c.frd", "  100CL  101 0.460000000           2\n" + frd_data, 2), stopped);
  EXPECT_EQ(kind_of("d.frd", "    1C\n 9999\n", 2), stopped);
  EXPECT_EQ(kind_of("e.log", "1,1,2,nan\n", 1), input);
  EXPECT_EQ(kind_of("f.txt", "1,1,2,3\n", 1), input);
}

}  // namespace
}  // namespace breast
