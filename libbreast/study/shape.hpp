// SPDX-License-Identifier: GPL-3.0-or-later
// Where landmarks are in a shape's file, and how far two shapes lie apart there.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace breast {

struct PlacedLandmark {
  std::string name;
  Vec3 imaged{0, 0, 0}, position{0, 0, 0};  ///< mm, LPS
};
using Shape = std::vector<PlacedLandmark>;
/// Reads the landmarks of a mesh file; throws Error (input) where it cannot be read.
using ShapeReader = std::function<Shape(const std::filesystem::path& file)>;

/// "tumour" is also found where it is an artificial one. Throws Error (input) naming the file when it has no such landmark.
const PlacedLandmark& find_landmark(const Shape& shape, const std::string& name,
                                    const std::filesystem::path& file);

// All in mm and rounded to the 4 decimals of the tables of probe, so that every table of a study says the same number.
/// From the landmark's imaged place to its place in this shape.
double moved(const PlacedLandmark& landmark);
/// Between a landmark's places in two shapes.
double apart(const PlacedLandmark& here, const PlacedLandmark& there);
/// The largest distance of a landmark, nipple or tumour, between two files.
double most_apart(const ShapeReader& read, const std::filesystem::path& file,
                  const std::filesystem::path& base);
/// Of one landmark.
double apart_at(const ShapeReader& read, const std::filesystem::path& file,
                const std::filesystem::path& base, const std::string& landmark);

}  // namespace breast
