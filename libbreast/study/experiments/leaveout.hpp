// SPDX-License-Identifier: GPL-3.0-or-later
// What each part of the model is worth, and the least model that stays within an error.
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
/// Between the MLO curves of two files.
using CurveReader =
    std::function<CurveGap(const std::filesystem::path& curve, const std::filesystem::path& base)>;

/// A row for the base and every variant of RUN/studies/leaveout (study/places.hpp). Supine: how far tumour and nipple lie from the base's; CC, MLO:
/// the same for the tumour; curve: distance of the MLO curve from the base's, mm. CPU seconds of the stages each question
/// needs, surgery (backward, forward) and matching (backward, both compressions), and what they are less than the base's.
Table leaveout_table(const std::filesystem::path& run, const std::vector<std::string>& variants,
                     const ShapeReader& read, const CurveReader& curves);

struct PartChange {
  std::string part;
  double change;  ///< mm
};
/// What leaving out each of `parts` changes for a question, smallest first: surgery the supine places of tumour and nipple,
/// matching the largest distance on the MLO curve. Throws Error (input) for another question.
std::vector<PartChange> changes(const Table& leaveout, const std::string& question,
                                const std::vector<std::string>& parts);
/// The parts to do without: smallest change first, while the changes add up to no more than `allowed` mm.
std::vector<PartChange> least_model(const std::vector<PartChange>& changes, double allowed);

/// For both questions the parts of least_model(), the sum of their changes, what the variant least-QUESTION really gives, and
/// whether that keeps the error: changes need not add up.
Table recommendation(const std::filesystem::path& run, double allowed,
                     const std::vector<std::string>& parts, const ShapeReader& read,
                     const CurveReader& curves);

/// How far the predicted places move when the chest wall moves by its own standard deviation, mm: the variants of RUN/studies/wall.
Table wall_table(const std::filesystem::path& run, const std::vector<std::string>& variants);

}  // namespace breast
