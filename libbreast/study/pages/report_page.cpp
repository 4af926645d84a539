// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/pages/report_page.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <sstream>

#include <sys/stat.h>

#include "core/atomic_file.hpp"
#include "study/cells.hpp"
#include "study/pages/html.hpp"
#include "study/pages/motion_section.hpp"
#include "study/stage_report.hpp"
#include "study/summary.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

const std::string report_style =
    R"(body { font: 15px/1.45 sans-serif; max-width: 1150px; margin: 2em auto; padding: 0 1em; color: #222 }
table { border-collapse: collapse; margin: .8em 0; font-size: 13px } th, td { border: 1px solid #ccc; padding: 2px 7px; text-align: left; vertical-align: top }
th { background: #f2f2f2 } td.n { text-align: right; font-variant-numeric: tabular-nums } td.bad { background: #fbd5d0 }
.warnings { background: #fff4d6; border: 1px solid #d9b44a; padding: 0 1em } .bad { background: #fbd5d0; padding: .5em }
figure { margin: 1em 0 } img { max-width: 100% } figcaption { font-size: 13px; color: #555 } pre { font-size: 12px; overflow-x: auto; background: #f7f7f7; padding: .7em }
@page { size: A4 landscape; margin: 12mm }
@media print { body { max-width: none; margin: 0; font-size: 11px } table { font-size: 9px } img { max-height: 165mm } figure:first-of-type img { max-height: 140mm } h2 { break-after: avoid } figure, tr { break-inside: avoid } pre { white-space: pre-wrap } }
)";

std::string section(const std::string& title) {
  return "<h2>" + title + "</h2>\n";
}
std::string note(const std::string& text) {
  return "<p>" + text + "</p>\n";
}

std::string dated(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return no_value;
  std::tm utc{};
  gmtime_r(&status.st_mtime, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &utc);
  return text;
}

std::vector<fs::path> files_in(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ending && !entry.path().filename().string().starts_with('.'))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// Tables and plots of a slow target, if it was run.
std::string extra(const std::string& title, const std::string& text, std::vector<fs::path> files) {
  std::erase_if(files, [](const fs::path& file) { return !has_something(file); });
  if (files.empty()) return "";
  std::string html = section(title) + note(text);
  for (const fs::path& file : files) {
    html += "<h3>" + escaped(file.stem()) + " <small>(" + dated(file) + ")</small></h3>\n";
    html += file.extension() == ".png" ? html_figure(file, file.filename()) : html_table_of(file);
  }
  return html;
}
std::vector<fs::path> both(const fs::path& folder) {
  std::vector<fs::path> files = files_in(folder, ".tsv"), pictures = files_in(folder, ".png");
  files.insert(files.end(), pictures.begin(), pictures.end());
  return files;
}

std::string warnings_box(const std::vector<Warning>& warnings) {
  if (warnings.empty()) return "<p>There were no warnings.</p>\n";
  std::string text = "<div class=warnings><h2>Warnings: " + std::to_string(warnings.size()) +
                     "; read these first</h2>\n<ul>\n";
  for (const Warning& w : warnings) {
    text += "<li><b>" + escaped(w.stages) + "</b>: " + escaped(w.text) +
            (w.remedy.empty() ? "" : "<br>&rarr; " + escaped(w.remedy)) + "</li>\n";
  }
  return text + "</ul></div>\n";
}

// The header and the rows with these names.
std::string truth_rows(const fs::path& file) {
  const std::vector<std::string> names{"nipple", "true-tumour", "mean", "largest"};
  std::istringstream in(read_text(file));
  std::string text;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) continue;
    if (text.empty() ||
        std::find(names.begin(), names.end(), line.substr(0, line.find('\t'))) != names.end())
      text += line + "\n";
  }
  return text;
}

// A number with a decimal point with four digits; any other text unchanged.
std::string short_number(const std::string& value) {
  const auto number = number_of(value);
  return number && value.find('.') != std::string::npos ? general(*number, 4) : cell_or_dash(value);
}

std::string compression_table(const fs::path& run) {
  std::string text =
      "<table><tr><th>view<th>status<th>thickness mm<th>reduction %<th>paddle force N<th>detector force N<th>mean pressure kPa<th>area "
      "cm2<th>Newton iterations<th>error estimate mm</tr>\n";
  for (const std::string view : {"cc", "mlo"}) {
    const StageReport report = StageReport::read(run / (view + ".json"));
    text += view == "cc" ? "<tr><td>CC" : "<tr><td>MLO";
    for (const char* key :
         {"status", "thickness_mm", "reduction_percent", "force_N", "detector_force_N",
          "pressure_kPa", "area_cm2", "newton_iterations", "error_estimate_mm"})
      text += "<td>" + escaped(short_number(report.text(key)));
    text += "</tr>\n";
  }
  return text + "</table>\n";
}

struct Words {
  bool tumour = false;
  std::string in_4, in_6;  ///< text in the caption
};
Words tumour_words(const std::string& origin) {
  if (origin == "none") return {};
  const std::string name = origin == "artificial" ? "the artificial tumour" : "the tumour";
  return {true, " and " + name, " " + name};
}

std::string figures(const fs::path& run, const Words& words) {
  const auto picture = [&](const char* name, const std::string& caption) {
    return html_figure(run / "figures" / (std::string(name) + ".png"), caption);
  };
  std::string text = section("Figure 4: from data points to the mesh");
  text += picture("points", "4a. Skin (light) and chest-wall (dark) data points.");
  text +=
      picture("geometry", "4b. The fitted cubic-Hermite sheets and the rim where the body ends.");
  text += picture("mesh", "4c. The hexahedral mesh from the front, and its back surface (dark).");
  text += picture("tissues",
                  "4d. Fibroglandular tissue (violet; the surface that encloses its volume)" +
                      words.in_4 + " through the translucent skin.");
  text += picture(
      "outlines",
      "The shapes in the scan, stress-free and supine, superimposed; arrows from the scan to "
      "supine, lengths in space.");
  text += section("Figure 5: mammographic compression");
  text += picture("cc-compression",
                  "5a, b. Before and after CC compression, with the plates; orange: the border "
                  "of the image on the detector.");
  text += picture("mlo-compression", "5c, d. MLO compression, two views.");
  text += picture(
      "pressure",
      "Contact pressure under paddle and detector; blue: where the flat of the plate begins.");
  text += picture("force-thickness", "Force of both plates against thickness.");
  text += section("Figure 6: simulated mammograms");
  text +=
      picture("cc-mammogram", "6a. CC" + (words.tumour ? "; the yellow ring is" + words.in_6 : "") +
                                  ". White ring: nipple.");
  text +=
      picture("mlo-mammogram",
              "6b. MLO" +
                  (words.tumour ? "; the computed curve, the place the model gives" + words.in_6 +
                                      " (ring) and the arc of equal nipple distance"
                                : "") +
                  ".");
  text += picture("cc-points", "6c. A selection of CC points.") +
          picture("mlo-curves", "6d. Their curves in MLO.");
  if (words.tumour) text += section("Figure 7: the column of the tumour's pixel");
  text += picture("cc-matching",
                  "7a, b. The column in the CC breast, and the same tissue stress-free.");
  return text + picture("mlo-matching", "7c. The same tissue stress-free and in the MLO breast.");
}

// CPU seconds of all solves for Tables III to VI, from their reports.
double solved_again(const fs::path& run) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& variant : fs::directory_iterator(run / "studies/scaled", ignored))
    for (const fs::path& file : files_in(variant.path(), ".json")) files.push_back(file);
  double total = 0;
  for (const fs::path& file : files) {
    const std::string name = file.stem();
    if (name.ends_with("reference") || name.ends_with("supine"))
      total += StageReport::read(file).number("cpu_seconds").value_or(0);
  }
  return total;
}

