// SPDX-License-Identifier: GPL-3.0-or-later
#include "sensitivity/results.hpp"

namespace breast {

namespace {

SensitivityResults empty_results() {
  return {{{"landmark", "parameter", "per", "dx_mm", "dy_mm", "dz_mm", "dlnu", "seconds"}, {}}, {}};
}

void add_row(const HexMesh& mesh, const Landmark& landmark, const Parameter& parameter,
             const Vec3& slope, double seconds, Table& table, Report& report) {
  const double elasticity = displacement_elasticity(mesh, landmark, slope);
  table.rows.push_back({landmark.name, parameter.name, parameter.per(), format_number(slope.x()),
                        format_number(slope.y()), format_number(slope.z()),
                        format_number(elasticity), format_fixed(seconds, 4)});
  const std::string key = "sensitivity/" + landmark.name + "/" + parameter.name + "/";
  report.set(key + "derivative_mm", slope);
  report.set(key + "dlnu", elasticity);
}

}  // namespace

SensitivityResults tangent_results(const SensitivityChain& chain,
                                   const std::vector<Parameter>& parameters, const HexMesh& mesh,
                                   Report& report, Progress& progress) {
  SensitivityResults out = empty_results();
  for (const Response& response : chain.tangent(parameters, progress)) {
    for (const Landmark& landmark : mesh.landmarks) {
      add_row(mesh, landmark, response.parameter,
              landmark_position(mesh, response.position, landmark), response.seconds, out.table,
              report);
    }
    if (chain.pressed() && response.parameter.kind != ParameterKind::angle) {
      report.set("sensitivity/paddle/" + response.parameter.name + "/force_N",
                 response.paddle_force_N);
    }
    out.arrays.position[response.parameter.name] = response.position;
  }
  return out;
}

SensitivityResults adjoint_results(const SensitivityChain& chain,
                                   const std::vector<Parameter>& parameters, const HexMesh& mesh,
                                   Report& report, Progress& progress) {
  SensitivityResults out = empty_results();
  for (const Landmark& landmark : mesh.landmarks) {
    const LandmarkGradient gradient = chain.adjoint(landmark, parameters);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      add_row(mesh, landmark, parameters[i], gradient.by_parameter[i],
              gradient.seconds / double(parameters.size()), out.table, report);
    }
    out.arrays.influence[landmark.name] = gradient.by_element;
    progress.update("derivatives",
                    double(out.arrays.influence.size()) / double(mesh.landmarks.size()),
                    landmark.name);
  }
  return out;
}

}  // namespace breast
