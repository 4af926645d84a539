// What a segmentation measured, as named numbers for the report and for a table.
#pragma once

#include <string>
#include <vector>

#include "segment/segment.hpp"

namespace breast {

struct Measure {
  std::string name;  ///< in a table, with its unit
  std::string key;   ///< in a report
  double value;
};

std::vector<Measure> measures_of(const Segmentation& result);

}  // namespace breast
