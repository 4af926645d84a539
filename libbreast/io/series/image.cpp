// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/series/image.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/error.hpp"
#include "core/text/lists.hpp"
#include "core/text/trimmed.hpp"
#include "io/dicom/stored_values.hpp"

namespace breast {

namespace {

namespace fs = std::filesystem;

/// The elements of one image: of the frame, else of all frames, else of the file.
class Elements {
 public:
  Elements(const DicomObject& object, int frame)
      : top_(object.header),
        frame_(object.frames.empty() ? nullptr : &object.frames[std::size_t(frame)]) {}

  /// `group` is the functional group that holds the element in an enhanced object.
  std::string value(const char* group, const char* key) const {
    const std::string path = std::string(group) + "/" + key;
    if (frame_ != nullptr) {
      if (const auto own = frame_->find(path); own != frame_->end()) return own->second;
    }
    if (const auto shared = top_.find("5200|9229/" + path); shared != top_.end())
      return shared->second;
    return text_of(top_, key);
  }
  std::string value(const char* key) const { return text_of(top_, key); }

 private:
  const DicomHeader& top_;
  const DicomHeader* frame_;
};

/// "a\b\c" as numbers; empty when the count or a number is wrong.
std::vector<double> dicom_numbers(const std::string& text, std::size_t count) {
  std::vector<double> values;
  for (const std::string& piece : split(text, '\\')) {
    char* end = nullptr;
    const double value = std::strtod(piece.c_str(), &end);
    // What follows a number, such as a decimal comma, would change it.
    if (end == piece.c_str() || !trimmed(end).empty() || !std::isfinite(value)) return {};
    values.push_back(value);
  }
  if (values.size() != count) values.clear();
  return values;
}

void take_geometry(const Elements& elements, DicomImage& image) {
  const auto position = dicom_numbers(elements.value("0020|9113", "0020|0032"), 3);
  const auto axes = dicom_numbers(elements.value("0020|9116", "0020|0037"), 6);
  if (position.empty() || axes.empty()) {
    throw input_error(
        image.file.string(),
        ": no image position or orientation (six and three numbers), so it is no slice "
        "of a volume: export the original series, not pictures of it");
  }
  image.position = Vec3(position[0], position[1], position[2]);
  image.row = Vec3(axes[0], axes[1], axes[2]);
  image.column = Vec3(axes[3], axes[4], axes[5]);
  constexpr double bound = 1e-3;
  if (!(std::abs(image.row.normalized().dot(image.column.normalized())) <= bound &&
        std::abs(image.row.norm() - 1) <= bound && std::abs(image.column.norm() - 1) <= bound)) {
    throw input_error(image.file.string(),
                      ": image axes are not perpendicular directions of length 1 (bound 1e-3)");
  }
}

/// Voxel size in the plane; a missing one must not be taken for 1 mm.
void take_spacing(const Elements& elements, DicomImage& image) {
  const auto values = dicom_numbers(elements.value("0028|9110", "0028|0030"), 2);
  constexpr double least_mm = 0.01, most_mm = 50;
  for (const double value : values) {
    if (value >= least_mm && value <= most_mm) continue;
    throw input_error(image.file.string(), ": pixel spacing ", value, " mm: must be ", least_mm,
                      " to ", most_mm, " mm");
  }
  if (values.empty())
    throw input_error(image.file.string(), ": states no pixel spacing of two numbers");
  image.pixel = Vec2(values[0], values[1]);
}

void take_scale(const Elements& elements, DicomImage& image) {
  const std::string slope = elements.value("0028|9145", "0028|1053"),
                    intercept = elements.value("0028|9145", "0028|1052");
  if (!slope.empty()) {
    const auto value = dicom_numbers(slope, 1);
    if (value.empty() || !(value[0] > 0))
      throw input_error(image.file.string(), ": rescale slope ", slope, ": must be above 0");
    image.slope = value[0];
  }
  if (!intercept.empty()) {
    const auto value = dicom_numbers(intercept, 1);
    if (value.empty())
      throw input_error(image.file.string(), ": rescale intercept ", intercept, ": no number");
    image.intercept = value[0];
  }
}

void check_kind(const Elements& elements, const DicomObject& object, DicomImage& image) {
  const fs::path& file = image.file;
  const std::string modality = elements.value("0008|0060"), kind = elements.value("0028|0004");
  image.foreign = !modality.empty() && modality != "MR";
  if (image.foreign)
    throw input_error(file.string(), ": modality ", modality, ": slices of MR are needed");
  check_grey(file, object.header);
  if (kind != "MONOCHROME2") {
    throw input_error(file.string(), ": photometric interpretation '", kind,
                      "': MONOCHROME2 (grey scale, high values bright) is needed");
  }
}

/// Magnitude, phase, real or imaginary part: as stated, or by a private number of GE, whose image types do
/// not tell them apart.
std::string component_of(const Elements& elements) {
  const std::string stated = elements.value("0018|9226", "0008|9208");
  if (!stated.empty() || elements.value("0043|0010") != "GEMS_PARM_01") return stated;
  const std::string number = elements.value("0043|102f");
  if (number == "1") return "PHASE";
  if (number == "2") return "REAL";
  return number == "3" ? "IMAGINARY" : number == "0" ? "MAGNITUDE" : "";
}

void take_marks(const Elements& elements, DicomImage& image) {
  const auto set = [&](Mark mark, const std::string& value) {
    image.marks[std::size_t(mark)] = trimmed(value);
  };
  const std::string index = elements.value("0020|9111", "0020|9128");
  const std::string acquisition = elements.value("0020|9111", "0020|9156");
  set(Mark::time, index.empty() ? elements.value("0020|0100") : index);
  set(Mark::acquisition, acquisition.empty() ? elements.value("0020|0012") : acquisition);
  set(Mark::trigger, elements.value("0018|1060"));
  set(Mark::acquired_at, elements.value("0008|0032"));
  set(Mark::stored_at, elements.value("0008|0033"));
  const std::string type = elements.value("0018|9226", "0008|9007");
  set(Mark::kind, type.empty() ? elements.value("0008|0008") : type);
  const std::string echo = elements.value("0018|9114", "0018|9082");
  set(Mark::echo, echo.empty() ? elements.value("0018|0081") : echo);
  set(Mark::weighting, elements.value("0018|9117", "0018|9087"));
  set(Mark::component, component_of(elements));
  image.localiser = image.mark(Mark::kind).find("LOCALIZER") != std::string::npos ||
                    elements.value("0008|0008").find("LOCALIZER") != std::string::npos;
  image.derived = image.mark(Mark::kind).find("\\SECONDARY") != std::string::npos;
  image.contrast = contrast_of([&](const char* key) {
    const std::string name(key);
    if (name == "0008|0008") return image.mark(Mark::kind);
    if (name == "0018|0081") return image.mark(Mark::echo);
    if (name == "0008|9208") return image.mark(Mark::component);
    if (name == "0018|0080") return elements.value("0018|9112", key);
    if (name == "0018|9025") return elements.value("0018|9115", key);
    return elements.value(key);
  });
}

DicomImage image_of(const fs::path& file, const DicomObject& object, int frame) {
  const Elements elements(object, frame);
  DicomImage image;
  image.file = file;
  image.frame = frame;
  image.encapsulated = object.pixels->encapsulated;
  image.study_uid = elements.value("0020|000d");
  image.series_uid = elements.value("0020|000e");
  image.frame_of_reference_uid = elements.value("0020|0052");
  image.sop_class = elements.value("0008|0016");
  image.instance_uid = elements.value("0008|0018");
  image.series_number = std::atoi(elements.value("0020|0011").c_str());
  image.instance_number = std::atoi(elements.value("0020|0013").c_str());
  image.columns = std::atoi(elements.value("0028|0011").c_str());
  image.rows = std::atoi(elements.value("0028|0010").c_str());
  image.patient_id = elements.value("0010|0020");
  image.patient_name = elements.value("0010|0010");
  image.patient_position = elements.value("0018|5100");
  image.laterality = elements.value("0020|9071", "0020|9072");
  if (image.laterality.empty()) image.laterality = elements.value("0020|0062");
  if (image.laterality.empty()) image.laterality = elements.value("0020|0060");
  take_marks(elements, image);
  try {
    check_kind(elements, object, image);
    take_geometry(elements, image);
    take_spacing(elements, image);
    take_scale(elements, image);
  } catch (const Error& error) {
    image.fault = error.what();
    // A screen capture that was stored with a series is not one of its slices.
    const std::string secondary_capture = "1.2.840.10008.5.1.4.1.1.7";
    const bool is_picture = image.sop_class == secondary_capture ||
                            image.sop_class.starts_with(secondary_capture + ".");
    if (is_picture && elements.value("0020|0032").empty()) image.foreign = true;
  }
  return image;
}

}  // namespace

DicomImage placed_frame(const fs::path& file, const DicomObject& object, int frame) {
  const Elements elements(object, frame);
  DicomImage image;
  image.file = file;
  image.frame = frame;
  image.columns = std::atoi(elements.value("0028|0011").c_str());
  image.rows = std::atoi(elements.value("0028|0010").c_str());
  take_geometry(elements, image);
  take_spacing(elements, image);
  return image;
}

std::vector<DicomImage> images_of(const fs::path& file, const DicomObject& object) {
  const int count = std::max(1, std::atoi(text_of(object.header, "0028|0008").c_str()));
  std::vector<DicomImage> images;
  if (!object.frames.empty() && object.frames.size() != std::size_t(count)) {
    images.push_back(image_of(file, object, 0));
    images.back().fault =
        message(file.string(), ": describes ", object.frames.size(), " of its ", count, " frames");
    return images;
  }
  // Without a description of each, frames have no place of their own.
  const int described = object.frames.empty() ? 1 : count;
  for (int frame = 0; frame < described; ++frame) images.push_back(image_of(file, object, frame));
  if (described < count) {
    images.back().fault =
        message(file.string(), ": ", count, " frames without positions of their own");
  }
  return images;
}

}  // namespace breast
