// SPDX-License-Identifier: GPL-3.0-or-later
// Which breast a mammogram shows and how, from each place where a header may say so.
#pragma once

#include <optional>
#include <string>

#include "core/types.hpp"
#include "io/dicom/mammogram_fields.hpp"
#include "mesh/view.hpp"

namespace breast {

/// The one view that a free text names: "L CC", "RMLO", "medio-lateral oblique". None if it names none, or
/// several.
std::optional<View> view_in_text(const std::string& text);
/// The one side that a free text names: "L CC", "RMLO", "left".
std::optional<Side> side_in_text(const std::string& text);

/// From View Position (0018,5101) and View Code Sequence (0054,0220), which must agree; without them, with
/// a remark, from the texts of Acquisition Device Processing Description (0018,1400), Series Description
/// and Protocol Name. Throws Error (input) for a view that is not simulated, and if none is stated.
View stated_view(MammogramFields& fields);
/// From Image Laterality (0020,0062), Laterality (0020,0060) or, with a remark, the same texts.
Side stated_side(MammogramFields& fields);

/// Throws Error (input) for what the simulated compression does not show: a spot compression, a breast with
/// an implant, a part of a breast. Other modifiers that change the compression are remarked.
void refuse_what_is_not_simulated(MammogramFields& fields);
/// Whether a modifier or a text says that the view is magnified.
bool is_magnification_view(const MammogramFields& fields);

}  // namespace breast
