// SPDX-License-Identifier: GPL-3.0-or-later
// The one check that two files belong together, by the table of pairs.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <utility>

#include "lineage/origin.hpp"
#include "lineage/pair_rules.hpp"

namespace breast {

/// The SHA-256 of the scan from which a file comes; "" if it is not known.
std::string scan_behind(const Origin& origin);

/// Checks a pair by its rule, with what `accepted` names allowed to differ. Throws Error (input) with
/// one line that names both files and what differs. Returns a remark if a file does not say where it
/// comes from, so that only side, place and mesh could be compared; otherwise "".
std::string check_pair(const PairRule& rule, const Origin& first, const Origin& second,
                       const std::string& accepted = "");

/// The pairs of one run of a tool. `remark` is called once for each file that does not say where it
/// comes from.
class Pairs {
 public:
  using Remark = std::function<void(const std::string&)>;
  /// `accepted` is the value of --accept-other.
  Pairs(std::string tool, Remark remark, std::string accepted = "")
      : tool_(std::move(tool)), accepted_(std::move(accepted)), remark_(std::move(remark)) {}

  /// Throws Error (input) as check_pair, for the row of the table with these names.
  void check(const std::string& first_name, const Origin& first, const std::string& second_name,
             const Origin& second);

 private:
  std::string tool_, accepted_;
  Remark remark_;
  std::set<std::string> remarked_;
};

}  // namespace breast
