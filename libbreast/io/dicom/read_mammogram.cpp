// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdlib>

#include "core/error.hpp"
#include "io/dicom/mammogram_header.hpp"
#include "io/dicom/stored_values.hpp"
#include "io/mammogram_dicom.hpp"

namespace breast {

namespace {

std::vector<float> grey_values(const std::filesystem::path& file) {
  DicomObject object;
  read_dicom_object(file, object);
  check_grey(file, object.header);
  if (const std::string frames = text_of(object.header, "0028|0008"); std::atoi(frames.c_str()) > 1)
    throw input_error(file.string(), ": ", frames, " frames; one is expected");
  return guarded_values(file, object);
}

}  // namespace

MammogramScan read_mammogram_dicom(const std::filesystem::path& file) {
  MammogramScan scan;
  scan.header = read_mammogram_header(file);
  const std::string where = file.string();
  scan.grey = grey_values(file);
  const std::size_t pixels = std::size_t(scan.header.columns) * std::size_t(scan.header.rows);
  if (scan.grey.size() != pixels || pixels == 0) {
    throw input_error(where, ": ", scan.grey.size(), " pixel values for ", scan.header.columns,
                      " x ", scan.header.rows);
  }
  const auto [low, high] = std::minmax_element(scan.grey.begin(), scan.grey.end());
  const float first = *low, range = *high - *low;
  if (!(range > 0)) throw input_error(where, ": every pixel is ", first);
  for (float& value : scan.grey) {
    value = (value - first) / range;
    if (scan.header.bright_is_low) value = 1 - value;
  }
  return scan;
}

}  // namespace breast
