// SPDX-License-Identifier: GPL-3.0-or-later
// The band of cc2mlo against solving again: parameters are drawn from the priors, the whole chain
// is solved with them, and the true MLO places are compared with curve and band of the base model.
//
//     band_check MESH.vtkhdf FIRST COUNT [SPREAD]
//
// MESH is an imaged mesh (hexmesh --elements 8). Samples FIRST ... FIRST + COUNT - 1, one row a
// sample and place on stdout: sample, place, distance_mm across the curve, deviation_mm of the
// band. SPREAD times the priors' deviations. Rows of several runs may be put together;
// tabulate coverage judges them.
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include "bench/band_rows.hpp"
#include "contact/compression.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "fixtures/compress_into.hpp"
#include "fixtures/in_place.hpp"
#include "io/mesh_file.hpp"
#include "matching/band.hpp"
#include "sensitivity/chain.hpp"

namespace {

using namespace breast;

// Deviations drawn, in the priors' units; those of a compression for CC and MLO.
struct Draw {
  double fat = 0, fibroglandular = 0, skin = 0, skin_thickness = 0, density = 0;
  std::array<double, 2> thickness{}, angle{}, standoff{};
};

Draw draw(int sample, double spread) {
  std::mt19937 stream{unsigned(sample)};
  std::normal_distribution<double> normal;
  Draw drawn;
  drawn.fat = prior("fat", spread) * normal(stream);
  drawn.fibroglandular = prior("fibroglandular", spread) * normal(stream);
  drawn.skin = prior("skin", spread) * normal(stream);
  drawn.skin_thickness = prior("skin_thickness", spread) * normal(stream);
  drawn.density = prior("density", spread) * normal(stream);
  for (std::size_t v = 0; v < 2; ++v) {
    drawn.thickness[v] = prior("thickness", spread) * normal(stream);
    drawn.angle[v] = prior("angle", spread) * normal(stream);
    drawn.standoff[v] = prior("standoff", spread) * normal(stream);
  }
  return drawn;
}

constexpr std::array both_views = {View::cc, View::mlo};

// The chain with these parameters. Relative deviations are of the logarithm.
struct Chain {
  HexMesh reference;
  std::array<HexMesh, 2> views;
  MechanicsOptions mechanics;
};

Chain solve(HexMesh mesh, const Draw& drawn, const std::array<double, 2>& thickness) {
  Chain chain;
  chain.mechanics.materials = load_materials("seed2008");
  MaterialSet& materials = chain.mechanics.materials;
  const auto percent = [](const char* tissue, double logarithm) {
    return std::string(tissue) + "=" + std::to_string(100 * std::exp(logarithm));
  };
  scale_materials(materials, {percent("fat", drawn.fat), percent("skin", drawn.skin),
                              percent("fibroglandular", drawn.fibroglandular)});
  for (double& density : materials.density) density *= std::exp(drawn.density);
  for (double& mm : mesh.skin_thickness) mm *= std::exp(drawn.skin_thickness);
  const SolveSummary backward =
      fixtures::backward_into(mesh, posture_gravity(Posture::prone), chain.mechanics);
  if (!backward.converged()) throw not_converged_error("backward: ", backward.record.reason);
  chain.reference = mesh;
  for (std::size_t v = 0; v < 2; ++v) {
    CompressionOptions options;
    options.view = both_views[v];
    options.angle_deg = view_angle_deg(options.view) + drawn.angle[v];
    // Clear of the wall: 3 deviations nearer the coarse mesh folds behind the plates.
    options.plates.standoff = 35 + drawn.standoff[v];
    options.stops = {{thickness[v] > 0 ? StopAt::thickness : StopAt::reduction,
                      thickness[v] > 0 ? thickness[v] + drawn.thickness[v] : 40}};
    chain.views[v] = mesh;
    const CompressionResult summary =
        fixtures::compress_into(chain.views[v], options, chain.mechanics);
    if (!summary.converged()) throw not_converged_error("compress: ", summary.record.reason);
  }
  return chain;
}

DerivativeFields derivatives(const Chain& chain, const HexMesh& view) {
  const SensitivityChain sensitivity(view, chain.reference.pressure,
                                     posture_gravity(Posture::prone), chain.mechanics);
  DerivativeFields fields;
  const auto all = all_parameters(view, chain.mechanics, posture_gravity(Posture::prone));
  for (const Response& response :
       sensitivity.tangent(pick_parameters(all,
                                           "fat,fibroglandular,skin,skin_thickness,density,"
                                           "thickness,standoff,angle"))) {
    fields[response.parameter.name] = response.position;
  }
  return fields;
}

void run(const std::string& file, int first, int count, double spread) {
  const HexMesh imaged = read_mesh(file);
  const Chain base = solve(imaged, {}, {0, 0});
  const std::array<double, 2> thickness{base.views[0].contact->thickness_mm,
                                        base.views[1].contact->thickness_mm};
  const Matcher matcher(base.views[0], base.views[1]);
  const DerivativeFields from = derivatives(base, base.views[0]),
                         to = derivatives(base, base.views[1]);
  std::vector<Prior> priors = default_priors();
  // The truth here is the chain's own body, lies in the image as the chain's does, on the same detector.
  std::erase_if(priors, [](const Prior& p) {
    return p.parameter == "chain" || p.parameter == "repositioning" || p.parameter == "detector";
  });
  for (Prior& p : priors) p.deviation *= spread;
  const BandModel band(matcher, from, to, priors);
  const std::vector<int> chosen = shown_elements(matcher, base.views, 24);
  const std::array<Vec3, 2> centre{turning_centre(base.views[0].points),
                                   turning_centre(base.views[1].points)};
  const double picking = prior("picking", spread);
  for (int sample = first; sample < first + count; ++sample) {
    const Draw drawn = draw(sample, spread);
    Chain truth;
    try {
      truth = solve(imaged, drawn, thickness);
    } catch (const Error& error) {
      std::printf("# sample %d: %s\n", sample, error.what());
      continue;
    }
    std::mt19937 stream{unsigned(100000 + sample)};
    std::normal_distribution<double> normal;
    for (const int e : chosen) {
      const auto place = [&](std::size_t v) {
        const HexMesh& mesh = truth.views[v];
        return seen(element_position(mesh, mesh.points, e, Vec3::Zero()), centre[v],
                    v == 0 ? matcher.from_frame() : matcher.to_frame(), imaged.side,
                    drawn.angle[v]);
      };
      const Vec2 error = picking * Vec2(normal(stream), normal(stream));
      const MatchedCurve curve = matcher.match(place(0) + error);
      if (!curve.in_air()) print_row(sample, e, band.band(curve), place(1));
    }
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 4) {
    std::fprintf(stderr, "band_check MESH.vtkhdf FIRST COUNT [SPREAD]\n");
    return 2;
  }
  run(argv[1], std::stoi(argv[2]), std::stoi(argv[3]), argc > 4 ? std::stod(argv[4]) : 1);
} catch (const breast::Error& error) {
  std::fprintf(stderr, "band_check: %s\n", error.what());
  return error.exit_code();
}