std::string paper_tables(const fs::path& run, const std::string& calibrated) {
  const fs::path tables = run / "tables";
  if (!has_something(tables / "table2.tsv")) return "";
  std::string text =
      section("Table II: constants of law (9)") + html_table_of(tables / "table2.tsv");
  const std::vector<std::pair<std::string, std::string>> numbered{
      {"3", "III: fat"},
      {"4", "IV: fibroglandular tissue"},
      {"5", "V: skin"},
      {"6", "VI: one element of tumour"}};
  for (const auto& [number, title] : numbered) {
    const fs::path own = tables / ("table" + number + ".tsv"),
                   printed = tables / ("table" + number + "-as-printed.tsv");
    text +=
        section("Table " + title) +
        note(
            "Displacements from prone to supine, mm, when the stiffness of this tissue is scaled; "
            "<i>rel</i>: distance from the 100 % row. The paper's value and the difference stand "
            "beside ours; <i>estimate</i>: estimated discretisation error at the landmarks." +
            (calibrated.empty() ? "" : " Row of 100 %: " + calibrated + "."));
    if (has_something(printed))
      text +=
          "<h3>As printed in the paper: cuboid, plain invariants, skin as a layer of elements</h3>\n" +
          html_table_of(printed) + "<h3>As solved here</h3>\n";
    text += html_table_of(own);
  }
  return text + section("The paper's conclusions, in numbers") +
         note(
             "Slopes are d ln u / d ln s between the rows of 90 and 110 %. The text of the paper "
             "rounds its slope of -0.61 to &ldquo;10 % changes ... approximately 10 %&rdquo;; its "
             "own rows give 6 to 7 %.") +
         html_table_of(tables / "conclusions.tsv");
}

