// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5/hermite_group.hpp"

#include <cmath>

#include "io/hdf5/thorax_group.hpp"
#include "surface/rim_border.hpp"

namespace breast {

namespace {

const std::string hermite_group = "/breast/hermite";
constexpr int most_patches = 1000;
constexpr std::size_t least_rim_points = 32;

void put_sheet(Document& document, const std::string& path, const HermiteSheet& sheet) {
  const std::size_t ni = std::size_t(sheet.nu) + 1, nj = std::size_t(sheet.nv) + 1;
  const auto put_vectors = [&](const char* name, Vec3 HermiteSheet::Node::*member) {
    std::vector<Vec3> list;
    for (const HermiteSheet::Node& node : sheet.nodes) list.push_back(node.*member);
    document.datasets[path + "/" + name] = reshaped(array_of(list), {nj, ni, 3});
  };
  put_vectors("x", &HermiteSheet::Node::x);
  put_vectors("x_1", &HermiteSheet::Node::x_1);
  put_vectors("x_2", &HermiteSheet::Node::x_2);
  put_vectors("x_12", &HermiteSheet::Node::x_12);
  const auto put_scales = [&](const char* name, double HermiteSheet::Node::*member) {
    Doubles list;
    for (const HermiteSheet::Node& node : sheet.nodes) list.push_back(node.*member);
    document.datasets[path + "/" + name] = reshaped(array_of(list), {nj, ni});
  };
  put_scales("scale_1", &HermiteSheet::Node::scale_1);
  put_scales("scale_2", &HermiteSheet::Node::scale_2);
  document.attributes[path + "@patches"] = array_of(Integers{sheet.nu, sheet.nv});
}

HermiteSheet get_sheet(Fields& fields, const std::string& path) {
  const Integers patches = fields.integer_list(path + "@patches", 2);
  for (const std::int64_t n : patches) {
    if (!(n >= 1 && n <= most_patches)) {
      throw fields.complain()("attribute ", path, "@patches is ", n, ", must be 1 to ",
                              most_patches);
    }
  }
  HermiteSheet sheet;
  sheet.nu = int(patches[0]);
  sheet.nv = int(patches[1]);
  const std::size_t ni = std::size_t(sheet.nu) + 1, nj = std::size_t(sheet.nv) + 1;
  sheet.nodes.resize(ni * nj);
  const auto get_vectors = [&](const char* name, Vec3 HermiteSheet::Node::*member) {
    const Doubles flat = fields.doubles(path + "/" + name, {nj, ni, 3});
    for (std::size_t n = 0; n < sheet.nodes.size(); ++n) {
      sheet.nodes[n].*member = Vec3(flat[3 * n], flat[3 * n + 1], flat[3 * n + 2]);
    }
  };
  get_vectors("x", &HermiteSheet::Node::x);
  get_vectors("x_1", &HermiteSheet::Node::x_1);
  get_vectors("x_2", &HermiteSheet::Node::x_2);
  get_vectors("x_12", &HermiteSheet::Node::x_12);
  const auto get_scales = [&](const char* name, double HermiteSheet::Node::*member) {
    const Doubles flat = fields.doubles(path + "/" + name, {nj, ni});
    for (std::size_t n = 0; n < sheet.nodes.size(); ++n) sheet.nodes[n].*member = flat[n];
  };
  get_scales("scale_1", &HermiteSheet::Node::scale_1);
  get_scales("scale_2", &HermiteSheet::Node::scale_2);
  return sheet;
}

Array rim_array(const std::vector<Vec2>& rim) {
  Doubles flat;
  for (const Vec2& st : rim) flat.insert(flat.end(), {st.x(), st.y()});
  return {{rim.size(), 2}, std::move(flat)};
}

std::vector<Vec2> get_rim(Fields& fields, const std::string& path, std::size_t count) {
  const Doubles flat = fields.doubles(path, {count, 2});
  std::vector<Vec2> rim(flat.size() / 2);
  for (std::size_t i = 0; i < rim.size(); ++i) rim[i] = {flat[2 * i], flat[2 * i + 1]};
  return rim;
}

void check_sheet(const HermiteSheet& sheet, const std::string& path, const Complaint& complain) {
  if (!(sheet.nu >= 1 && sheet.nv >= 1 && sheet.nu <= most_patches && sheet.nv <= most_patches)) {
    throw complain(path, " has ", sheet.nu, " x ", sheet.nv, " patches, must be 1 to ",
                   most_patches);
  }
  if (sheet.nodes.size() != std::size_t(sheet.nu + 1) * (sheet.nv + 1)) {
    throw complain(path, " has ", sheet.nodes.size(), " nodes, must be ",
                   std::size_t(sheet.nu + 1) * (sheet.nv + 1));
  }
  for (std::size_t n = 0; n < sheet.nodes.size(); ++n) {
    if (!(sheet.nodes[n].scale_1 > 0 && sheet.nodes[n].scale_2 > 0)) {
      throw complain("dataset ", path, "/scale_1 or scale_2 node ", n, " is ",
                     sheet.nodes[n].scale_1, " or ", sheet.nodes[n].scale_2, ", must be positive");
    }
    const HermiteSheet::Node& node = sheet.nodes[n];
    for (const Vec3& arm : {node.x, Vec3(node.scale_1 * node.x_1), Vec3(node.scale_2 * node.x_2),
                            Vec3(node.scale_1 * node.scale_2 * node.x_12)}) {
      if (arm.cwiseAbs().maxCoeff() <= Fields::farthest_mm) continue;
      throw complain("dataset ", path, "/x or its scaled derivatives at node ", n, " is ",
                     arm.transpose(), " mm, must be within ", Fields::farthest_mm);
    }
  }
}

void check_rim(const std::vector<Vec2>& rim, const std::string& path, const Complaint& complain) {
  for (std::size_t i = 0; i < rim.size(); ++i) {
    for (int d = 0; d < 2; ++d) {
      if (!(rim[i][d] >= 0 && rim[i][d] <= 1)) {
        throw complain("dataset ", path, "[", i, ",", d, "] is ", rim[i][d], ", must be 0 to 1");
      }
    }
  }
}

}  // namespace

bool has_sheets(const BreastGeometry& geometry) {
  return !geometry.skin.nodes.empty() || !geometry.wall.nodes.empty() || !geometry.thorax;
}

void check_geometry(const BreastGeometry& geometry, const Complaint& complain) {
  if (!has_sheets(geometry)) return;
  check_sheet(geometry.skin, hermite_group + "/skin", complain);
  check_sheet(geometry.wall, hermite_group + "/wall", complain);
  const std::size_t n = geometry.rim_skin.size();
  if (n < least_rim_points || geometry.rim_wall.size() != n || geometry.rim_end.size() != n) {
    throw complain(hermite_group, "/rim has ", n, " skin, ", geometry.rim_wall.size(), " wall and ",
                   geometry.rim_end.size(), " end entries, must be equal and at least ",
                   least_rim_points);
  }
  check_rim(geometry.rim_skin, hermite_group + "/rim/skin", complain);
  check_rim(geometry.rim_wall, hermite_group + "/rim/wall", complain);
  for (std::size_t i = 0; i < n; ++i) {
    if (geometry.rim_end[i] > RimEnd::margin) {
      throw complain("dataset ", hermite_group, "/rim/end[", i, "] is ", int(geometry.rim_end[i]),
                     ", must be 0 to 2");
    }
  }
  check_rim({geometry.centre}, hermite_group + "/rim@centre", complain);
  check_rim({geometry.nipple_st}, hermite_group + "@nipple_st", complain);
  if (!(geometry.skin_thickness >= 0)) {
    throw complain("attribute ", hermite_group, "@skin_thickness is ", geometry.skin_thickness,
                   ", must be 0 or more");
  }
}

void put_hermite(Document& document, const BreastGeometry& geometry) {
  if (geometry.thorax) put_thorax(document, *geometry.thorax);
  if (!has_sheets(geometry)) return;
  put_sheet(document, hermite_group + "/skin", geometry.skin);
  put_sheet(document, hermite_group + "/wall", geometry.wall);
  document.datasets[hermite_group + "/rim/skin"] = rim_array(geometry.rim_skin);
  document.datasets[hermite_group + "/rim/wall"] = rim_array(geometry.rim_wall);
  Bytes ends;
  for (const RimEnd end : geometry.rim_end) ends.push_back(std::uint8_t(end));
  document.datasets[hermite_group + "/rim/end"] = array_of(std::move(ends));
  Bytes borders;
  for (const RimBorder border : rim_borders(geometry)) borders.push_back(std::uint8_t(border));
  document.datasets[hermite_group + "/rim/border"] = array_of(std::move(borders));
  auto& attributes = document.attributes;
  attributes[hermite_group + "/rim@centre"] =
      array_of(Doubles{geometry.centre.x(), geometry.centre.y()});
  attributes[hermite_group + "@nipple_st"] =
      array_of(Doubles{geometry.nipple_st.x(), geometry.nipple_st.y()});
  attributes[hermite_group + "@nipple"] = array_of(geometry.nipple);
  attributes[hermite_group + "@skin_thickness"] = array_of(geometry.skin_thickness);
  attributes[hermite_group + "@fit_mean_mm"] = array_of(geometry.fit_mean_mm);
  attributes[hermite_group + "@fit_p95_mm"] = array_of(geometry.fit_p95_mm);
  attributes[hermite_group + "@fit_max_mm"] = array_of(geometry.fit_max_mm);
}

BreastGeometry get_hermite(Fields& fields) {
  BreastGeometry geometry;
  geometry.skin = get_sheet(fields, hermite_group + "/skin");
  geometry.wall = get_sheet(fields, hermite_group + "/wall");
  if (has_thorax(fields)) geometry.thorax = get_thorax(fields);
  geometry.rim_skin = get_rim(fields, hermite_group + "/rim/skin", Fields::any);
  const std::size_t n = geometry.rim_skin.size();
  geometry.rim_wall = get_rim(fields, hermite_group + "/rim/wall", n);
  for (const std::uint8_t end : fields.bytes(hermite_group + "/rim/end", {n})) {
    geometry.rim_end.push_back(static_cast<RimEnd>(end));
  }
  const Doubles centre = fields.numbers(hermite_group + "/rim@centre", 2);
  const Doubles nipple_st = fields.numbers(hermite_group + "@nipple_st", 2);
  geometry.centre = {centre[0], centre[1]};
  geometry.nipple_st = {nipple_st[0], nipple_st[1]};
  geometry.nipple = fields.place(hermite_group + "@nipple");
  geometry.skin_thickness = fields.number(hermite_group + "@skin_thickness");
  geometry.fit_mean_mm = fields.number(hermite_group + "@fit_mean_mm");
  geometry.fit_p95_mm = fields.number(hermite_group + "@fit_p95_mm");
  geometry.fit_max_mm = fields.number(hermite_group + "@fit_max_mm");
  return geometry;
}

}  // namespace breast
