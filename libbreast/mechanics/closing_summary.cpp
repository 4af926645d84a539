// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/closing_summary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.hpp"

namespace breast {

namespace {

/// Three digits suffice here; the report has all of them.
std::string brief(double value) {
  char text[32];
  const bool large = std::abs(value) >= 1000 && std::abs(value) < 1e6;
  std::snprintf(text, sizeof text, large ? "%.0f" : "%.3g", value);
  return text;
}

std::string brief(const Report& report, const std::string& key) {
  return brief(report.number(key));
}

std::string whole(const Report& report, const std::string& key) {
  return std::to_string(static_cast<long long>(report.number(key)));
}

std::string solved(const Report& report) {
  std::string line =
      message("solved ", whole(report, "elements"), " elements (", report.text("element"), "), ");
  line += report.number("unknowns") > 0 ? whole(report, "unknowns") + " unknowns, " : "";
  line += report.contains("bulk_ratio") ? "bulk ratio " + brief(report, "bulk_ratio")
                                        : "exactly incompressible";
  return line + ", materials " + report.text("materials/name") + ": " + report.text("status");
}

void add_laws(const Report& report, std::vector<std::string>& lines) {
  for (int t = 0; t < n_tissues; ++t) {
    const std::string tissue(tissue_name(Tissue(t))), key = "materials/" + tissue + "/";
    if (!report.contains(key + "law")) continue;
    lines.push_back(message(tissue, ": ", report.text(key + "law"), "; μ0 ",
                            brief(report, key + "shear_modulus_Pa"), " Pa, ρgL/μ0 ",
                            brief(report, key + "gravity_number"), ", ellipticity margin ",
                            brief(report, key + "ellipticity_margin")));
  }
}

std::string convergence(const Report& report) {
  return message("steps ", whole(report, "steps"), ", Newton iterations ",
                 whole(report, "newton_iterations"), ", factorisations ",
                 whole(report, "factorisations"), "; residual ", brief(report, "residual"),
                 ", worst |J-1| ", brief(report, "max_volume_error"), ", min det F ",
                 brief(report, "min_det_F"));
}

/// Phases in the order of their cost, without those below a hundredth of a second.
std::string cost(const Report& report, const Timer& timer) {
  std::vector<std::pair<double, std::string>> phases;
  for (const auto& [name, seconds] : timer.seconds()) {
    if (seconds >= 0.01) phases.emplace_back(seconds, name);
  }
  std::sort(phases.rbegin(), phases.rend());
  std::string line;
  for (const auto& [seconds, name] : phases) line += name + " " + brief(seconds) + " s, ";
  return line + "peak " + brief(report, "peak_mb") + " MB";
}

std::string accuracy(const Report& report, const Timer& timer) {
  std::string line = "discretisation error not estimated";
  if (report.text("error_estimate_mm") != "null") {
    line = message("discretisation error at the landmarks about ",
                   brief(report, "error_estimate_mm"), " mm (", report.text("error_estimate_how"),
                   "), found in ", brief(timer.seconds("error estimate")), " s");
  } else if (report.contains("error_estimate_how")) {
    line += ": " + report.text("error_estimate_how");
  }
  if (report.contains("closure_mm")) {
    line += "; forward returns to the scan within " + brief(report, "closure_mm") + " mm";
  }
  return line;
}

}  // namespace

std::vector<std::string> closing_summary(const Report& report, const Timer& timer,
                                         const std::vector<std::string>& results) {
  std::vector<std::string> lines{solved(report), "model: " + report.text("model")};
  add_laws(report, lines);
  lines.push_back(convergence(report));
  lines.insert(lines.end(), results.begin(), results.end());
  lines.push_back(cost(report, timer));
  lines.push_back(accuracy(report, timer));
  return lines;
}

void tell_summary(const Report& report, const Timer& timer, Progress& progress,
                  const std::vector<std::string>& results) {
  for (const std::string& line : closing_summary(report, timer, results)) progress.note(line);
}

}  // namespace breast
