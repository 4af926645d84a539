// SPDX-License-Identifier: GPL-3.0-or-later
// match-lookup: the matched curves of a whole mammogram.
#include <algorithm>
#include <optional>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "io/derivative_file.hpp"
#include "io/lookup_file.hpp"
#include "io/mesh_file.hpp"
#include "tool_pairs.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path from, to, lookup, priors;
  bool both_ways = false;
  double pitch = 2;
  std::string geometry = "parallel", accept_other;
};

std::vector<Prior> priors_of(const Choices& choices) {
  return choices.priors.empty() ? default_priors()
                                : priors_from(read_table(choices.priors), choices.priors.string());
}

// Reports the counts of one direction.
void report_lookup(const MatchLookup& lookup, const std::string& prefix, Run& run) {
  Report& report = run.report();
  report.set(prefix + "nodes", lookup.status.size());
  const auto count = [&](auto wanted) {
    return std::size_t(std::count_if(lookup.status.begin(), lookup.status.end(), wanted));
  };
  const std::size_t matched = count([](std::uint8_t status) { return status != 0; });
  const std::size_t leaving =
      count([](std::uint8_t status) { return status == std::uint8_t(LookupStatus::behind_image); });
  report.set(prefix + "matched", matched);
  report.set(prefix + "leaving_image", leaving);
  if (leaving > 0) {
    run.warn(message(leaving, " of ", matched, " curves leave the ", view_name(lookup.to_view),
                     " image: part of each lies behind its posterior edge"));
  }
}

void run_lookup(const Choices& choices, Run& run) {
  const HexMesh from = read_mesh(choices.from, {.contact = true});
  const HexMesh to = read_mesh(choices.to, {.contact = true});
  Pairs pairs = pairs_of("match-lookup", run, choices.accept_other);
  pairs.check("CC", origin_of(choices.from, from), "MLO", origin_of(choices.to, to));
  const Beam beam = choices.geometry == "cone" ? Beam::cone : Beam::parallel;
  const Matcher matcher(from, to, beam), reverse(to, from, beam);
  const DerivativeFields from_derivatives = read_derivatives(choices.from, from).position,
                         to_derivatives = read_derivatives(choices.to, to).position;
  const BandModel band(matcher, from_derivatives, to_derivatives, priors_of(choices)),
      reverse_band(reverse, to_derivatives, from_derivatives, priors_of(choices));
  const bool banded = !band.counts_marks_only();
  if (!banded) {
    run.warn("no band: " + choices.from.filename().string() + " and " +
             choices.to.filename().string() +
             " have no derivatives in common; give the files that sensitivity writes for them");
  }
  MatchLookup lookup;
  std::optional<MatchLookup> back;
  {
    Timer::Scope phase(run.timer(), "match");
    lookup = match_lookup(matcher, banded ? &band : nullptr, choices.pitch, 25, run.progress());
  }
  if (choices.both_ways) {
    Timer::Scope phase(run.timer(), "match_back");
    back =
        match_lookup(reverse, banded ? &reverse_band : nullptr, choices.pitch, 25, run.progress());
  }
  report_lookup(lookup, "", run);
  if (back) report_lookup(*back, "back/", run);
  run.report().set("samples", lookup.samples);
  run.report().set("band", banded);
  for (const std::string& name : lookup.band_without) run.report().append("band_without", name);
  lookup.history = run.history({{choices.from, from.content_sha256, &from.history},
                                {choices.to, to.content_sha256, &to.history}});
  write_lookup(choices.lookup, lookup, back ? &*back : nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  Choices choices;
  Tool tool("match-lookup", "the curves in the other view of all points of a mammogram");
  tool.describe(
      "Matches a grid of points over the first image, each in the same way as cc2mlo matches one "
      "point. The results are written to one HDF5 file: the status of each point, its curve in "
      "the second image with its standard deviation, and its column of tissue in the MR frame. "
      "--both-ways adds the curves in the first image for points of the second; of such a file "
      "`tabulate page` makes the interactive page.");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), section IV-A");
  tool.input(choices.from, "CC.vtkhdf", "compression of the first image");
  tool.input(choices.to, "MLO.vtkhdf", "compression of the same mesh in another view");
  tool.output(choices.lookup, "LOOKUP.h5", "curves on a grid (docs/file-formats.md)");
  tool.number(choices.pitch, "--pitch", "mm", "spacing of the grid points", 0.1, 50);
  tool.flag(choices.both_ways, "--both-ways",
            "also match points of the second image to curves in the first");
  tool.choice(choices.geometry, "--geometry", {"parallel", "cone"},
              "beam, as in project-mammogram");
  tool.input_file(choices.priors, "--priors", "FILE",
                  "standard deviations for the band: TSV with columns parameter and "
                  "standard_deviation");
  declare_accept_other(tool, "match-lookup", choices.accept_other);
  tool.example("match-lookup cc.vtkhdf mlo.vtkhdf lookup.h5 --both-ways",
               "the curves of all points of either view");
  return tool.main(argc, argv, [&](Run& run) { run_lookup(choices, run); });
}
