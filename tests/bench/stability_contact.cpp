// Compression far from the ordinary, one row a case on stdout:
//
//     stability_contact [REFERENCE.vtkhdf...]
//
// The table of fixtures/contact_cases.hpp on the analytic breast, then for every stress-free mesh
// given CC and MLO to 50 and 70 % with the set seed2008. Ends with 1 when a case that must get
// somewhere does not.
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "core/parallel.hpp"
#include "fixtures/contact_cases.hpp"
#include "io/mesh_file.hpp"
#include "mammo/mammogram.hpp"
#include "solve/blas.hpp"

namespace {

using namespace breast;

void print(const std::string& name, const fixtures::ContactScene& scene,
           const fixtures::ContactOutcome& end, double seconds) {
  const CompressionSummary& s = end.summary;
  std::string reason = end.reason;
  for (char& c : reason) c = c == '\t' || c == '\n' ? ' ' : c;
  std::printf("%s\t%d\t%s\t%.1f\t%.2f\t%.2f\t%d\t%d\t%d\t%d\t%d\t%.1e\t%.3f\t%.1e\t%.2f\t%s\n",
              name.c_str(), scene.mesh.elements(), end.outcome.c_str(), s.reduction_percent,
              end.paddle.force_N, end.paddle.mean_kPa, s.steps, s.path.failures,
              s.newton_iterations, s.factorisations, s.path.indefinite, s.residual, s.min_det_F,
              s.force_balance, seconds, reason.empty() ? "-" : reason.c_str());
  std::fflush(stdout);
}

fixtures::ContactOutcome run(const std::string& name, fixtures::ContactScene& scene) {
  const auto start = std::chrono::steady_clock::now();
  fixtures::ContactOutcome end = run_contact_scene(scene);
  print(name, scene, end,
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return end;
}

bool run_table() {
  bool good = true;
  for (const fixtures::ContactCase& which : fixtures::contact_cases()) {
    fixtures::ContactScene scene = fixtures::base_scene(which.mesh_size);
    which.change(scene);
    const fixtures::ContactOutcome end = run(which.name, scene);
    const bool refused = end.outcome == "refused";
    const bool enough = which.at_least < 0 ? refused
                        : which.at_least == 0
                            ? true
                            : !refused && end.summary.reduction_percent >= which.at_least - 1e-6;
    if (!enough) std::fprintf(stderr, "stability_contact: %s: not enough\n", which.name.c_str());
    good = good && enough;
  }
  return good;
}

void run_file(const std::string& file) {
  const HexMesh mesh = read_mesh(file, {.reference = true});
  const std::string stem = std::filesystem::path(file).parent_path().filename().string();
  for (const char* view : {"CC", "MLO"}) {
    for (const double percent : {50.0, 70.0}) {
      fixtures::ContactScene scene;
      scene.mesh = mesh;
      scene.mechanics.materials = load_materials("seed2008");
      scene.options.view = view;
      scene.options.angle_deg = view_angle_deg(view);
      scene.options.target = percent;
      run(message(stem, " ", view, " ", percent, " %"), scene);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    set_threads(0);
    prepare_blas();
    std::printf(
        "case\telements\toutcome\treduction_percent\tforce_N\tmean_kPa\tsteps\tfailed_steps\t"
        "newton\tfactorisations\tindefinite\tresidual\tmin_det_F\tforce_balance\tseconds\t"
        "reason\n");
    const bool good = run_table();
    for (int i = 1; i < argc; ++i) run_file(argv[i]);
    return good ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stability_contact: %s\n", error.what());
    return 1;
  }
}
