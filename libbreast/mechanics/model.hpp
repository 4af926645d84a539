// SPDX-License-Identifier: GPL-3.0-or-later
// The model with which a shape was solved: as texts for its file, read back, and compared.
#pragma once

#include <string>

#include "mechanics/options.hpp"
#include "mesh/model_text.hpp"

namespace breast {

/// The model of `options` as a file states it. The solver and the estimate of the error do not belong
/// to the model, nor does a surface of the wall other than that of the mesh.
ModelText model_text(const MechanicsOptions& options);

/// The model that a file states, equal to the one it was written from to the last digit. Throws
/// Error (input) beginning with `file` if any of its texts cannot be read.
MechanicsOptions stated_model(const ModelText& text, const std::string& file);

/// Every part of the model `used` that differs from `other`, with both values: "fat.a10 310 instead of
/// 8.153 Pa, --cut free instead of spring:0.019"; empty if the two are the same model. A tissue whose
/// stiffness differs by one factor is one part. The name of the material set is none.
std::string model_differences(const MechanicsOptions& used, const MechanicsOptions& other);

}  // namespace breast
