// SPDX-License-Identifier: GPL-3.0-or-later
// In place of what both programs link but no target fuzzes, because it needs a library that is not compiled with sanitizers.
#include "core/error.hpp"
#include "image/code_presets.hpp"
#include "io/series/segmentation.hpp"
#include "material/embedded.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

// The tables compiled into the programs, which are no input.
const std::vector<EmbeddedTable>& embedded_materials() {
  static const std::vector<EmbeddedTable> none;
  return none;
}
const std::vector<EmbeddedTable>& embedded_codes() {
  return embedded_materials();
}

// io/series/segmentation.cpp, which reads pixels with GDCM.
bool is_dicom_segmentation(const std::filesystem::path&) {
  return false;
}
SegmentedVolume read_dicom_segmentation(const std::filesystem::path&) {
  throw input_error("no DICOM here");
}
void write_dicom_segmentation(const std::filesystem::path&, const LabelVolume&,
                              const DicomReference&) {}

// export/deck/scene.cpp, which needs the mechanics: only applying a result asks for it.
std::vector<int> deck_nodes(const HexMesh&) {
  return {};
}

// core/parallel.cpp, which needs OpenMP.
int threads() {
  return 1;
}

}  // namespace breast