std::string own_tables(const fs::path& run, const std::string& calibrated) {
  const fs::path tables = run / "tables";
  std::string text;
  if (has_something(tables / "table7.tsv")) {
    text +=
        section("Table VII, ours: every slope from one solve") +
        note(
            "Tangent-linear derivatives of the converged state (<i>tangent</i>), compared with "
            "the rows of Tables III to VI solved again (<i>resolved</i>: three-point derivative "
            "in ln s). <i>Step error</i> is the error of the finite steps between these rows; the "
            "two agree if they differ by at most twice that. Cost: " +
            fixed_cell(StageReport::read(run / "slopes.json").number("cpu_seconds"), 2) +
            " CPU seconds for all slopes, and " + format_fixed(solved_again(run), 0) +
            " for the solves of the tables.") +
        html_table_of(tables / "table7.tsv");
  }
  if (has_something(tables / "table8.tsv")) {
    text +=
        section("Table VIII, ours: do the conclusions survive another stiffness?") +
        note(
            "The same conclusions on the same mesh, with slopes from one solve each. "
            "<i>columns</i>: Table II's second-order constants taken as a11, a20, a02 instead of "
            "the printed a20, a02, a11. <i>mira2018</i>: identified in vivo, ten times softer, so "
            "that gravity matters ten times more; if the imaged shape has no stress-free body "
            "with this set, no conclusion can be drawn and the reason is given. "
            "<i>mira2018-x10</i>: the same set with ten times the stiffness.") +
        html_table_of(tables / "table8.tsv");
  }
  if (has_something(tables / "findings.tsv")) {
    text +=
        section("Numerical part of the results") +
        note(
            "The default model with one choice at a time made as in the paper, and with all of "
            "them (as printed), compared with the finest solution (27-node elements). The choices "
            "are plain instead of isochoric invariants, cuboid instead of dome, and skin as a "
            "layer of elements instead of a membrane." +
            (calibrated.empty() ? "" : " Default and as printed: " + calibrated + ".")) +
        html_table_of(tables / "findings.tsv");
  }
  return text;
}

std::string slow_targets(const fs::path& run, const fs::path& runs) {
  return extra("Leaving parts out",
               "Change at the landmarks and on the MLO curve relative to the full model, and the "
               "CPU seconds saved; then the simplest model that stays within the given error, and "
               "its actual change.",
               {run / "leaveout/table.tsv", run / "leaveout/recommendation.tsv"}) +
         extra("Error against run time", "Landmark error (mm) against CPU seconds.",
               both(run / "cost")) +
         extra("Error budget",
               "Errors (mm) that remain when one stage of the chain is replaced by the phantom's "
               "truth, and the CPU seconds of that stage.",
               both(run / "budget")) +
         extra("Stability", "Extreme cases: each converges, or stops with a reason.",
               {runs / "stability/summary.tsv", runs / "stability/mechanics.tsv",
                runs / "stability/contact.tsv"}) +
         extra("Independent solver", "The same scene in CalculiX.",
               {runs / "compare/all.tsv", runs / "compare/pressed.tsv"}) +
         extra(
             "The cohort beside living women",
             "Motion from prone to supine, mm, of the breasts that the material set was not calibrated on.",
             {runs / "population/judging.tsv", runs / "population/motion.png"});
}

