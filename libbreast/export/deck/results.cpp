// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/deck/results.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <sstream>
#include <string_view>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "core/text/trimmed.hpp"
#include "export/deck/scene.hpp"
#include "export/deck/serendipity.hpp"
#include "mesh/part.hpp"

namespace breast {

namespace {

// Values by node as they are found; complete() asks that none is missing.
class NodeValues {
 public:
  NodeValues(std::string file, int nodes)
      : file_(std::move(file)), values_(std::size_t(nodes), Vec3::Constant(std::nan(""))) {}

  void clear() { values_.assign(values_.size(), Vec3::Constant(std::nan(""))); }
  void set(const std::string& node, const std::array<std::string, 3>& cells) {
    const double number = parse_number(node, file_ + ", node number");
    if (!(number >= 1) || !(number <= double(values_.size())) || number != std::floor(number)) {
      throw input_error(file_, ": node ", node, " is not among the ", values_.size(),
                        " of the deck; is this the result of another mesh?");
    }
    for (int k = 0; k < 3; ++k) {
      values_[std::size_t(number) - 1][k] = parse_number(cells[k], file_ + ", node " + node);
    }
  }
  const std::vector<Vec3>& complete() const {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (!values_[i].allFinite()) {
        throw input_error(file_, ": no displacement of node ", i + 1, " of ", values_.size(),
                          "; did the run finish?");
      }
    }
    return values_;
  }

 private:
  std::string file_;
  std::vector<Vec3> values_;
};

// Other programs also write the sign of positive numbers, which parse_number does not accept.
std::string number_text(const std::string& field) {
  const std::string text = trimmed(field);
  return text.starts_with('+') ? text.substr(1) : text;
}

// Words take sixteen times their bytes, and results of a million nodes have short lines.
void check_lines(const std::string& name, const std::string& text) {
  constexpr std::size_t longest = 65536;
  for (std::size_t from = 0, end = 0; from < text.size(); from = end + 1) {
    end = std::min(text.find('\n', from), text.size());
    if (end - from > longest) throw input_error(name, ": a line of more than ", longest, " bytes");
  }
}

// The next number of a row of %12.5E, taken off its beginning. One that is negative with an exponent of
// three digits takes 13 columns and moves the rest, so columns alone do not tell where it ends: it does
// at a blank, a sign that no 'E' precedes, or with the digit before a point, which begins the next one.
std::string take_number(std::string_view& row) {
  row.remove_prefix(std::min(row.find_first_not_of(' '), row.size()));
  const auto ends = [&](std::size_t i) {
    const bool exponent = row[i - 1] == 'E' || row[i - 1] == 'e';
    if ((row[i] == '-' || row[i] == '+') && !exponent) return true;
    return row[i] == ' ' || (i + 1 < row.size() && i > 1 && row[i + 1] == '.');
  };
  std::size_t end = std::min<std::size_t>(1, row.size());
  while (end < row.size() && !ends(end)) ++end;
  const std::string number(row.substr(0, end));
  row.remove_prefix(end);
  return number_text(number);
}

// Columns of a node number: 10, or 5 in the short form, by the last field of a block's 100C line.
std::size_t node_columns(const std::string& name, const std::string& block) {
  constexpr std::size_t format_at = 73;
  const std::string format = block.size() > format_at ? trimmed(block.substr(format_at, 2)) : "";
  if (format == "0") return 5;
  if (format.empty() || format == "1") return 10;
  throw input_error(name, ": format ", format,
                    " of cgx: text in the short (0) or long form (1) is read; let CalculiX write "
                    "*NODE FILE as text");
}

// CalculiX cgx format, ASCII: blocks headed by "100CL" (time in columns 12–24) and "-4  DISP". The time
// alone stays in its columns: it is not negative.
std::vector<Vec3> read_frd(const std::string& name, const std::string& text, int nodes) {
  check_lines(name, text);
  NodeValues values(name, nodes);
  std::istringstream in(text);
  double time = 0;
  bool in_block = false, found = false;
  std::size_t node_end = 13;
  for (std::string line; std::getline(in, line);) {
    if (line.compare(0, 7, "  100CL") == 0 && line.size() >= 24) {
      time = parse_number(number_text(line.substr(12, 12)), name + ", time");
      node_end = 3 + node_columns(name, line);
    } else if (line.compare(0, 9, " -4  DISP") == 0) {
      values.clear();
      in_block = found = true;
    } else if (line.compare(0, 3, " -3") == 0) {
      in_block = false;
    } else if (in_block && line.compare(0, 3, " -1") == 0) {
      if (line.ends_with('\r')) line.pop_back();
      constexpr std::size_t columns = 12;
      if (line.size() < node_end + 3 * columns)
        throw input_error(name, ": truncated line: '", line, "'");
      std::string_view row = std::string_view(line).substr(node_end);
      std::array<std::string, 3> u;
      for (std::string& one : u) one = take_number(row);
      if (!trimmed(row).empty())
        throw input_error(name, ": not three numbers of %12.5E: '", line, "'");
      values.set(number_text(line.substr(3, node_end - 3)), u);
    }
  }
  if (!found || !(time > 1 - 1e-6)) {
    throw not_converged_error(name, ": the run stopped at ", 100 * time,
                              " % of its load; see what the program printed");
  }
  return values.complete();
}

// Lines of a node number and three values, separated by commas or blanks; any other line that is
// not blank starts a new block, whose values count only if they follow.
std::vector<Vec3> read_lines(const std::string& name, const std::string& text, int nodes) {
  check_lines(name, text);
  NodeValues values(name, nodes);
  std::istringstream in(text);
  bool fresh = true;
  for (std::string line; std::getline(in, line);) {
    for (char& c : line) c = c == ',' || c == '\r' ? ' ' : c;
    std::istringstream cells(line);
    std::vector<std::string> words;
    for (std::string word; cells >> word;) words.push_back(word);
    if (words.empty()) continue;
    const bool row =
        words.size() == 4 && words[0].find_first_not_of("0123456789") == std::string::npos;
    if (!row) {
      fresh = true;
      continue;
    }
    if (fresh) values.clear();
    fresh = false;
    values.set(words[0], {number_text(words[1]), number_text(words[2]), number_text(words[3])});
  }
  return values.complete();
}

// "total force (fx,fy,fz) for set HELD and time ..." and the three numbers after it; the last one.
std::optional<Vec3> read_total_force(const std::string& name, const std::string& text) {
  const std::size_t title = text.rfind("total force");
  if (title == std::string::npos) return std::nullopt;
  std::istringstream in(text.substr(std::min(text.find('\n', title), text.size())));
  Vec3 force;
  for (int k = 0; k < 3; ++k) {
    std::string word;
    in >> word;
    force[k] = parse_number(number_text(word), name + ", total force");
  }
  return force;
}

// A breast held at its chest wall moves nowhere by twice its own size.
void check_lengths(const HexMesh& mesh, const std::vector<int>& nodes,
                   const std::vector<Vec3>& displacement) {
  Eigen::AlignedBox3d body;
  for (const Vec3& point : mesh.reference) body.extend(point);
  const double most = 2 * body.diagonal().norm();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (displacement[i].norm() <= most) continue;
    throw input_error(
        "displacement of node ", i + 1, " is ", displacement[i].norm(), " mm: must be at most ",
        most,
        " mm, twice the breast's own size; is it the result of another model, in another "
        "unit than mm, or of a run that diverged?");
  }
}

}  // namespace

