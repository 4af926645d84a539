// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/pages/motion_section.hpp"

#include <algorithm>

#include "study/cells.hpp"
#include "study/pages/html.hpp"
#include "study/stage_report.hpp"

namespace breast {

std::string motion_section(const std::filesystem::path& run) {
  if (!has_something(run / "population.tsv")) return "";
  const Table all = read_table(run / "population.tsv");
  std::string text =
      "<h2>This breast beside living women</h2>\n"
      "<p>Prone to supine, mm; women: mean and standard deviation over 63 persons (pipelines/invivo/women.tsv). One breast "
      "may well lie outside: the last column says whether it is within one standard deviation.</p>\n"
      "<table><tr><th>quantity<th>this breast<th>women<th>SD<th>within one SD</tr>\n";
  for (std::size_t r = 0; r < all.rows.size(); ++r) {
    std::string quantity = all.cell(r, "quantity");
    std::replace(quantity.begin(), quantity.end(), '_', ' ');
    text += "<tr><td>" + escaped(quantity);
    for (const char* column : {"mean", "women_mean", "women_sd", "within_one_sd"})
      text += "<td class=n>" + escaped(cell_or_dash(all.cell(r, column)));
    text += "</tr>\n";
  }
  return text + "</table>\n" +
         html_figure(run / "figures/motion.png",
                     "Motion of tissue, and change of its distance from the ribs, by its depth.");
}

}  // namespace breast
