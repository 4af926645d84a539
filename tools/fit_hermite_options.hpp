// SPDX-License-Identifier: GPL-3.0-or-later
// The command-line options of fit-hermite.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/tool.hpp"
#include "fit/fit_breast.hpp"
#include "label_input.hpp"

namespace breast {

struct FitChoices {
  std::filesystem::path labels, geometry;
  std::string elements = "auto", smoothing = "auto";
  std::optional<double> max_error;  ///< mm
  LabelChoices foreign;

  /// Throws Error (input) if a text cannot be parsed.
  FitOptions options() const;
};

/// Declares all options of the tool, its description and examples.
void declare_fit_hermite(Tool& tool, FitChoices& choices);

}  // namespace breast
