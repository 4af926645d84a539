// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/shape.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

namespace {
double as_probed(double mm) {
  return parse_number(format_fixed(mm, 4), "distance");
}
}  // namespace

const PlacedLandmark& find_landmark(const Shape& shape, const std::string& name,
                                    const std::filesystem::path& file) {
  for (const std::string& wanted : {name, "artificial_" + name})
    for (const PlacedLandmark& landmark : shape)
      if (landmark.name == wanted) return landmark;
  throw input_error(file.string(), ": has no landmark '", name, "'");
}

double moved(const PlacedLandmark& landmark) {
  return as_probed((landmark.position - landmark.imaged).norm());
}

double apart(const PlacedLandmark& here, const PlacedLandmark& there) {
  return as_probed((here.position - there.position).norm());
}

double apart_at(const ShapeReader& read, const std::filesystem::path& file,
                const std::filesystem::path& base, const std::string& landmark) {
  return apart(find_landmark(read(file), landmark, file),
               find_landmark(read(base), landmark, base));
}

double most_apart(const ShapeReader& read, const std::filesystem::path& file,
                  const std::filesystem::path& base) {
  const Shape here = read(file), there = read(base);
  double most = 0;
  for (const PlacedLandmark& landmark : here)
    most = std::max(most, apart(landmark, find_landmark(there, landmark.name, base)));
  return most;
}

}  // namespace breast
