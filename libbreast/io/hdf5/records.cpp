// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5/records.hpp"

#include <limits>

namespace breast {

namespace {

constexpr long int_limit = std::numeric_limits<int>::max();
const std::string model_group = "/breast/model", solve_group = "/breast/solve",
                  contact_group = "/breast/contact", plates_group = "/breast/contact/plates",
                  friction_group = "/breast/contact/friction";

// One column of a table of records.
template <class Record, class Member>
auto column(const std::vector<Record>& records, Member member) {
  std::vector<std::decay_t<decltype(records.front().*member)>> list;
  for (const Record& record : records) list.push_back(record.*member);
  return list;
}

struct IterationColumn {
  const char* name;
  double IterationRecord::*member;
};
constexpr IterationColumn iteration_columns[] = {{"residual", &IterationRecord::residual},
                                                 {"min_det_F", &IterationRecord::min_det_F},
                                                 {"max_det_F", &IterationRecord::max_det_F},
                                                 {"step_length", &IterationRecord::step_length},
                                                 {"seconds", &IterationRecord::seconds}};

struct PlateColumn {
  const char* name;
  double PlateRecord::*member;
};
constexpr PlateColumn plate_columns[] = {
    {"edge_radius", &PlateRecord::edge_radius}, {"force_N", &PlateRecord::force_N},
    {"area_cm2", &PlateRecord::area_cm2},       {"mean_kPa", &PlateRecord::mean_kPa},
    {"peak_kPa", &PlateRecord::peak_kPa},       {"worst_gap_mm", &PlateRecord::worst_gap_mm}};
struct PlateAxis {
  const char* name;
  Vec3 PlateRecord::*member;
};
const PlateAxis plate_axes[] = {{"normal", &PlateRecord::normal},
                                {"anterior", &PlateRecord::anterior},
                                {"origin", &PlateRecord::origin}};

struct ContactNumber {
  const char* name;
  double ContactRecord::*member;
};
constexpr ContactNumber contact_numbers[] = {
    {"angle_deg", &ContactRecord::angle_deg},
    {"thickness_mm", &ContactRecord::thickness_mm},
    {"reduction_percent", &ContactRecord::reduction_percent},
    {"initial_thickness_mm", &ContactRecord::initial_thickness_mm},
    {"standoff_mm", &ContactRecord::standoff_mm},
    {"paddle_share", &ContactRecord::paddle_share},
    {"turn_deg", &ContactRecord::turn_deg},
    {"lean_deg", &ContactRecord::lean_deg},
    {"bend_deg", &ContactRecord::bend_deg},
    {"surface_stiffness", &ContactRecord::surface_stiffness}};

std::vector<FrictionRecord> get_friction(Fields& fields) {
  const auto nodes = fields.indices(friction_group + "/node", {Fields::any}, 0, int_limit);
  const auto plates = fields.indices(friction_group + "/plate", {nodes.size()}, 0, 2);
  const auto anchors = fields.places(friction_group + "/anchor", nodes.size());
  const Doubles bounds = fields.doubles(friction_group + "/bound", {nodes.size()});
  const Doubles sticks = fields.doubles(friction_group + "/stick", {nodes.size()});
  std::vector<FrictionRecord> list;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    list.push_back({int(nodes[i]), int(plates[i]), anchors[i], bounds[i], sticks[i]});
  }
  return list;
}

}  // namespace

void put_model(Document& document, const ModelText& model) {
  for (const auto& [name, text] : model_parts)
    document.attributes[model_group + "@" + name] = array_of(model.*text);
}

ModelText get_model(Fields& fields) {
  ModelText model;
  for (const auto& [name, text] : model_parts) model.*text = fields.text(model_group + "@" + name);
  return model;
}

void put_solve(Document& document, const SolveRecord& solve) {
  document.attributes[solve_group + "@status"] = array_of(std::string(status_name(solve.status)));
  document.attributes[solve_group + "@reason"] = array_of(solve.reason);
  Integers steps, iterations;
  for (const IterationRecord& row : solve.iterations) {
    steps.push_back(row.step);
    iterations.push_back(row.iteration);
  }
  document.datasets[solve_group + "/step"] = array_of(std::move(steps));
  document.datasets[solve_group + "/iteration"] = array_of(std::move(iterations));
  for (const auto& [name, member] : iteration_columns) {
    document.datasets[solve_group + "/" + name] = array_of(column(solve.iterations, member));
  }
}

SolveRecord get_solve(Fields& fields) {
  SolveRecord solve;
  const std::string status = fields.text(solve_group + "@status");
  const std::optional<SolveStatus> known = status_from_name(status);
  if (!known) {
    throw fields.complain()(
        solve_group, "@status '", status,
        "' is unknown: converged, stopped_early, not_gripped, unstable or not_converged");
  }
  solve.status = *known;
  solve.reason = fields.text(solve_group + "@reason");
  const auto steps = fields.indices(solve_group + "/step", {Fields::any}, -int_limit, int_limit);
  const auto iterations =
      fields.indices(solve_group + "/iteration", {steps.size()}, -int_limit, int_limit);
  solve.iterations.resize(steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    solve.iterations[i].step = steps[i];
    solve.iterations[i].iteration = iterations[i];
  }
  for (const auto& [name, member] : iteration_columns) {
    const Doubles list = fields.doubles(solve_group + "/" + name, {steps.size()});
    for (std::size_t i = 0; i < steps.size(); ++i) solve.iterations[i].*member = list[i];
  }
  return solve;
}

