// SPDX-License-Identifier: GPL-3.0-or-later
// Locations of the files of a study's variants. Every variant has a folder
// RUN/studies/STUDY/VARIANT with files STAGE.json and STAGE.vtkhdf; runs without RUN/studies have
// RUN/FOLDER/VARIANT-STAGE.
#pragma once

#include <filesystem>
#include <string>

namespace breast {

/// RUN/studies/STUDY/VARIANT, or RUN/FOLDER/VARIANT if the run has no studies/STUDY.
std::filesystem::path variant_of(const std::filesystem::path& run, const std::string& study,
                                 const std::string& folder, const std::string& variant);
/// VARIANT/STAGE, or VARIANT-STAGE if the variant is not a folder; without file extension.
std::string stage_of(const std::filesystem::path& variant, const std::string& stage);

}  // namespace breast
