// SPDX-License-Identifier: GPL-3.0-or-later
// The fictitious patient and study in every DICOM file that libbreast writes.
#pragma once

#include <string>

#include "io/dicom/dataset.hpp"

namespace breast {

struct SimulatedStudy {
  std::string modality;      ///< "MR", "MG"
  std::string patient_name;  ///< as DICOM's PN, marked as simulated
  /// Content from which study and series are derived: the same content gives the same UIDs.
  std::string content;
  int instance = 1;  ///< number of the image in its series
};
/// Adds modality, maker, patient, study and series; dates, times and identifying numbers stay empty.
void add_study(DatasetBuilder& set, const SimulatedStudy& study);

}  // namespace breast