DeckResult read_deck_result(const std::filesystem::path& file, int nodes) {
  const std::string name = file.filename().string(), ending = file.extension().string();
  DeckResult result;
  if (ending == ".frd") {
    result.displacement = read_frd(name, read_text(file), nodes);
    std::filesystem::path beside = file;
    beside.replace_extension(".dat");
    if (std::filesystem::exists(beside)) {
      result.reaction = read_total_force(beside.filename().string(), read_text(beside));
    }
  } else if (ending == ".dat" || ending == ".log") {
    result.displacement = read_lines(name, read_text(file), nodes);
  } else {
    throw input_error("--read-back ", name, ": its ending must be .frd, .dat or .log");
  }
  return result;
}

void apply_displacement(HexMesh& mesh, const std::vector<Vec3>& displacement) {
  const std::vector<int> nodes = deck_nodes(mesh);
  if (nodes.size() != displacement.size()) {
    throw input_error("displacements of ", displacement.size(), " nodes for a deck of ",
                      nodes.size());
  }
  check_lengths(mesh, nodes, displacement);
  std::vector<Vec3> u(mesh.reference.size(), Vec3::Zero());
  for (std::size_t i = 0; i < nodes.size(); ++i) u[nodes[i]] = displacement[i];
  if (mesh.order == 2) interpolate_centres(mesh, u);
  for (std::size_t i = 0; i < u.size(); ++i) mesh.points[i] = mesh.reference[i] + u[i];
  mesh.pressure.clear();
  mesh.det_F.clear();
  mesh.contact.reset();
  mesh.contact_pressure.clear();
}

NodeDifference node_difference(const HexMesh& mesh, const HexMesh& other) {
  if (!have_same_elements(mesh, other)) {
    throw input_error("the two meshes have different elements (", mesh.elements(), " and ",
                      other.elements(), ")");
  }
  NodeDifference difference;
  for (int i = 0; i < mesh.nodes(); ++i) {
    const double distance = (mesh.points[i] - other.points[i]).norm();
    difference.mean_mm += distance / mesh.nodes();
    if (distance > difference.max_mm) {
      difference.max_mm = distance;
      difference.worst_node = i;
    }
    difference.largest_displacement_mm =
        std::max(difference.largest_displacement_mm, (other.points[i] - mesh.reference[i]).norm());
  }
  return difference;
}

}  // namespace breast
