// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <map>

#include "core/error.hpp"
#include "core/guarded_child.hpp"
#include "io/dicom/stored_values.hpp"
#include "io/series/choice.hpp"

namespace breast {

namespace {

namespace fs = std::filesystem;

/// The places of each file's frames in the stack, so that every file is decoded once.
using FramesOfFiles = std::map<fs::path, std::vector<std::size_t>>;

/// Values of the frames of one file, rescaled as each of them states.
std::vector<float> values_of(const fs::path& file, const std::vector<std::size_t>& places,
                             const DicomStack& stack) {
  DicomObject object;
  if (!read_dicom_object(file, object) || !object.pixels)
    throw input_error(file.string(), ": is no longer the image that was found");
  std::vector<int> frames;
  for (const std::size_t k : places) frames.push_back(stack.slices[k].frame);
  std::vector<float> values = stored_values(file, object, frames);
  const std::size_t pixels = std::size_t(stack.first().columns) * std::size_t(stack.first().rows);
  if (values.size() != pixels * places.size())
    throw input_error(file.string(), ": is no longer the image that was found");
  for (std::size_t n = 0; n < places.size(); ++n) {
    const DicomImage& slice = stack.slices[places[n]];
    if (slice.slope == 1 && slice.intercept == 0) continue;
    for (std::size_t i = n * pixels; i < (n + 1) * pixels; ++i)
      values[i] = float(slice.slope * double(values[i]) + slice.intercept);
  }
  return values;
}

std::vector<float> voxels_of(const DicomStack& stack) {
  FramesOfFiles files;
  for (std::size_t k = 0; k < stack.slices.size(); ++k) files[stack.slices[k].file].push_back(k);
  const std::size_t pixels = std::size_t(stack.first().columns) * std::size_t(stack.first().rows);
  std::vector<float> voxels(pixels * stack.slices.size());
  for (const auto& [file, places] : files) {
    const std::vector<float> values = values_of(file, places, stack);
    for (std::size_t n = 0; n < places.size(); ++n) {
      std::memcpy(voxels.data() + places[n] * pixels, values.data() + n * pixels,
                  pixels * sizeof(float));
    }
  }
  return voxels;
}

/// The grid from all positions, not from the first two slices alone.
Grid grid_of(const DicomStack& stack) {
  const DicomImage& first = stack.first();
  Grid grid;
  grid.size = {first.columns, first.rows, int(stack.slices.size())};
  grid.origin = first.position;
  const Vec3 row = first.row.normalized(), column = first.column.normalized();
  const Vec3 step =
      (stack.slices.back().position - first.position) / double(stack.slices.size() - 1);
  const double along = step.dot(row.cross(column));
  grid.spacing = Vec3(first.pixel[1], first.pixel[0], step.norm());
  grid.direction.col(0) = row;
  grid.direction.col(1) = column;
  grid.direction.col(2) = step.norm() < along * 1.0001 ? row.cross(column) : step.normalized();
  return grid;
}

}  // namespace

Volume<float> read_stack(const DicomStack& stack) {
  Volume<float> volume;
  volume.grid = grid_of(stack);
  const bool encapsulated = std::any_of(stack.slices.begin(), stack.slices.end(),
                                        [](const DicomImage& slice) { return slice.encapsulated; });
  if (!encapsulated) {
    volume.voxels = voxels_of(stack);
    return volume;
  }
  // GDCM can crash on damaged pixels.
  const std::string bytes = in_guarded_child(stack.first().file.parent_path().string(), [&] {
    const std::vector<float> voxels = voxels_of(stack);
    return std::string(reinterpret_cast<const char*>(voxels.data()), voxels.size() * sizeof(float));
  });
  volume.voxels.resize(volume.grid.voxels());
  if (bytes.size() != volume.voxels.size() * sizeof(float))
    throw failed_error(stack.first().file.string(), ": its decoded pixels are incomplete");
  std::memcpy(volume.voxels.data(), bytes.data(), bytes.size());
  return volume;
}

}  // namespace breast
