// SPDX-License-Identifier: GPL-3.0-or-later
// difference: the derivative of a shape with respect to a parameter that changes the mesh, from two
// other models.
#include "cli/tool.hpp"
#include "core/error.hpp"
#include "evaluation/shape_difference.hpp"
#include "io/derivative_file.hpp"
#include "tool_pairs.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path state, plus, minus, out;
  std::string parameter = "chest_wall";
  double step = 1;
};

void run_difference(const Choices& c, Run& run) {
  HexMesh mesh = read_mesh(c.state, {.reference = true});
  const HexMesh plus = read_mesh(c.plus, {.reference = true}),
                minus = read_mesh(c.minus, {.reference = true});
  Pairs pairs = pairs_of("difference", run);
  pairs.check("STATE", origin_of(c.state, mesh), "PLUS", origin_of(c.plus, plus));
  pairs.check("STATE", origin_of(c.state, mesh), "MINUS", origin_of(c.minus, minus));
  Derivatives derivatives = read_derivatives(c.state, mesh);
  const ShapeDifference difference = shape_difference(mesh, plus, minus, c.step);
  double largest = 0, sum = 0;
  for (const Vec3& slope : difference.per_node) {
    largest = std::max(largest, slope.norm());
    sum += slope.norm();
  }
  derivatives.position[c.parameter] = difference.per_node;
  run.report().set("outside_mm", difference.outside_mm);
  run.report().set("derivative/mean_mm", sum / double(mesh.nodes()));
  run.report().set("derivative/largest_mm", largest);
  const History history = mesh.history;
  mesh.history = run.history({{c.state, mesh.content_sha256, &history},
                              {c.plus, plus.content_sha256, &plus.history},
                              {c.minus, minus.content_sha256, &minus.history}});
  write_mesh(c.out, mesh, derivatives);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool(
      "difference",
      "how a shape moves with its mesh (a shifted chest wall, say), from two runs whose meshes differ");
  tool.describe(
      "The tool sensitivity differentiates with respect to materials, gravity and plates; a "
      "change of the chest wall changes the mesh itself. The chain is therefore run twice more "
      "with the wall moved backwards and forwards (segment --chest-wall-shift), and every node "
      "of STATE is located in both results by its position in the scan. Half the difference is "
      "the derivative; it becomes a term of the band of cc2mlo and match-lookup.");
  tool.input(c.state, "STATE.vtkhdf",
             "the shape, which may already have derivatives (sensitivity)");
  tool.input(c.plus, "PLUS.vtkhdf",
             "the same posture or view with the parameter increased by "
             "the step");
  tool.input(c.minus, "MINUS.vtkhdf",
             "the same posture or view with the parameter decreased by the step");
  tool.output(c.out, "OUT.vtkhdf", "STATE with an additional array derivative_PARAMETER");
  tool.text(c.parameter, "--parameter", "NAME",
            "parameter that was changed, as it is named in the band's priors");
  tool.number(c.step, "--step", "STEP",
              "step of the parameter in either direction, in its own unit", 1e-12);
  tool.check([&] {
    if (c.parameter.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") != std::string::npos ||
        c.parameter.empty()) {
      throw input_error("--parameter '", c.parameter,
                        "': only lower-case letters and _ are allowed");
    }
  });
  tool.example(
      "difference cc-sensitivity.vtkhdf wall/back/cc.vtkhdf wall/front/cc.vtkhdf cc-band.vtkhdf",
      "effect of one standard deviation of the chest wall in the CC view");
  return tool.main(argc, argv, [&c](Run& run) { run_difference(c, run); });
}
