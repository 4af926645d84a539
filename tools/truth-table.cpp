// SPDX-License-Identifier: GPL-3.0-or-later
// truth-table: true landmark positions under compression, with the truth's own error.
#include "cli/tool.hpp"
#include "core/error.hpp"
#include "evaluation/truth_table.hpp"
#include "io/mesh_file.hpp"
#include "tool_pairs.hpp"

using namespace breast;

namespace {

// Reports the largest and mean own error of every posture as "own_error/POSTURE".
double report_errors(const Table& table, Report& report) {
  double worst = 0;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const std::string ending = "_own_error_mm", &column = table.columns[c];
    if (!column.ends_with(ending)) continue;
    const std::string key = "own_error/" + column.substr(0, column.size() - ending.size()) + "/";
    double largest = 0, sum = 0;
    for (const auto& row : table.rows) {
      const double error = parse_number(row[c], column);
      largest = std::max(largest, error);
      sum += error;
    }
    report.set(key + "largest_mm", largest);
    report.set(key + "mean_mm", sum / double(table.rows.size()));
    worst = std::max(worst, largest);
  }
  return worst;
}

// Adds the column that states the scan, for those who compare the chain of that scan.
void add_scan(const std::string& sha256, Table& table) {
  if (sha256.empty()) return;
  table.columns.push_back(truth_scan_column);
  for (auto& row : table.rows) row.push_back(sha256);
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path landmarks, out;
  std::vector<std::filesystem::path> files;
  Tool tool("truth-table", "true landmark positions under compression, with their errors");
  tool.describe(
      "Extends the phantom's landmark table by positions from meshes of the same breast at two "
      "resolutions (phantom-mesh, compress). The finer meshes give the true positions; the "
      "distance of a landmark between the two resolutions is stated as the error of the truth. "
      "For second-order convergence this is about three times the error of the finer mesh; "
      "the positions are not corrected for it. The result can be given to probe --truth. The prone positions "
      "remain those of the image; their error is the larger of the distance between the "
      "resolutions and their distance from the finer mesh.");
  tool.input(landmarks, "LANDMARKS.tsv",
             "stress-free, prone and supine positions (phantom --truth)");
  tool.output(out, "OUT.tsv", "the extended table");
  tool.inputs(files, "MESH.vtkhdf",
              "meshes in the prone, supine, CC, MLO ... shapes, each in the fine and the coarse "
              "resolution");
  tool.example("truth-table landmarks.tsv left.tsv fine-cc.vtkhdf coarse-cc.vtkhdf",
               "adds the CC positions of the left side");
  return tool.main(argc, argv, [&](Run& run) {
    std::vector<HexMesh> meshes;
    for (const auto& file : files) meshes.push_back(read_mesh(file, {.reference = true}));
    const Table imaged = read_table(landmarks);
    const Origin truth = origin_of_truth(landmarks, imaged, meshes.front().side),
                 first = origin_of(files.front(), meshes.front());
    Pairs pairs = pairs_of("truth-table", run);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const Origin mesh = origin_of(files[i], meshes[i]);
      pairs.check("LANDMARKS", truth, "MESH", mesh);
      pairs.check("first MESH", first, "MESH", mesh);
    }
    Table table = truth_table(imaged, meshes);
    add_scan(truth.scan_sha256, table);
    int most = 0, fewest = meshes.front().elements();
    for (const HexMesh& mesh : meshes) {
      most = std::max(most, mesh.elements());
      fewest = std::min(fewest, mesh.elements());
      if (!mesh.contact) continue;
      run.report().set(view_name(mesh.contact->view) +
                           (mesh.elements() == fewest ? "/coarse" : "/fine") + "/thickness_mm",
                       mesh.contact->thickness_mm);
    }
    run.report().set("elements", most);
    run.report().set("coarse_elements", fewest);
    run.report().set("error_estimate_mm", report_errors(table, run.report()));
    run.report().set("error_estimate_by", "largest landmark distance between the two meshes");
    write_table(out, table);
  });
}
