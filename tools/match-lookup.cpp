// match-lookup: the matched curves of a whole mammogram, as a file and as a page to point at.
#include <algorithm>

#include "cli/tool.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "io/derivative_file.hpp"
#include "io/lookup_file.hpp"
#include "io/mammogram_file.hpp"
#include "io/mesh_file.hpp"
#include "page/page.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path from, to, lookup, priors, page, from_image, to_image;
  double pitch = 2;
  std::string geometry = "parallel";

  void check() const {
    if (page.empty() == from_image.empty() && page.empty() == to_image.empty()) return;
    throw input_error("--page, --from-image and --to-image go together");
  }
};

void run_lookup(const Choices& choices, Run& run) {
  const HexMesh from = read_mesh(choices.from, {.contact = true});
  const HexMesh to = read_mesh(choices.to, {.contact = true});
  const Matcher matcher(from, to, choices.geometry == "cone" ? Beam::cone : Beam::parallel);
  const DerivativeFields from_derivatives = read_derivatives(choices.from, from).position,
                         to_derivatives = read_derivatives(choices.to, to).position;
  const BandModel band(matcher, from_derivatives, to_derivatives,
                       choices.priors.empty()
                           ? default_priors()
                           : priors_from(read_table(choices.priors), choices.priors.string()));
  MatchLookup lookup;
  const bool banded = !band.counts_marks_only();
  if (!banded) {
    run.warn("no band: " + choices.from.filename().string() + " and " +
             choices.to.filename().string() +
             " share no derivative of their shapes; give the files that sensitivity makes of them");
  }
  {
    Timer::Scope phase(run.timer(), "match");
    lookup =
        match_lookup(matcher, banded ? &band : nullptr, choices.pitch, 25, run.progress());
  }
  Report& report = run.report();
  report.set("nodes", lookup.status.size());
  const auto count = [&](auto wanted) {
    return std::size_t(std::count_if(lookup.status.begin(), lookup.status.end(), wanted));
  };
  const std::size_t matched = count([](std::uint8_t status) { return status != 0; });
  const std::size_t leaving = count([](std::uint8_t status) {
    return status == std::uint8_t(LookupStatus::behind_image);
  });
  report.set("matched", matched);
  report.set("leaving_image", leaving);
  if (leaving > 0) {
    run.warn(message(leaving, " of ", matched, " curves leave the ", view_name(lookup.to_view),
                     " image: part of them lies behind its posterior edge"));
  }
  report.set("samples", lookup.samples);
  report.set("band", banded);
  for (const std::string& name : lookup.band_without) report.append("band_without", name);
  lookup.history = run.history({{choices.from, from.content_sha256, &from.history},
                                {choices.to, to.content_sha256, &to.history}});
  if (!choices.page.empty()) {
    Timer::Scope phase(run.timer(), "page");
    write_text(choices.page, lookup_page(lookup, read_mammogram(choices.from_image),
                                         read_mammogram(choices.to_image), from));
  }
  write_lookup(choices.lookup, lookup);
}

}  // namespace

int main(int argc, char** argv) {
  Choices choices;
  Tool tool("match-lookup", "the curves of every point of a mammogram, to look up and point at");
  tool.describe(
      "What cc2mlo finds for one point, for a grid of points over the first image: status, curve "
      "in the second image with its deviation, and the column in the MR frame, as one HDF5 file. "
      "--page makes one HTML file that needs no server and no network: pointing at the first image "
      "draws curve and band in the second and the column in the body.");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), section IV-A");
  tool.input(choices.from, "CC.vtkhdf", "compression pointed at");
  tool.input(choices.to, "MLO.vtkhdf", "compression of the same mesh in another view");
  tool.output(choices.lookup, "LOOKUP.h5", "curves on a grid (docs/file-formats.md)");
  tool.number(choices.pitch, "--pitch", "mm", "distance of the grid's points", 0.1, 50);
  tool.choice(choices.geometry, "--geometry", {"parallel", "cone"},
              "beam, as in project-mammogram");
  tool.input_file(choices.priors, "--priors", "FILE",
                  "TSV parameter, standard_deviation for the band");
  tool.output_file(choices.page, "--page", "FILE.html", "the page");
  tool.input_file(choices.from_image, "--from-image", "CC.vti", "its first image");
  tool.input_file(choices.to_image, "--to-image", "MLO.vti", "its second image");
  tool.check([&] { choices.check(); });
  tool.example(
      "match-lookup cc.vtkhdf mlo.vtkhdf lookup.h5 --page page.html --from-image cc.vti "
      "--to-image mlo.vti",
      "lookup and page of the two views");
  return tool.main(argc, argv, [&](Run& run) { run_lookup(choices, run); });
}
