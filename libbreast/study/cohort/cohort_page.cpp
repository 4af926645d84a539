// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/cohort/cohort_page.hpp"

#include <algorithm>
#include <cmath>

#include "core/text/base64.hpp"
#include "study/cells.hpp"
#include "study/pages/html.hpp"

namespace breast {

namespace {

const std::string cohort_style =
    R"(body { font: 15px/1.4 sans-serif; margin: 1.5em; color: #222 } table { border-collapse: collapse; margin: .8em 0; font-size: 13px }
th, td { border: 1px solid #ccc; padding: 2px 7px; text-align: left; vertical-align: top } th { background: #f2f2f2 }
td.n { text-align: right; font-variant-numeric: tabular-nums } td.bad, figure.bad figcaption { background: #fbd5d0 }
.look { background: #fff4d6 } img { max-width: 100%; display: block } td img { width: 240px }
.strip { position: relative; width: 260px; height: 16px } .strip b { position: absolute; height: 16px; background: #ddd }
.strip i { position: absolute; top: 3px; width: 3px; height: 10px; margin-left: -1px; background: #246 }
figure { margin: 0 0 10px; break-inside: avoid }
figcaption { font-size: 13px; padding: 1px 4px }
)";

bool done(const Table& cases, std::size_t row) {
  return cases.cell(row, "status") == "done";
}
bool asks(const Table& cases, std::size_t row) {
  return cases.cell(row, "look") != no_value;
}

// Failed cases first, then those that should be checked, then the others.
std::vector<std::size_t> ordered(const Table& cases) {
  std::vector<std::size_t> rows(cases.rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) rows[r] = r;
  const auto rank = [&](std::size_t r) { return !done(cases, r) ? 0 : asks(cases, r) ? 1 : 2; };
  std::stable_sort(rows.begin(), rows.end(),
                   [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return rows;
}

std::string counted(const Table& cases) {
  std::size_t good = 0, looking = 0;
  for (std::size_t r = 0; r < cases.rows.size(); ++r) {
    good += done(cases, r) ? 1 : 0;
    looking += done(cases, r) && asks(cases, r) ? 1 : 0;
  }
  const std::size_t all = cases.rows.size();
  return std::to_string(all) + " cases: " + std::to_string(good) + " done, " +
         std::to_string(all - good) + " failed, " + std::to_string(looking) + " ask for a look.";
}

std::string head(const std::string& title, const CohortPages& cohort) {
  return page_head(title, cohort_style) + "<h1>" + escaped(title) + "</h1>\n" +
         (cohort.pictures.possible
              ? ""
              : "<p class=look>No pictures: netpbm is not installed where this page was made (apt-get install netpbm).</p>\n");
}

std::string jpeg(const std::string& bytes) {
  return "data:image/jpeg;base64," + base64(bytes);
}

std::string thumbnail(const CohortPages& cohort, const std::filesystem::path& png, int width,
                      const std::string& text) {
  const std::string bytes = cohort.pictures.small(png, width);
  return bytes.empty()
             ? ""
             : "<img loading=\"lazy\" alt=\"" + escaped(text) + "\" src=\"" + jpeg(bytes) + "\">";
}

// The numbers of a column as a row of dots, one per case, over a grey band for the women's mean and
// deviation.
std::string distribution_row(const Table& table, const std::string& column, const Table& women) {
  if (!table.has(column)) return "";
  std::vector<double> values;
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (const auto value = number_of(table.cell(r, column))) values.push_back(*value);
  if (values.empty()) return "";
  const Distribution d = distribution_of(values);
  const auto mean = number_at(women, column, "mean"), sd = number_at(women, column, "sd");
  double low = d.values.front(), high = d.values.back();
  if (mean && sd) low = std::min(low, *mean - 2 * *sd), high = std::max(high, *mean + 2 * *sd);
  const double scale = high > low ? 100 / (high - low) : 0;
  const auto number = [](const std::string& text) { return "<td class=n>" + text; };
  std::string row =
      "<tr><td>" + escaped(column) + number(std::to_string(d.values.size())) +
      number(general(d.mean, 4)) + number(general(d.sd, 3)) + number(general(d.values.front(), 4)) +
      number(general(d.values.back(), 4)) + "<td>" +
      (mean && sd ? cell_at(women, column, "mean") + " (" + cell_at(women, column, "sd") + ")"
                  : no_value) +
      "<td><div class=strip>";
  if (mean && sd)
    row += "<b style=\"left:" + format_fixed((*mean - *sd - low) * scale, 1) +
           "%;width:" + format_fixed(2 * *sd * scale, 1) + "%\"></b>";
  for (const double value : d.values)
    row += "<i style=\"left:" + format_fixed((value - low) * scale, 1) + "%\"></i>";
  return row + "</div></tr>\n";
}

std::string distributions(const CohortPages& cohort) {
  std::string text =
      "<h2>Distributions</h2><p>One dot per case; grey: mean and one standard deviation of living "
      "women (63 volunteers, prone to supine) where these are "
      "known.</p>\n<table><tr><th>quantity<th>cases<th>mean<th>sd<th>lowest<th>highest<th>women: "
      "mean (sd)<th></tr>\n";
  for (const char* column :
       {"volume_ml", "min_scaled_jacobian", "supine_nipple_mm", "supine_tumour_mm",
        "cc_thickness_mm", "cc_force_N", "mlo_thickness_mm", "mlo_force_N"})
    text += distribution_row(cohort.cases, column, cohort.women);
  if (cohort.motion)
    for (std::size_t c = 2; c < cohort.motion->columns.size(); ++c)
      text += distribution_row(*cohort.motion, cohort.motion->columns[c], cohort.women);
  return text + "</table>\n";
}

std::string failed_part(const CohortPages& cohort) {
  std::string rows;
  for (std::size_t r = 0; r < cohort.cases.rows.size(); ++r) {
    if (done(cohort.cases, r)) continue;
    const std::string name = cohort.cases.cell(r, "case"),
                      log = escaped(cohort.cases.cell(r, "log"));
    rows += "<tr><td>" + escaped(name) + "<td class=bad>" +
            escaped(cohort.cases.cell(r, "reason")) + "<td><a href=\"" + log + "\">" + log +
            "</a><td>" +
            thumbnail(cohort, cohort.runs / name / "contours.png", 240, "contours of " + name) +
            "</tr>\n";
  }
  return rows.empty() ? rows
                      : "<h2>Failed</h2><table><tr><th>case<th>reason<th>log<th>contours</tr>\n" +
                            rows + "</table>\n";
}

// One remark per line.
std::string lines(const std::string& look) {
  std::string text;
  for (std::size_t at = 0; at < look.size();) {
    const std::size_t end = std::min(look.find("; ", at), look.size());
    text += (at == 0 ? "" : "<br>") + escaped(look.substr(at, end - at));
    at = end + 2;
  }
  return text;
}

std::string done_part(const CohortPages& cohort) {
  std::string rows;
  for (const std::size_t r : ordered(cohort.cases)) {
    if (!done(cohort.cases, r)) continue;
    const auto value = [&](const char* column) { return escaped(cohort.cases.cell(r, column)); };
    const std::string name = cohort.cases.cell(r, "case");
    rows +=
        "<tr><td>" + escaped(name) + "<td class=\"" + (asks(cohort.cases, r) ? "look" : "") +
        "\">" + lines(cohort.cases.cell(r, "look")) + "<td class=n>" + value("volume_ml") +
        "<td class=n>" + value("supine_nipple_mm") + "<td class=n>" + value("cc_thickness_mm") +
        ", " + value("cc_force_N") + "<td class=n>" + value("mlo_thickness_mm") + ", " +
        value("mlo_force_N") + "<td>" +
        thumbnail(cohort, cohort.runs / name / "figures/summary.png", 480, "the chain of " + name) +
        "</tr>\n";
  }
  return rows.empty()
             ? rows
             : "<h2>Done</h2><table><tr><th>case<th>look at<th>volume ml<th>supine nipple mm<th>CC mm, N<th>MLO mm, N<th>picture</tr>\n" +
                   rows + "</table>\n";
}

}  // namespace

Distribution distribution_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  Distribution d{std::move(values), 0, 0};
  const double n = double(d.values.size());
  for (const double value : d.values) d.mean += value / n;
  double square = 0;
  for (const double value : d.values) square += (value - d.mean) * (value - d.mean);
  constexpr double rounding = 1e-18;
  d.sd = n > 1 && square > rounding ? std::sqrt(square / (n - 1)) : 0;
  return d;
}

std::string cohort_page(const CohortPages& cohort) {
  return head(cohort.runs.filename(), cohort) + "<p>" + counted(cohort.cases) +
         " <a href=\"contours.html\">Contours of all segmentations</a>; tables: cohort.tsv, motion.tsv, women.tsv, cost.tsv.</p>\n" +
         failed_part(cohort) + distributions(cohort) + done_part(cohort) + "<h2>Cost</h2>\n" +
         html_table(cohort.cost.text()) + page_end;
}

std::string contours_page(const CohortPages& cohort) {
  std::string text =
      head("Segmentations of " + cohort.runs.filename().string(), cohort) + "<p>" +
      counted(cohort.cases) +
      " Contours of the chest wall (green, orange where it is uncertain), the breast (yellow) and "
      "its fibroglandular tissue (red) in three axial and two sagittal slices of every scan, 0.7 "
      "mm per pixel; failed cases and those that should be checked come first. A click opens all "
      "sixteen slices. A chest wall in the ribs or in the breast, a breast cut off at its side, "
      "or fibroglandular tissue where the coil overexposes the image needs a correction "
      "(CHEST_WALL=).</p>\n";
  for (const std::size_t r : ordered(cohort.cases)) {
    const std::string name = cohort.cases.cell(r, "case"), look = cohort.cases.cell(r, "look");
    const std::string kind = !done(cohort.cases, r) ? "bad" : asks(cohort.cases, r) ? "look" : "";
    const std::string said = !done(cohort.cases, r)  ? "failed: " + cohort.cases.cell(r, "reason")
                             : asks(cohort.cases, r) ? look
                                                     : "";
    const std::string slices = cohort.pictures.slices(cohort.runs / name / "contours.png");
    const std::string picture =
        slices.empty() ? "<p>no contours</p>"
                       : "<a href=\"" + escaped(name) + "/contours.png\"><img alt=\"contours of " +
                             escaped(name) + "\" src=\"" + jpeg(slices) + "\"></a>";
    text += "<figure class=\"" + kind + "\"><figcaption class=\"" + kind + "\"><b>" +
            escaped(name) + "</b> " + escaped(said) + "</figcaption>" + picture + "</figure>\n";
  }
  return text + page_end;
}

}  // namespace breast
