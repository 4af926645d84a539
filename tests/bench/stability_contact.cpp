// SPDX-License-Identifier: GPL-3.0-or-later
// Compression far from the ordinary, one row a case on stdout:
//
//     stability_contact [--only TEXT] [REFERENCE.vtkhdf...]
//
// The table of fixtures/contact_cases.hpp on the analytic breast (with --only the cases whose name
// contains TEXT), then for every stress-free mesh given CC and MLO to 50 and 70 % with the set
// seed2008. Success is what the case states. Ends with 3 when a case of the table fails.
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "core/blas.hpp"
#include "core/parallel.hpp"
#include "fixtures/contact_cases.hpp"
#include "io/mesh_file.hpp"
#include "mesh/view_pose.hpp"

namespace {

using namespace breast;

void print(const std::string& name, const std::string& verdict, const fixtures::ContactScene& scene,
           const fixtures::ContactOutcome& end, double seconds) {
  const CompressionResult& s = end.summary;
  std::string reason = end.reason;
  for (char& c : reason) c = c == '\t' || c == '\n' ? ' ' : c;
  std::printf(
      "%s\t%d\t%s\t%s\t%.1f\t%.2f\t%.2f\t%d\t%d\t%d\t%d\t%d\t%.1e\t%.3f\t%.1e\t%.2f\t%s\t%s\n",
      name.c_str(), scene.mesh.elements(), verdict.c_str(), outcome_name(end.outcome),
      s.contact ? s.contact->reduction_percent : 0, end.paddle.force_N, end.paddle.mean_kPa,
      s.steps, s.path.failures, s.newton_iterations, s.factorisations, s.path.indefinite,
      s.residual, s.min_det_F, s.force_balance, seconds,
      end.reason_id.empty() ? "-" : end.reason_id.c_str(), reason.empty() ? "-" : reason.c_str());
  std::fflush(stdout);
}

/// Runs and prints a case.
bool run(const fixtures::ContactCase& which, fixtures::ContactScene& scene) {
  const auto start = std::chrono::steady_clock::now();
  const fixtures::ContactOutcome end = run_contact_scene(scene);
  const bool success = succeeded(which, end);
  print(which.name, success ? "success" : "failure", scene, end,
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return success;
}

bool run_table(const std::string& only) {
  int succeeding = 0, failing = 0;
  for (const fixtures::ContactCase& which : fixtures::contact_cases()) {
    if (which.name.find(only) == std::string::npos) continue;
    fixtures::ContactScene scene = fixtures::base_scene(which.mesh_size);
    which.change(scene);
    ++(run(which, scene) ? succeeding : failing);
  }
  std::fprintf(stderr, "stability_contact: %d succeed, %d fail\n", succeeding, failing);
  return failing == 0;
}

void run_file(const std::string& file) {
  const HexMesh mesh = read_mesh(file, {.reference = true});
  const std::string stem = std::filesystem::path(file).parent_path().filename().string();
  for (const View view : {View::cc, View::mlo}) {
    for (const double percent : {50.0, 70.0}) {
      fixtures::ContactScene scene;
      scene.mesh = mesh;
      scene.mechanics.materials = load_materials("seed2008");
      scene.options.view = view;
      scene.options.angle_deg = view_angle_deg(view);
      scene.options.stops = {{StopAt::reduction, double(percent)}};
      run({.name = message(stem, " ", view_name(view), " ", percent, " %"), .change = {}}, scene);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    set_threads(0);
    prepare_blas();
    std::string only;
    std::vector<std::string> files;
    for (int i = 1; i < argc; ++i) {
      if (std::string(argv[i]) == "--only" && i + 1 < argc) {
        only = argv[++i];
      } else {
        files.emplace_back(argv[i]);
      }
    }
    std::printf(
        "case\telements\tverdict\toutcome\treduction_percent\tforce_N\tmean_kPa\tsteps\t"
        "failed_steps\tnewton\tfactorisations\tindefinite\tresidual\tmin_det_F\tforce_balance\t"
        "seconds\treason\texplanation\n");
    const bool good = run_table(only);
    for (const std::string& file : files) run_file(file);
    return good ? 0 : 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stability_contact: %s\n", error.what());
    return 1;
  }
}
