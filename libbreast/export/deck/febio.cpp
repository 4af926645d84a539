// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/deck/febio.hpp"

#include <sstream>

#include "core/error.hpp"
#include "export/deck/format.hpp"

namespace breast {

namespace {

void write_material(const DeckMaterial& material, int id, std::ostream& out) {
  const LawKind& kind = *material.law.kind;
  if (kind.febio.type.empty()) {
    throw input_error("tissue ", tissue_name(material.tissue), ": FEBio has no ", kind.name,
                      " law; give it another one in --materials FILE");
  }
  out << "    <material id=\"" << id << "\" name=\"" << tissue_name(material.tissue) << "\" type=\""
      << kind.febio.type << "\">\n      "
      << "<density>" << deck_number(material.density) << "</density><k>"
      << deck_number(material.bulk_modulus) << "</k>"
      << with_constants(kind.febio.body, material.law) << "\n    </material>\n";
}

void write_mesh(const DeckScene& scene, std::ostream& out) {
  out << "  <Mesh>\n    <Nodes name=\"breast\">\n";
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    out << "      <node id=\"" << i + 1 << "\">" << deck_vector(scene.nodes[i]) << "</node>\n";
  }
  out << "    </Nodes>\n";
  for (const DeckMaterial& material : scene.materials) {
    out << "    <Elements type=\"hex" << scene.nodes_per_element << "\" name=\""
        << tissue_name(material.tissue) << "\">\n";
    for (int e = 0; e < scene.elements(); ++e) {
      if (scene.tissue[e] != material.tissue) continue;
      out << "      <elem id=\"" << e + 1 << "\">";
      for (int a = 0; a < scene.nodes_per_element; ++a) {
        out << (a ? "," : "")
            << scene.connectivity[std::size_t(e) * scene.nodes_per_element + a] + 1;
      }
      out << "</elem>\n";
    }
    out << "    </Elements>\n";
  }
  out << "    <NodeSet name=\"held\">";
  for (std::size_t i = 0; i < scene.held.size(); ++i) out << (i ? "," : "") << scene.held[i] + 1;
  out << "</NodeSet>\n  </Mesh>\n  <MeshDomains>\n";
  for (const DeckMaterial& material : scene.materials) {
    out << "    <SolidDomain name=\"" << tissue_name(material.tissue) << "\" mat=\""
        << tissue_name(material.tissue) << "\"/>\n";
  }
  out << "  </MeshDomains>\n";
}

}  // namespace

std::string febio_deck(const DeckScene& scene) {
  if (!scene.rolling.empty()) {
    throw input_error("--cut roller is not written for FEBio: use free or fixed, or CalculiX");
  }
  std::ostringstream out;
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<febio_spec version=\"4.0\">\n"
         "  <!-- Written by libbreast. Breast under gravity from its stress-free shape. "
         "Units mm, g, s: Pa and uN. -->\n"
         "  <Module type=\"solid\"/>\n  <Control>\n    <analysis>STATIC</analysis>\n"
         "    <time_steps>10</time_steps>\n    <step_size>0.1</step_size>\n"
         "    <time_stepper type=\"default\"><dtmin>1e-4</dtmin><dtmax>0.1</dtmax>"
         "<max_retries>12</max_retries></time_stepper>\n"
         "    <solver type=\"solid\"><symmetric_stiffness>symmetric</symmetric_stiffness>"
         "<qn_method type=\"BFGS\"/></solver>\n  </Control>\n  <Material>\n";
  int id = 0;
  for (const DeckMaterial& material : scene.materials) write_material(material, ++id, out);
  out << "  </Material>\n";
  write_mesh(scene, out);
  // FEBio's sign: a body force (0,0,+g) pulls along −z.
  out << "  <Boundary>\n    <bc name=\"wall\" node_set=\"held\" type=\"zero displacement\">"
         "<x_dof>1</x_dof><y_dof>1</y_dof><z_dof>1</z_dof></bc>\n  </Boundary>\n  <Loads>\n"
         "    <body_load name=\"gravity\" type=\"const\">";
  for (int axis = 0; axis < 3; ++axis) {
    out << "<"
        << "xyz"[axis] << " lc=\"1\">" << deck_number(0 - scene.gravity[axis]) << "</"
        << "xyz"[axis] << ">";
  }
  out << "</body_load>\n  </Loads>\n  <LoadData>\n"
         "    <load_controller id=\"1\" type=\"loadcurve\"><interpolate>LINEAR</interpolate>"
         "<points><pt>0,0</pt><pt>1,1</pt></points></load_controller>\n  </LoadData>\n  <Output>\n"
         "    <plotfile type=\"febio\"><var type=\"displacement\"/></plotfile>\n"
         "    <logfile><node_data data=\"ux;uy;uz\" delim=\",\" file=\"displacement.log\"/>"
         "</logfile>\n  </Output>\n</febio_spec>\n";
  return out.str();
}

}  // namespace breast
