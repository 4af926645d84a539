// SPDX-License-Identifier: GPL-3.0-or-later
// scan: a scan as the programs read it, in one file.
#include "cli/tool.hpp"
#include "io/volume_file.hpp"

using namespace breast;

int main(int argc, char** argv) {
  std::filesystem::path scan, out;
  int series = 0;
  Tool tool("scan", "a scan in one file, as all tools read it");
  tool.describe(
      "Reads a scan with all checks of the readers and writes its volume: a DICOM folder becomes one file without names, "
      "dates or other texts of the patient. The values are those of the scan.");
  tool.input(scan, "MR", "scan (.nrrd, .nii, .nii.gz, .mha or a DICOM folder)");
  tool.output(out, "OUT.nrrd", "the volume", {".nii", ".nii.gz", ".mha"});
  tool.integer(series, "--series", "N", "series of a DICOM folder (0: the only one)", 0, 100000);
  tool.example("scan series scan.nrrd", "a DICOM folder as one file");
  return tool.main(argc, argv, [&](Run& run) {
    VolumeSource source;
    const Volume<float> volume = read_volume(scan, series, &source);
    run.report().set("scan", source.description);
    write_volume(out, volume);
  });
}
