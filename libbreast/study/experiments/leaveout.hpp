// SPDX-License-Identifier: GPL-3.0-or-later
// The effect of leaving out parts of the model, and the simplest model that stays within a given
// error.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "study/shape.hpp"

namespace breast {

struct CurveGap {
  double mean = 0, most = 0;  ///< mm on the MLO detector
};
/// Distances between the MLO curves of two files.
using CurveReader =
    std::function<CurveGap(const std::filesystem::path& curve, const std::filesystem::path& base)>;

/// One row for the base and for every variant of RUN/studies/leaveout. Supine: distance of tumour
/// and nipple from their positions in the base; CC, MLO: the same for the tumour; curve: distance
/// of the MLO curve from that of the base; all in mm. CPU seconds of the stages that each question
/// needs, surgery (backward, forward) and matching (backward, both compressions), and the time
/// saved relative to the base.
Table leaveout_table(const std::filesystem::path& run, const std::vector<std::string>& variants,
                     const ShapeReader& read, const CurveReader& curves);

struct PartChange {
  std::string part;
  double change;  ///< mm
};
/// The change caused by leaving out each of `parts` for a question, smallest first: for surgery in
/// the supine positions of tumour and nipple, for matching the largest distance on the MLO curve.
/// Throws Error (input) for another question.
std::vector<PartChange> changes(const Table& leaveout, const std::string& question,
                                const std::vector<std::string>& parts);
/// The parts that can be left out: those with the smallest changes, as long as the changes add up
/// to no more than `allowed` mm.
std::vector<PartChange> least_model(const std::vector<PartChange>& changes, double allowed);

/// For both questions: the parts of least_model(), the sum of their changes, the change in the
/// variant least-QUESTION solved with all of them left out, and whether it stays within the error.
/// (The changes need not add up.)
Table recommendation(const std::filesystem::path& run, double allowed,
                     const std::vector<std::string>& parts, const ShapeReader& read,
                     const CurveReader& curves);

/// The displacement in mm of the predicted positions when the chest wall moves by its own standard
/// deviation, from the variants of RUN/studies/wall.
Table wall_table(const std::filesystem::path& run, const std::vector<std::string>& variants);

}  // namespace breast
