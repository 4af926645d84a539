// SPDX-License-Identifier: GPL-3.0-or-later
// What the targets of the pipeline need of a case (pipelines/goals.tsv).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

/// What a case has, as far as a target may need it.
struct CaseKind {
  bool installed = false;    ///< an installation, without the source tree
  bool phantom = false;      ///< its true body is known
  bool has_tumour = false;   ///< there is a tumour to follow
  bool body_slides = false;  ///< the body of the phantom slides on the chest wall
  bool printed = false;      ///< the model as printed in the paper (PAPER=1)
  bool slurm = false;        ///< cohorts are submitted to Slurm (CLUSTER=slurm)
};

class Goals {
 public:
  /// `names` are the targets given to make; those that the table in `pipelines` does not contain
  /// need nothing.
  Goals(const std::filesystem::path& pipelines, const std::vector<std::string>& names);

  /// True if a target makes results of the paper, whose phantom is `paper`.
  bool of_paper() const;
  /// True if a target is about the case in RUN.
  bool about_case() const;
  /// Throws Error (input) for the first target that a case of this kind cannot have, with the
  /// reason and what to do; `preset` is the phantom.
  void check(const CaseKind& kind, const std::string& preset) const;

 private:
  struct Goal {
    std::string name;
    std::vector<std::string> needs;
    bool has(const std::string& need) const;
  };
  std::vector<Goal> goals_;
};

}  // namespace breast
