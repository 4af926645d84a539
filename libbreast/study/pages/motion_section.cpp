// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/pages/motion_section.hpp"

#include <map>

#include "study/cells.hpp"
#include "study/pages/html.hpp"
#include "study/stage_report.hpp"

namespace breast {

namespace {

// The quantities of the tool population in words.
const std::map<std::string, std::string> words = {
    {"nipple_moved_mm", "nipple moved"},
    {"nipple_lateral_mm", "nipple moved laterally"},
    {"nipple_posterior_mm", "nipple moved backwards"},
    {"nipple_caudal_mm", "nipple moved towards the feet"},
    {"nipples_apart_before_mm", "distance between the nipples, prone"},
    {"nipples_apart_after_mm", "distance between the nipples, supine"},
    {"before_notch_before_mm", "nipple in front of the jugular notch, prone"},
    {"before_notch_after_mm", "nipple in front of the jugular notch, supine"},
    {"ribs_before_mm", "mean distance of tissue from the ribs, prone"},
    {"ribs_after_mm", "mean distance of tissue from the ribs, supine"},
    {"ribs_change_mm", "change of the mean distance"},
    {"moved_0_20_mm", "tissue up to 20 mm from the ribs: moved"},
    {"change_0_20_mm", "tissue up to 20 mm from the ribs: change of this distance"},
    {"moved_20_40_mm", "tissue 20 to 40 mm from the ribs: moved"},
    {"change_20_40_mm", "tissue 20 to 40 mm from the ribs: change of this distance"},
    {"moved_above_40_mm", "tissue more than 40 mm from the ribs: moved"},
    {"change_above_40_mm", "tissue more than 40 mm from the ribs: change of this distance"},
    {"moved_near_wall_mm", "tissue at the chest wall: moved"}};

}  // namespace

std::string motion_section(const std::filesystem::path& run) {
  if (!has_something(run / "population.tsv")) return "";
  const Table all = read_table(run / "population.tsv");
  std::string text =
      "<h2>This breast beside living women</h2>\n"
      "<p>Prone to supine, mm; women: mean and standard deviation over 63 persons (pipelines/invivo/women.tsv). One breast "
      "may well lie outside: the last column says whether it is within one standard deviation.</p>\n"
      "<table><tr><th>quantity<th>this breast<th>women<th>SD<th>within one SD</tr>\n";
  for (std::size_t r = 0; r < all.rows.size(); ++r) {
    const std::string quantity = all.cell(r, "quantity");
    const auto known = words.find(quantity);
    text += "<tr><td>" + escaped(known == words.end() ? quantity : known->second);
    for (const char* column : {"mean", "women_mean", "women_sd", "within_one_sd"})
      text += "<td class=n>" + escaped(cell_or_dash(all.cell(r, column)));
    text += "</tr>\n";
  }
  return text + "</table>\n" +
         html_figure(run / "figures/motion.png",
                     "Motion of tissue, and change of its distance from the ribs, by its depth.");
}

}  // namespace breast
