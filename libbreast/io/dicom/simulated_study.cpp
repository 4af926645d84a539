// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dicom/simulated_study.hpp"

#include "core/own_file.hpp"

namespace breast {

void add_study(DatasetBuilder& set, const SimulatedStudy& study) {
  set.text(0x00080020, "DA", "")
      .text(0x00080030, "TM", "")
      .text(0x00080050, "SH", "")
      .text(0x00080060, "CS", study.modality)
      .text(0x00080070, "LO", std::string(maker_mark) + " (simulated)")
      .text(0x00080090, "PN", "")
      .text(0x00100010, "PN", study.patient_name)
      .text(0x00100020, "LO", "SIMULATED")
      .text(0x00100030, "DA", "")
      .text(0x00100040, "CS", "F")
      .text(0x0020000d, "UI", uid_from(study.content + "/study"))
      .text(0x0020000e, "UI", uid_from(study.content + "/series"))
      .text(0x00200010, "SH", "1")
      .text(0x00200011, "IS", "1")
      .text(0x00200013, "IS", std::to_string(study.instance));
}

}  // namespace breast
