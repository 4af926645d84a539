// SPDX-License-Identifier: GPL-3.0-or-later
// The mechanical model with which a shape was solved, as a mesh file states it.
#pragma once

#include <string>

namespace breast {

/// Every part of a model in the words of a command line (file group /breast/model), from which the
/// same model can be made again to the last digit (mechanics/model.hpp). No text is empty.
struct ModelText {
  std::string name;       ///< of the material set
  std::string materials;  ///< the set: a table of laws, densities, skin, supports, uncertainty
  std::string element, invariants, bulk_ratio, wall, cut;

  bool operator==(const ModelText&) const = default;
};

/// A part of the model, with its name in the file.
struct ModelPart {
  const char* name;
  std::string ModelText::*text;
};
inline constexpr ModelPart model_parts[] = {{"name", &ModelText::name},
                                            {"materials", &ModelText::materials},
                                            {"element", &ModelText::element},
                                            {"invariants", &ModelText::invariants},
                                            {"bulk_ratio", &ModelText::bulk_ratio},
                                            {"wall", &ModelText::wall},
                                            {"cut", &ModelText::cut}};

}  // namespace breast
