// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/summary.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/atomic_file.hpp"
#include "core/text/lists.hpp"
#include "study/cells.hpp"

namespace breast {

namespace fs = std::filesystem;

std::string tumour_origin(const StageReport& mesh) {
  const std::string tumour = mesh.text("tumour");
  if (tumour.empty()) return "none";
  return tumour.starts_with("artificial") ? "artificial" : "given";
}

std::string aligned(const std::string& tsv) {
  std::vector<Row> rows;
  std::vector<std::size_t> widths;
  std::istringstream in(tsv);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) continue;
    rows.push_back(line.empty() ? Row{} : split(line, '\t'));
    widths.resize(std::max(widths.size(), rows.back().size()), 0);
    for (std::size_t c = 0; c < rows.back().size(); ++c)
      widths[c] = std::max(widths[c], rows.back()[c].size());
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c)
      line += "  " + row[c] + std::string(widths[c] - row[c].size(), ' ');
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string folded(const std::string& text, std::size_t width) {
  std::string lines, rest = text;
  while (rest.size() > width) {
    const std::size_t blank = rest.rfind(' ', width - 1);
    const std::size_t at = blank == std::string::npos ? width : blank + 1;
    lines += rest.substr(0, at) + "\n";
    rest = rest.substr(at);
  }
  return lines + rest + "\n";
}

namespace {

std::string text_of(const fs::path& file) {
  return fs::exists(file) ? read_text(file) : "";
}

std::string warnings_text(const std::vector<Warning>& warnings) {
  if (warnings.empty()) return "There were no warnings.\n";
  std::string text = "Warnings: " + std::to_string(warnings.size()) + "; read these first\n";
  for (const Warning& w : warnings) {
    text += "  " + w.stages + ": " + w.text + "\n";
    if (!w.remedy.empty()) text += "    -> " + w.remedy + "\n";
  }
  return text;
}

std::string tumour_text(const StageReport& mesh) {
  const std::string origin = tumour_origin(mesh);
  if (origin == "none") return "No tumour in this case (TUMOUR=x,y,z follows one).\n";
  if (origin == "artificial") return "THE TUMOUR IS ARTIFICIAL: it was not found in the scan.\n";
  return "Tumour: " + mesh.text("tumour") + ".\n";
}

// The header and the rows with these names.
std::string some_rows(const std::string& tsv, const std::vector<std::string>& names) {
  std::istringstream in(tsv);
  std::string text;
  bool first = true;
  for (std::string line; std::getline(in, line); first = false)
    if (first || std::any_of(names.begin(), names.end(),
                             [&](const std::string& n) { return line.starts_with(n); }))
      text += line + "\n";
  return text;
}

std::string truth_text(const fs::path& run, const fs::path& phantom) {
  std::string text;
  if (const std::string truth = text_of(run / "truth.tsv"); !truth.empty()) {
    text +=
        "\nError against the phantom's truth (mm). The truth's own error is " +
        fixed_cell(StageReport::read(phantom).number("error_estimate_mm"), 3) +
        " mm; smaller errors are not\n" +
        "claimed. Points are the phantom's, found in the chain's mesh; truth.tsv has every one of them.\n" +
        aligned(some_rows(truth, {"nipple", "true-tumour", "mean", "largest"}));
  }
  if (const std::string truth = text_of(run / "truth-cut-fixed.tsv"); !truth.empty()) {
    text += "\nThe same with a fixed cut in the chain, as in the truth (mean and largest)\n" +
            aligned(some_rows(truth, {"mean", "largest"}));
  }
  return text;
}

std::string compression_text(const fs::path& run) {
  std::string text = "\nCompression\n";
  const StageReport cc = StageReport::read(run / "cc.json"),
                    mlo = StageReport::read(run / "mlo.json");
  for (const auto& [name, report] : {std::pair("CC", &cc), std::pair("MLO", &mlo)}) {
    const auto of = [&r = *report](const char* key) { return fixed_cell(r.number(key), 1); };
    text += std::string("  ") + name + std::string(4 - std::string(name).size(), ' ') +
            "thickness " + of("thickness_mm") + " mm, reduction " + of("reduction_percent") +
            " %, paddle " + of("force_N") + " N, detector " + of("detector_force_N") +
            " N, mean pressure " + of("pressure_kPa") + " kPa, status " + report->text("status") +
            "\n";
  }
  const auto cc_line = cc.first("nipple_in_front_mm"), mlo_line = mlo.first("nipple_in_front_mm");
  if (cc_line && mlo_line) {
    text += "  nipple line: CC " + format_fixed(*cc_line, 0) + " mm, MLO " +
            format_fixed(*mlo_line, 0) + " mm to the image edge; they differ by " +
            format_fixed(std::abs(*cc_line - *mlo_line), 0) + " mm (clinics accept 10)\n";
  }
  return text;
}

std::string pictures_text(const fs::path& run) {
  std::vector<std::string> pictures;
  if (fs::is_directory(run / "figures"))
    for (const auto& entry : fs::directory_iterator(run / "figures"))
      if (entry.path().extension() == ".png") pictures.push_back(entry.path().string());
  // The slices of the scan come first, because everything else is made from them.
  const auto first = [](const std::string& picture) { return picture.ends_with("/slices.png"); };
  std::sort(pictures.begin(), pictures.end());
  std::stable_partition(pictures.begin(), pictures.end(), first);
  std::string text = "Pictures: " + run.string() + "/figures/\n";
  for (const std::string& picture : pictures) text += "  " + picture + "\n";
  return text;
}

}  // namespace

std::string summary_text(const fs::path& run, const SummaryContext& context) {
  std::string text =
      "== " + run.string() + "\n\n" + warnings_text(warnings_of(run, context.advice)) + "\n" +
      tumour_text(StageReport::read(run / "mesh.json")) + "\nLandmark displacements (mm)\n" +
      aligned(text_of(run / "displacements.tsv"));
  if (!context.calibration.empty()) {
    std::istringstream lines(folded(context.calibration, 118));
    std::string start = "  supine: ";
    for (std::string line; std::getline(lines, line); start = "  ") text += start + line + "\n";
  }
  if (const std::string cut = text_of(run / "cut.tsv"); !cut.empty()) {
    text +=
        "\nWith a fixed lateral cut instead, supine (relative: distance to the case as solved, mm)\n" +
        aligned(cut);
  }
  text += truth_text(run, context.phantom) + compression_text(run) + "\n";
  const bool curve = fs::exists(run / "curve.tsv") && fs::file_size(run / "curve.tsv") > 0;
  const std::string at = run.string();
  text += curve ? "CC point to MLO curve: " + at + "/curve.tsv, in ParaView " + at + "/curve.vtp\n"
                : "Every CC point and its MLO curve: " + at +
                      "/page.html (a browser opens it), numbers in " + at + "/lookup.h5\n";
  return text + pictures_text(run);
}

}  // namespace breast
