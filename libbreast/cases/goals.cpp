// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/goals.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/text/lists.hpp"
#include "study/cells.hpp"

namespace breast {

bool Goals::Goal::has(const std::string& need) const {
  return std::find(needs.begin(), needs.end(), need) != needs.end();
}

Goals::Goals(const std::filesystem::path& pipelines, const std::vector<std::string>& names) {
  const Table table = read_table(pipelines / "goals.tsv");
  for (const std::string& name : names) {
    goals_.push_back({name, {}});
    for (std::size_t r = 0; r < table.rows.size(); ++r)
      if (table.cell(r, "goal") == name) goals_.back().needs = split(table.cell(r, "needs"), ' ');
  }
}

bool Goals::of_paper() const {
  return std::any_of(goals_.begin(), goals_.end(),
                     [](const Goal& goal) { return goal.has("paper"); });
}

bool Goals::about_case() const {
  return std::any_of(goals_.begin(), goals_.end(),
                     [](const Goal& goal) { return !goal.has("any"); });
}

void Goals::check(const CaseKind& kind, const std::string& preset) const {
  const auto refuse = [&](const std::string& need, bool lacking, const std::string& why) {
    if (!lacking) return;
    for (const Goal& goal : goals_)
      if (goal.has(need)) throw input_error(goal.name, ": ", why);
  };
  refuse("source", kind.installed,
         "needs the source tree of libbreast, which is not installed; run it in the source tree");
  refuse("tumour", !kind.has_tumour,
         "needs a tumour to follow, and this case has none; name its place with TUMOUR=x,y,z "
         "(patient LPS, mm), a table or labels, or give TUMOUR=auto for an artificial one");
  refuse("truth", !kind.phantom,
         "a scan has no truth to compare with; leave MR out and name a phantom with PRESET=NAME");
  refuse("held", kind.body_slides,
         "holds the breast at its wall, but the phantom " + preset +
             " slides there; give PRESET=paper or leave PRESET out");
  refuse("slurm", !kind.slurm,
         "prints what would be submitted to Slurm, and CLUSTER is not slurm; give CLUSTER=slurm");
  refuse("truth", kind.printed && kind.body_slides,
         "with PAPER=1 the breast is held at its wall, but the phantom " + preset +
             " slides there; leave PAPER or PRESET out");
}

}  // namespace breast
