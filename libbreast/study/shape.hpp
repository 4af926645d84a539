// SPDX-License-Identifier: GPL-3.0-or-later
// Positions of landmarks in the file of a shape, and distances between the landmarks of two shapes.
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
/// Reads the landmarks of a mesh file; throws Error (input) if it cannot be read.
using ShapeReader = std::function<Shape(const std::filesystem::path& file)>;

/// Finds a landmark; "tumour" also finds an artificial one. Throws Error (input) naming the file if
/// it has no such landmark.
const PlacedLandmark& find_landmark(const Shape& shape, const std::string& name,
                                    const std::filesystem::path& file);

// All distances are in mm and rounded to the 4 decimals of the tables of probe, so that every table
// of a study states the same number.
/// Distance from the landmark's imaged position to its position in this shape.
double moved(const PlacedLandmark& landmark);
/// Distance between a landmark's positions in two shapes.
double apart(const PlacedLandmark& here, const PlacedLandmark& there);
/// The larger of the distances of nipple and tumour between two files.
double most_apart(const ShapeReader& read, const std::filesystem::path& file,
                  const std::filesystem::path& base);
/// The distance of one landmark between two files.
double apart_at(const ShapeReader& read, const std::filesystem::path& file,
                const std::filesystem::path& base, const std::string& landmark);

}  // namespace breast
