// SPDX-License-Identifier: GPL-3.0-or-later
// The band of cc2mlo against a body that is not the model's: places of the phantom's true body,
// moved by parameters drawn from the priors along that body's own derivatives, against curve and
// band of a chain that started from the MR scan and knows nominal parameters only.
//
//     band_truth CC MLO TRUE-CC TRUE-MLO FIRST COUNT PLACES [SPREAD [MATERIALS]]
//
// The four meshes carry derivatives (tool sensitivity); the true plates stand as the chain's do.
// Samples FIRST ... FIRST + COUNT - 1, rows as of band_check; PLACES elements of the true body. The
// mark is drawn too. SPREAD 0: neither parameters nor mark are drawn, the band stays that of the
// priors: what is left is the error of the chain itself. The chest wall is not drawn: the chain has
// its own error there. MATERIALS: a set whose covariance takes the place of the priors it is about.
#include <random>

#include "bench/band_rows.hpp"
#include "io/derivative_file.hpp"
#include "io/mesh_file.hpp"
#include "matching/band_materials.hpp"
#include "material/material_set.hpp"

namespace {

using namespace breast;

struct Body {
  std::array<HexMesh, 2> views;
  std::array<DerivativeFields, 2> derivatives;
  std::vector<Prior> priors = default_priors();
};

Body read_body(const std::string& cc, const std::string& mlo, const std::string& materials) {
  Body body;
  for (std::size_t v = 0; v < 2; ++v) {
    const std::string& file = v == 0 ? cc : mlo;
    body.views[v] = read_mesh(file, {.contact = true});
    body.derivatives[v] = read_derivatives(file, body.views[v]).position;
  }
  if (!materials.empty()) {
    const SoftnessUncertainty known = load_materials(materials).uncertainty;
    use_covariance(known.parameters, known.covariance, body.derivatives[0], body.derivatives[1],
                   body.priors);
  }
  return body;
}

bool of_one_view(const std::string& parameter) {
  return parameter == "thickness" || parameter == "angle" || parameter == "standoff" ||
         parameter == "detector";
}

// Nodes of both views with drawn parameters, and by how much each detector turned.
struct Moved {
  std::array<std::vector<Vec3>, 2> points;
  std::array<double, 2> turned{};
};

Moved draw(const Body& body, int sample, double spread) {
  std::mt19937 stream{unsigned(sample)};
  std::normal_distribution<double> normal;
  Moved moved{{body.views[0].points, body.views[1].points}, {}};
  for (const Prior& prior : body.priors) {
    const std::array<double, 2> drawn{normal(stream), normal(stream)};
    for (std::size_t v = 0; v < 2; ++v) {
      const auto field = body.derivatives[v].find(prior.parameter);
      if (field == body.derivatives[v].end()) continue;
      const double value = spread * prior.deviation * drawn[of_one_view(prior.parameter) ? v : 0];
      if (prior.parameter == "angle") moved.turned[v] = value;
      for (std::size_t i = 0; i < field->second.size(); ++i) {
        moved.points[v][i] += value * field->second[i];
      }
    }
  }
  return moved;
}

void run(const std::array<std::string, 4>& files, int first, int count, std::size_t most,
         double spread, const std::string& materials) {
  const Body chain = read_body(files[0], files[1], materials),
             truth = read_body(files[2], files[3], materials);
  const Matcher matcher(chain.views[0], chain.views[1]);
  const BandModel model(matcher, chain.derivatives[0], chain.derivatives[1], chain.priors);
  const std::vector<int> chosen = shown_elements(matcher, truth.views, most);
  const std::array<const ImageFrame*, 2> frames{&matcher.from_frame(), &matcher.to_frame()};
  const std::array<Vec3, 2> centre{turning_centre(chain.views[0].points),
                                   turning_centre(chain.views[1].points)};
  int in_air = 0;
  for (int sample = first; sample < first + count; ++sample) {
    const Moved moved = draw(truth, sample, spread);
    std::mt19937 stream{unsigned(100000 + sample)};
    std::normal_distribution<double> normal(0, 1);
    // The breast lies otherwise in both mammograms than in the chain's images.
    const double lies = prior("repositioning", spread);
    const std::array<Vec2, 2> shifted{lies * Vec2(normal(stream), normal(stream)),
                                      lies * Vec2(normal(stream), normal(stream))};
    for (const int e : chosen) {
      const auto place = [&](std::size_t v) {
        const HexMesh& mesh = truth.views[v];
        const Vec2 at = seen(element_position(mesh, moved.points[v], e, Vec3::Zero()), centre[v],
                             *frames[v], mesh.side, moved.turned[v]);
        return Vec2(at + shifted[v]);
      };
      const Vec2 error(normal(stream), normal(stream));
      const MatchedCurve curve = matcher.match(place(0) + prior("picking", spread) * error);
      if (curve.in_air()) {
        ++in_air;
      } else {
        print_row(sample, e, model.band(curve), place(1));
      }
    }
  }
  std::printf("# %d marks in air of the simulated image, not judged\n", in_air);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 8) {
    std::fprintf(stderr,
                 "band_truth CC MLO TRUE-CC TRUE-MLO FIRST COUNT PLACES [SPREAD [MATERIALS]]\n");
    return 2;
  }
  run({argv[1], argv[2], argv[3], argv[4]}, std::stoi(argv[5]), std::stoi(argv[6]),
      std::stoul(argv[7]), argc > 8 ? std::stod(argv[8]) : 1, argc > 9 ? argv[9] : "");
} catch (const breast::Error& error) {
  std::fprintf(stderr, "band_truth: %s\n", error.what());
  return error.exit_code();
}
