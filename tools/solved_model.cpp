// SPDX-License-Identifier: GPL-3.0-or-later
#include "solved_model.hpp"

#include "core/error.hpp"
#include "mechanics/model.hpp"

namespace breast {

namespace {

void warn(const std::string& differences, const std::filesystem::path& file, Run& run) {
  if (differences.empty()) return;
  run.warn(message("model: ", differences, "; ", file.filename().string(),
                   " was solved with the latter"));
}

}  // namespace

void warn_of_differences(const MechanicsOptions& used, const std::filesystem::path& file,
                         const HexMesh& mesh, Run& run) {
  if (mesh.model)
    warn(model_differences(used, stated_model(*mesh.model, file.string())), file, run);
}

MechanicsOptions model_for(const MechanicsChoices& choices, const std::filesystem::path& file,
                           const HexMesh& mesh, Run& run) {
  if (mesh.model) {
    const MechanicsOptions stated = stated_model(*mesh.model, file.string());
    const MechanicsOptions used = mechanics_options(choices, stated);
    warn(model_differences(used, stated), file, run);
    return used;
  }
  MechanicsChoices given = choices;
  if (given.materials.empty()) given.materials = choices.default_set;
  if (given.materials.empty()) {
    throw input_error(file.string(),
                      ": does not state the model with which it was solved (group /breast/model); "
                      "give --materials NAME|FILE, and --wall, --cut and --element if they are not "
                      "those of the set");
  }
  return mechanics_options(given);
}

}  // namespace breast