void put_contact(Document& document, const ContactRecord& contact) {
  document.attributes[contact_group + "@view"] = array_of(view_name(contact.view));
  for (const auto& [name, member] : contact_numbers) {
    document.attributes[contact_group + "@" + name] = array_of(contact.*member);
  }
  document.attributes[contact_group + "@ends_image"] = array_of(contact.ends_image ? 1.0 : 0.0);
  auto& sets = document.datasets;
  sets[plates_group + "/name"] = array_of(column(contact.plates, &PlateRecord::name));
  for (const auto& [name, member] : plate_axes) {
    sets[plates_group + "/" + name] = array_of(column(contact.plates, member));
  }
  for (const auto& [name, member] : plate_columns) {
    sets[plates_group + "/" + name] = array_of(column(contact.plates, member));
  }
  sets[contact_group + "/face_rules"] =
      array_of(Integers(contact.face_rules.begin(), contact.face_rules.end()));
  Integers nodes, plates;
  for (const FrictionRecord& held : contact.friction) {
    nodes.push_back(held.node);
    plates.push_back(held.plate);
  }
  sets[friction_group + "/node"] = array_of(std::move(nodes));
  sets[friction_group + "/plate"] = array_of(std::move(plates));
  sets[friction_group + "/anchor"] = array_of(column(contact.friction, &FrictionRecord::anchor));
  sets[friction_group + "/bound"] = array_of(column(contact.friction, &FrictionRecord::bound));
  sets[friction_group + "/stick"] = array_of(column(contact.friction, &FrictionRecord::stick));
  sets[contact_group + "/path_thickness_mm"] = array_of(Doubles(contact.path_thickness_mm));
  sets[contact_group + "/path_force_N"] = array_of(Doubles(contact.path_force_N));
  sets[contact_group + "/path_detector_N"] = array_of(Doubles(contact.path_detector_N));
}

ContactRecord get_contact(Fields& fields) {
  ContactRecord contact;
  const std::string view = fields.text(contact_group + "@view");
  const std::optional<View> known = view_from_name(view);
  if (!known)
    throw fields.complain()(contact_group, "@view '", view, "' is unknown: CC, MLO or ML");
  contact.view = *known;
  for (const auto& [name, member] : contact_numbers) {
    contact.*member = fields.number(contact_group + "@" + name);
  }
  if (!(contact.paddle_share >= 0 && contact.paddle_share <= 1)) {
    throw fields.complain()("attribute ", contact_group, "@paddle_share is ", contact.paddle_share,
                            ", must lie within 0 and 1");
  }
  if (!(contact.surface_stiffness >= 0)) {
    throw fields.complain()("attribute ", contact_group, "@surface_stiffness is ",
                            contact.surface_stiffness, " Pa/mm, must be 0 or more");
  }
  contact.ends_image = fields.number(contact_group + "@ends_image") != 0;
  const Texts names = fields.texts(plates_group + "/name", {Fields::any});
  if (names != Texts{"paddle", "detector"}) {
    throw fields.complain()("dataset ", plates_group, "/name must be 'paddle' and 'detector'");
  }
  contact.plates.resize(names.size());
  for (std::size_t p = 0; p < names.size(); ++p) contact.plates[p].name = names[p];
  for (const auto& [name, member] : plate_axes) {
    const auto list = fields.places(plates_group + "/" + name, names.size());
    for (std::size_t p = 0; p < names.size(); ++p) contact.plates[p].*member = list[p];
  }
  for (const auto& [name, member] : plate_columns) {
    const Doubles list = fields.doubles(plates_group + "/" + name, {names.size()});
    for (std::size_t p = 0; p < names.size(); ++p) contact.plates[p].*member = list[p];
  }
  contact.face_rules = fields.indices(contact_group + "/face_rules", {Fields::any}, 0, int_limit);
  if (contact.surface_stiffness > 0 && contact.face_rules.empty()) {
    throw fields.complain()("dataset ", contact_group,
                            "/face_rules is empty, but plates pressed on faces");
  }
  contact.friction = get_friction(fields);
  contact.path_thickness_mm = fields.doubles(contact_group + "/path_thickness_mm", {Fields::any});
  contact.path_force_N =
      fields.doubles(contact_group + "/path_force_N", {contact.path_thickness_mm.size()});
  contact.path_detector_N =
      fields.doubles(contact_group + "/path_detector_N", {contact.path_thickness_mm.size()});
  return contact;
}

}  // namespace breast
