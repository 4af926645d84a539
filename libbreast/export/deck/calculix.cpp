// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/deck/calculix.hpp"

#include <algorithm>
#include <sstream>

#include "core/error.hpp"
#include "export/deck/format.hpp"

namespace breast {

namespace {

std::string set_name(Tissue tissue) {
  std::string name(tissue_name(tissue));
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return char(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c); });
  return name;
}

void check_element(const DeckScene& scene, const std::string& element) {
  const bool linear = element == "C3D8" || element == "C3D8I" || element == "C3D8R";
  const bool quadratic = element == "C3D20" || element == "C3D20R";
  if (!linear && !quadratic) {
    throw input_error("CalculiX element '", element,
                      "': use one of C3D8, C3D8I, C3D8R, C3D20, C3D20R");
  }
  if (linear != (scene.nodes_per_element == 8)) {
    throw input_error("CalculiX element ", element, ": this scene has elements of ",
                      scene.nodes_per_element, " nodes; give --element ", linear ? "q1p0" : "q2p1",
                      " and a matching mesh");
  }
}

// D2 of a term (J−1)⁴/D2 that is not wanted. Not 0: CalculiX takes 0 as "not given" and
// chooses a stiff one of its own (6.7e-9 for fat, 8 % too stiff at K/μ = 5), where
// Abaqus leaves the term out.
constexpr double no_term = 1e20;

void write_material(const DeckMaterial& material, std::ostream& out) {
  const LawKind& kind = *material.law.kind;
  if (kind.calculix.type.empty()) {
    throw input_error("tissue ", tissue_name(material.tissue), ": CalculiX and Abaqus have no ",
                      kind.name, " law; give it another one in --materials FILE",
                      material.tissue == Tissue::skin
                          ? ", or mesh without a layer of skin (hexmesh --skin 0)"
                          : "");
  }
  const double d1 = 2 / material.bulk_modulus;
  out << "*MATERIAL, NAME=" << set_name(material.tissue) << "\n*HYPERELASTIC, "
      << kind.calculix.type << "\n"
      << with_constants(kind.calculix.body, material.law,
                        {{"D1", d1}, {"D2", no_term}, {"D3", no_term}})
      << "\n*DENSITY\n"
      << deck_number(material.density) << "\n*SOLID SECTION, ELSET=" << set_name(material.tissue)
      << ", MATERIAL=" << set_name(material.tissue) << "\n";
}

void write_elements(const DeckScene& scene, Tissue tissue, const std::string& type,
                    std::ostream& out) {
  out << "*ELEMENT, TYPE=" << type << ", ELSET=" << set_name(tissue) << "\n";
  for (int e = 0; e < scene.elements(); ++e) {
    if (scene.tissue[e] != tissue) continue;
    out << e + 1;
    for (int a = 0; a < scene.nodes_per_element; ++a) {
      // At most 16 entries a line.
      out << (a == 15 ? ",\n" : ",")
          << scene.connectivity[std::size_t(e) * scene.nodes_per_element + a] + 1;
    }
    out << "\n";
  }
}

// n·u = 0; the first term is the one the program eliminates.
void write_rollers(const DeckScene& scene, std::ostream& out) {
  for (const DeckRoller& roller : scene.rolling) {
    int first = 0;
    roller.normal.cwiseAbs().maxCoeff(&first);
    out << "*EQUATION\n3\n";
    for (int k = 0; k < 3; ++k) {
      const int axis = (first + k) % 3;
      out << (k ? "," : "") << roller.node + 1 << "," << axis + 1 << ","
          << deck_number(roller.normal[axis]);
    }
    out << "\n";
  }
}

void write_step(const DeckScene& scene, std::ostream& out) {
  out << "*STEP, NLGEOM, INC=10000\n*STATIC\n0.1,1.,1e-5,1.\n*CLOAD\n";
  const std::vector<Vec3> load = free_load(scene);
  for (std::size_t node = 0; node < load.size(); ++node) {
    for (int axis = 0; axis < 3; ++axis) {
      if (load[node][axis] == 0) continue;
      out << node + 1 << "," << axis + 1 << "," << deck_number(load[node][axis]) << "\n";
    }
  }
  out << "*NODE PRINT, NSET=HELD, TOTALS=ONLY, FREQUENCY=10000\nRF\n"
      << "*NODE FILE, FREQUENCY=10000\nU\n*END STEP\n";
}

}  // namespace

std::string calculix_deck(const DeckScene& scene, const std::string& element) {
  check_element(scene, element);
  std::ostringstream out;
  out << "** Written by libbreast. Breast under gravity (" << deck_vector(scene.gravity)
      << " mm/s2) as nodal forces. Units mm, g, s: Pa and uN.\n** Positions are the stress-free "
         "shape.\n*NODE, NSET=ALL\n";
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    out << i + 1 << "," << deck_vector(scene.nodes[i]) << "\n";
  }
  for (const DeckMaterial& material : scene.materials) {
    write_elements(scene, material.tissue, element, out);
  }
  out << "*NSET, NSET=HELD\n";
  for (const int node : scene.held) out << node + 1 << "\n";
  for (const DeckMaterial& material : scene.materials) write_material(material, out);
  write_rollers(scene, out);
  out << "*BOUNDARY\nHELD,1,3\n";
  write_step(scene, out);
  return out.str();
}

}  // namespace breast