std::string cost_table_of(const fs::path& run) {
  std::string text = section("Cost") + "<table><tr><th>stage<th>seconds<th>peak MB</tr>\n";
  for (const std::string& stage : chain_stages) {
    const StageReport report = StageReport::read(run / (stage + ".json"));
    if (report.empty()) continue;
    text += "<tr><td>" + stage + "<td class=n>" + fixed_cell(report.number("seconds/total"), 2) +
            "<td class=n>" + fixed_cell(report.number("peak_mb"), 0) + "</tr>\n";
  }
  return text + "</table>\n";
}

// Words without the folders in them, because a page that is sent must not describe this machine.
std::string without_folders(const std::string& text) {
  std::string shown, word;
  for (const char c : text) {
    if (c == '/') {
      word.clear();
    } else if (c == ' ' || c == ',' || c == '=' || c == ':' || c == '\n') {
      shown += word + c;
      word.clear();
    } else {
      word += c;
    }
  }
  return shown + word;
}

std::string commands(const fs::path& run) {
  std::vector<fs::path> records;
  for (const auto& entry : fs::directory_iterator(run)) {
    const std::string name = entry.path().filename();
    if (name.starts_with('.') && name.ends_with(".settings")) records.push_back(entry.path());
  }
  std::sort(records.begin(), records.end());
  std::string text = section("Commands") + note("Program and settings of every stage:") + "<pre>";
  for (const fs::path& record : records) {
    const std::string said = without_folders(read_text(record));
    text += escaped(record.stem().string().substr(1)) + ": " +
            escaped(said.substr(0, said.find_last_not_of('\n') + 1)) + "\n";
  }
  return text + "</pre>\n";
}

}  // namespace

std::string report_page(const fs::path& run, const ReportContext& context) {
  const std::string name = escaped(run.filename()), calibrated = escaped(context.calibration);
  const std::string origin = tumour_origin(StageReport::read(run / "mesh.json"));
  const Words words = tumour_words(origin);
  std::string html = page_head("libbreast: " + run.filename().string(), report_style) +
                     "<h1>Breast deformation: case " + name + "</h1>\n";
  html +=
      "<p>From a prone MR scan to the stress-free, supine and compressed shapes, two simulated mammograms and the CC&rarr;MLO curve,\n"
      "after Pathmanathan, Gavaghan, Whiteley, Chapman and Brady, IEEE Trans Biomed Eng 55(10), 2008. " +
      escaped(context.made) + "</p>\n";
  html += warnings_box(warnings_of(run, context.advice));
  if (origin == "artificial")
    html +=
        "<p class=bad><b>The tumour of this case is artificial: it was not found in the scan.</b> "
        "Every figure and table below follows that point.</p>\n";
  html += html_figure(
      run / "figures/slices.png",
      "The scan in three planes" + (words.tumour ? " through" + words.in_6 : std::string()) +
          " with the contours of its segmentation; check these before all that follows.");
  html += html_figure(
      run / "figures/summary.png",
      "The chain: the scan, the silhouettes of the postures, CC and MLO compression, simulated mammograms" +
          std::string(words.tumour ? " and the matched curve" : "") + ".");
  html += section("Landmarks") + html_table_of(run / "displacements.tsv");
  if (!calibrated.empty()) html += note("Supine: " + calibrated + ".");
  if (has_something(run / "truth.tsv"))
    html += note(
                "Errors against the phantom's truth, mm; the mean and the largest are over all its "
                "landmarks:") +
            html_table(truth_rows(run / "truth.tsv"));
  html += motion_section(run) + section("Compression") + compression_table(run) +
          figures(run, words) + paper_tables(run, calibrated) + own_tables(run, calibrated) +
          slow_targets(run, context.runs);
  if (has_something(run / "verify.tsv"))
    html += section("Expected values") + html_table_of(run / "verify.tsv");
  html +=
      cost_table_of(run) + commands(run) + section("What is not reproduced, and why") + "<ul>\n";
  for (const std::string& limit : context.limits) html += "<li>" + escaped(limit) + "\n";
  return html + "</ul>\n" + page_end;
}

}  // namespace breast
