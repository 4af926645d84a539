// SPDX-License-Identifier: GPL-3.0-or-later
// Where the files of a study's variants lie: a folder each, RUN/studies/STUDY/VARIANT/STAGE.{json,vtkhdf}, or, as pipelines without
// RUN/studies have them, RUN/FOLDER/VARIANT and VARIANT-STAGE.
#pragma once

#include <filesystem>
#include <string>

namespace breast {

/// RUN/studies/STUDY/VARIANT, or RUN/FOLDER/VARIANT where the run has no studies/STUDY.
std::filesystem::path variant_of(const std::filesystem::path& run, const std::string& study,
                                 const std::string& folder, const std::string& variant);
/// VARIANT/STAGE, or VARIANT-STAGE where the variant is no folder; without ending.
std::string stage_of(const std::filesystem::path& variant, const std::string& stage);

}  // namespace breast
