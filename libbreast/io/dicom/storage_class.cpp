// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dicom/storage_class.hpp"

#include <array>
#include <string_view>

namespace breast {

namespace {

constexpr std::string_view storage_root = "1.2.840.10008.5.1.4.1.1.";

struct Kind {
  std::string_view uid;  ///< after the root; one that ends with a dot stands for all below it
  const char* name;
  bool image;
};
constexpr std::array<Kind, 25> kinds{{{"4.2", "MR spectrum", false},
                                      {"4", "MR image", true},
                                      {"4.", "MR image", true},
                                      {"2", "CT image", true},
                                      {"2.", "CT image", true},
                                      {"1.2.", "mammogram", true},
                                      {"1.3.", "X-ray image", true},
                                      {"1.1.", "X-ray image", true},
                                      {"1", "X-ray image", true},
                                      {"13.1.", "breast tomosynthesis", true},
                                      {"3.", "ultrasound image", true},
                                      {"6.", "ultrasound image", true},
                                      {"7", "secondary capture", true},
                                      {"7.", "secondary capture", true},
                                      {"20", "nuclear medicine image", true},
                                      {"128", "PET image", true},
                                      {"11.", "presentation state", false},
                                      {"88.59", "key object selection", false},
                                      {"88.", "structured report", false},
                                      {"104.", "encapsulated document", false},
                                      {"9.", "waveform", false},
                                      {"66.4", "segmentation", true},
                                      {"66", "raw data", false},
                                      {"66.", "registration or surface", false},
                                      {"481.", "radiotherapy object", false}}};

const Kind* kind_of(const std::string& sop_class) {
  if (!sop_class.starts_with(storage_root)) return nullptr;
  const std::string_view below = std::string_view(sop_class).substr(storage_root.size());
  for (const Kind& kind : kinds) {
    if (kind.uid.back() == '.' ? below.starts_with(kind.uid) : below == kind.uid) return &kind;
  }
  return nullptr;
}

}  // namespace

std::string object_kind(const std::string& sop_class) {
  if (sop_class == "1.2.840.10008.1.3.10") return "directory of files";
  if (const Kind* kind = kind_of(sop_class)) return kind->name;
  return sop_class.empty() ? "object that states no class"
                           : "object of class " + sop_class.substr(0, 64);
}

bool is_image_class(const std::string& sop_class) {
  const Kind* kind = kind_of(sop_class);
  return kind != nullptr && kind->image;
}

}  // namespace breast
