// SPDX-License-Identifier: GPL-3.0-or-later
// probe: the positions of landmarks in deformed meshes, as a table.
#include <algorithm>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "core/text/lists.hpp"
#include "evaluation/landmark_truth.hpp"
#include "io/mesh_file.hpp"
#include "tool_pairs.hpp"

using namespace breast;

namespace {

struct Choices {
  std::vector<std::filesystem::path> files;
  std::filesystem::path base, truth;
  std::string landmarks;
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
          "Prints one tab-separated row per file to stdout. For each landmark NAME the columns "
          "are its position NAME_x_mm, NAME_y_mm, NAME_z_mm (LPS); the length of its "
          "displacement from the imaged shape, NAME_mm; and, with --base, the distance between "
          "its positions in this file and in the base, NAME_relative_mm. Two displacements of the "
          "same length in different directions differ in this column alone.")
      .cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), Tables III to VI");
  tool.inputs(c.files, "FILE.vtkhdf", "meshes written by hexmesh, backward, forward or compress");
  tool.text(c.landmarks, "--landmarks", "NAME,...",
            "landmarks to print (default: all landmarks of the first file)");
  tool.input_file(c.base, "--base", "FILE.vtkhdf",
                  "mesh to which the relative displacements refer");
  tool.input_file(
      c.truth, "--truth", "FILE.tsv",
      "true positions (phantom --truth), prone and in any other posture; prints one row per "
      "landmark instead, with its error in mm in the posture of each file");
  tool.example("probe reference.vtkhdf supine.vtkhdf --truth paper-truth/landmarks.tsv",
               "errors of the chain against the phantom's truth");
  tool.example("probe supine.vtkhdf --landmarks tumour,nipple", "supine displacements");
  tool.example("probe fat-*.vtkhdf --base supine.vtkhdf > fat.tsv",
               "the effect of a material on the supine shape, as in Table III");
}

// The requested landmarks, or those of the first file.
std::vector<std::string> chosen(const std::string& option, const HexMesh& first) {
  if (!option.empty()) return split(option, ',');
  std::vector<std::string> names;
  for (const Landmark& landmark : first.landmarks) names.push_back(landmark.name);
  return names;
}

const Landmark& find(const HexMesh& mesh, const std::string& name,
                     const std::filesystem::path& file) {
  if (const Landmark* landmark = mesh.landmark(name)) return *landmark;
  std::string known;
  for (const Landmark& l : mesh.landmarks) known += (known.empty() ? "" : ", ") + l.name;
  throw input_error(file.string(), ": has no landmark '", name, "'; it has: ", known);
}

struct Probe {
  std::string name;  ///< of the landmark in the mesh
  Vec3 position, imaged;
};
Probe probe(const HexMesh& mesh, const std::string& name, const std::filesystem::path& file) {
  const Landmark& landmark = find(mesh, name, file);
  return {landmark.name, landmark_position(mesh, mesh.points, landmark),
          landmark_position(mesh, mesh.imaged, landmark)};
}

// Column names with their unit, in the order in which add_cells fills them.
void add_columns(Table& table, const std::string& name, bool relative) {
  for (const char* what : {"_x_mm", "_y_mm", "_z_mm", "_mm"}) table.columns.push_back(name + what);
  if (relative) table.columns.push_back(name + "_relative_mm");
}

// Mean errors of a truth comparison under "truth/COLUMN".
void report_truth(const Table& table, Report& report) {
  const auto& mean = table.rows[table.rows.size() - 2];
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    report.set("truth/mean_" + table.columns[c], std::stod(mean[c]));
  }
}

void report_landmark(const Probe& here, Report& report) {
  const std::string& name = here.name;
  const Vec3 displacement = here.position - here.imaged;
  report.set("landmarks/" + name + "/imaged", here.imaged);
  report.set("landmarks/" + name + "/position", here.position);
  report.set("landmarks/" + name + "/displacement_from_scan_mm", displacement);
  report.set("landmarks/" + name + "/distance_mm", displacement.norm());
}

// One row per file; the landmarks of a single file are also reported.
void tell_positions(const Choices& c, const std::vector<HexMesh>& meshes, Run& run) {
  const std::vector<std::string> names = chosen(c.landmarks, meshes.front());
  if (names.empty()) throw input_error(c.files.front().string(), ": has no landmarks");
  const bool relative = !c.base.empty();
  const HexMesh base = relative ? read_mesh(c.base) : HexMesh();
  Pairs pairs = pairs_of("probe", run);
  for (std::size_t i = 0; relative && i < meshes.size(); ++i)
    pairs.check("--base", origin_of(c.base, base), "FILE", origin_of(c.files[i], meshes[i]));
  Table table{{"file"}, {}};
  // A landmark is shown by its own name, so that a request for the tumour reveals an artificial
  // one.
  for (const std::string& name : names) {
    add_columns(table, find(meshes.front(), name, c.files.front()).name, relative);
  }
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    std::vector<std::string> row{c.files[i].filename().string()};
    for (const std::string& name : names) {
      const Probe here = probe(meshes[i], name, c.files[i]);
      for (int d = 0; d < 3; ++d) row.push_back(format_fixed(here.position[d], 4));
      row.push_back(format_fixed((here.position - here.imaged).norm(), 4));
      if (relative) {
        const Vec3 there = probe(base, name, c.base).position;
        row.push_back(format_fixed((here.position - there).norm(), 4));
      }
      if (meshes.size() == 1) report_landmark(here, run.report());
    }
    table.rows.push_back(std::move(row));
  }
  run.print(table.text());
}

void tell_errors(const Choices& c, const std::vector<HexMesh>& meshes, Run& run) {
  const Table table = read_table(c.truth);
  const Origin first = origin_of(c.files.front(), meshes.front());
  Pairs pairs = pairs_of("probe", run);
  for (std::size_t i = 1; i < meshes.size(); ++i)
    pairs.check("first FILE", first, "FILE with --truth", origin_of(c.files[i], meshes[i]));
  pairs.check("FILE", first, "--truth", origin_of_truth(c.truth, table, meshes.front().side));
  const auto truth = true_landmarks(table, meshes.front().side, c.truth.string());
  const Table errors = compare_with_truth(meshes, truth);
  report_truth(errors, run.report());
  run.print(errors.text());
}

void run_probe(const Choices& c, Run& run) {
  std::vector<HexMesh> meshes;
  for (std::size_t i = 0; i < c.files.size(); ++i) {
    run.progress().update("reading", double(i) / double(c.files.size()),
                          c.files[i].filename().string());
    meshes.push_back(read_mesh(c.files[i]));
  }
  (c.truth.empty() ? tell_positions : tell_errors)(c, meshes, run);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("probe", "landmark positions and displacements of meshes as a table");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_probe(c, run); });
}
