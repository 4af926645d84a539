// SPDX-License-Identifier: GPL-3.0-or-later
// match-lookup: the matched curves of a whole mammogram, as a file and as a page to point at.
#include <algorithm>
#include <optional>

#include "cli/tool.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "io/derivative_file.hpp"
#include "io/lookup_file.hpp"
#include "io/mammogram_file.hpp"
#include "io/mesh_file.hpp"
#include "io/volume_file.hpp"
#include "page/page.hpp"
#include "tool_pairs.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path from, to, lookup, priors, page, from_image, to_image, scan;
  int series = 0;
  bool both_ways = false;
  double pitch = 2;
  std::string geometry = "parallel", accept_other;

  void check() const {
    if (page.empty() != from_image.empty() || page.empty() != to_image.empty()) {
      throw input_error("--page, --from-image and --to-image must be given together");
    }
    if (page.empty() && !scan.empty())
      throw input_error("--scan needs --page, in which it is shown");
  }
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

struct PageInput {
  Mammogram from, to;
  std::optional<Volume<float>> scan;
};

// Images and scan of the page, which must be of the breast of the meshes. They are read first, so
// that those of another breast are refused before the curves are computed.
PageInput read_page_input(const Choices& choices, const HexMesh& from, const HexMesh& to,
                          Pairs& pairs) {
  PageInput input{read_mammogram(choices.from_image), read_mammogram(choices.to_image), {}};
  const Origin first = origin_of(choices.from, from), second = origin_of(choices.to, to);
  pairs.check("CC", first, "--from-image", origin_of(choices.from_image, input.from));
  pairs.check("MLO", second, "--to-image", origin_of(choices.to_image, input.to));
  if (choices.scan.empty()) return input;
  VolumeSource source;
  input.scan = read_volume(choices.scan, choices.series, &source);
  pairs.check("CC", first, "--scan",
              origin_of_scan(choices.scan, source.content_sha256, input.scan->grid));
  return input;
}

// The page is made before the lookup's file is written, so that neither is left if the page fails.
void write_page(const Choices& choices, const PageInput& input, const Matcher& matcher,
                const MatchLookup& lookup, const MatchLookup& back, Run& run) {
  Timer::Scope phase(run.timer(), "page");
  const std::string page = lookup_page({.matcher = matcher,
                                        .there = lookup,
                                        .back = back,
                                        .from = input.from,
                                        .to = input.to,
                                        .scan = input.scan ? &*input.scan : nullptr});
  write_text(choices.page, page);
  run.report().set("page_mb", double(page.size()) / 1e6);
  run.report().set("page_shows_scan", !choices.scan.empty());
}

void run_lookup(const Choices& choices, Run& run) {
  const HexMesh from = read_mesh(choices.from, {.contact = true});
  const HexMesh to = read_mesh(choices.to, {.contact = true});
  Pairs pairs = pairs_of("match-lookup", run, choices.accept_other);
  pairs.check("CC", origin_of(choices.from, from), "MLO", origin_of(choices.to, to));
  std::optional<PageInput> page;
  if (!choices.page.empty()) page = read_page_input(choices, from, to, pairs);
  const Beam beam = choices.geometry == "cone" ? Beam::cone : Beam::parallel;
  const Matcher matcher(from, to, beam), reverse(to, from, beam);
  const DerivativeFields from_derivatives = read_derivatives(choices.from, from).position,
                         to_derivatives = read_derivatives(choices.to, to).position;
  const BandModel band(matcher, from_derivatives, to_derivatives, priors_of(choices)),
      reverse_band(reverse, to_derivatives, from_derivatives, priors_of(choices));
  const bool banded = !band.counts_marks_only(), both = choices.both_ways || !choices.page.empty();
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
  if (both) {
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
  if (page) write_page(choices, *page, matcher, lookup, *back, run);
  write_lookup(choices.lookup, lookup, back ? &*back : nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  Choices choices;
  Tool tool("match-lookup",
            "matched curves of all points of a mammogram, as a file and as an "
            "interactive page");
  tool.describe(
      "Matches a grid of points over the first image, each in the same way as cc2mlo matches one "
      "point. The results are written to one HDF5 file: the status of each point, its curve in "
      "the second image with its standard deviation, and its column of tissue in the MR frame. "
      "--both-ways adds the curves in the first image for points of the second. --page writes one "
      "HTML file that needs neither a server nor a network: pointing at either image draws the "
      "curve, band and arc in the other, the column in the body and, with --scan, the MR slices "
      "that it crosses. The page contains no file names and no header data of the scan, but it "
      "does show images of the breast: give it only to those who may see the scan.");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), section IV-A");
  tool.input(choices.from, "CC.vtkhdf", "compression of the first image");
  tool.input(choices.to, "MLO.vtkhdf", "compression of the same mesh in another view");
  tool.output(choices.lookup, "LOOKUP.h5", "curves on a grid (docs/file-formats.md)");
  tool.number(choices.pitch, "--pitch", "mm", "spacing of the grid points", 0.1, 50);
  tool.flag(choices.both_ways, "--both-ways",
            "also match points of the second image to curves in the first; --page implies it");
  tool.choice(choices.geometry, "--geometry", {"parallel", "cone"},
              "beam, as in project-mammogram");
  tool.input_file(choices.priors, "--priors", "FILE",
                  "standard deviations for the band: TSV with columns parameter and "
                  "standard_deviation");
  tool.output_file(choices.page, "--page", "FILE.html", "interactive page");
  tool.input_file(choices.from_image, "--from-image", "CC.vti", "first image of the page");
  tool.input_file(choices.to_image, "--to-image", "MLO.vti", "second image of the page");
  tool.input_file(
      choices.scan, "--scan", "MR",
      "MR scan that was segmented; the page then shows its slices around the breast (default: "
      "the page contains no voxel of the scan)");
  tool.integer(choices.series, "--series", "N", "which series of a DICOM folder (0: the only one)",
               0, 10000);
  declare_accept_other(tool, "match-lookup", choices.accept_other);
  tool.check([&] { choices.check(); });
  tool.example(
      "match-lookup cc.vtkhdf mlo.vtkhdf lookup.h5 --page page.html --from-image cc.vti "
      "--to-image mlo.vti",
      "lookup and page of the two views");
  return tool.main(argc, argv, [&](Run& run) { run_lookup(choices, run); });
}
