// SPDX-License-Identifier: GPL-3.0-or-later
// The contents behind a file, by the stage of the chain at which its history names them.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "lineage/origin.hpp"

namespace breast {

/// "scans", "meshes" ...
const char* stage_words(Stage stage);

class Contents {
 public:
  explicit Contents(const Origin& origin);

  /// Whether a content of this stage or a later one is behind both.
  bool share_from(Stage stage, const Contents& other) const;
  /// The first stage, at most this one, of which both know the contents but have none in common.
  /// Labels and geometries are left out: one scan may be segmented and fitted several times.
  std::optional<Stage> parted_until(Stage stage, const Contents& other) const;
  /// The names of both sides' files of that stage: " (a.nrrd and b.nrrd)".
  std::string names_at(Stage stage, const Contents& other) const;
  /// Whether a content of this stage is known.
  bool know(Stage stage) const { return !at(stage).empty(); }
  /// The SHA-256 of a content of this stage; "" if none is known.
  std::string one_of(Stage stage) const { return know(stage) ? at(stage).begin()->first : ""; }

 private:
  using Names = std::map<std::string, std::string>;  ///< file name by SHA-256
  const Names& at(Stage stage) const { return at_[std::size_t(stage)]; }
  void add(Stage stage, const std::string& sha256, const std::string& name);

  std::array<Names, 6> at_;
};

}  // namespace breast
