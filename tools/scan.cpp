// SPDX-License-Identifier: GPL-3.0-or-later
// scan: a scan as the programs read it, in one file.
#include "cli/tool.hpp"
#include "io/volume_file.hpp"

using namespace breast;

int main(int argc, char** argv) {
  std::filesystem::path scan, out;
  int series = 0;
  std::string side = "both";
  bool list = false;
  Tool tool("scan", "a scan in one file, as all tools read it");
  tool.describe(
      "Reads a scan with all checks of the readers and writes its volume: a DICOM folder becomes one file without names, "
      "dates or other texts of the patient. The values are those of the scan.");
  tool.input(scan, "MR",
             "scan: .nrrd, .nii, .nii.gz, .mha, a DICOM folder, or a DICOM file with all slices");
  tool.output(out, "OUT.nrrd", "the volume", {".nii", ".nii.gz", ".mha"});
  tool.describe(
      std::string(
          "A DICOM folder is searched with all folders below it, as it comes from an archive. "
          "If --series does not name one of its series, the best is taken: ") +
      series_rule + ".");
  tool.integer(series, "--series", "N",
               "series of a DICOM folder, by its number in --list (0: the best)", 0, 100000);
  tool.choice(side, "--side", {"left", "right", "both"},
              "the breast that must be shown, where series or sagittal slabs show one");
  tool.question(
      list, "--list",
      "print a table of the series of a DICOM folder: images, voxel size, contrast by the header, time "
      "point, sides, and which would be taken or why it cannot be");
  tool.example("scan series scan.nrrd", "a DICOM folder as one file");
  tool.example("scan export --list", "what the export of an archive contains");
  return tool.main(argc, argv, [&](Run& run) {
    ScanChoice choice(series);
    if (side != "both") choice.side = side_from_name(side);
    VolumeSource source;
    if (list) {
      run.print(list_series(scan, choice, source.remarks).text());
      for (const std::string& remark : source.remarks) run.remark(remark);
      return;
    }
    const Volume<float> volume = read_volume(scan, choice, &source);
    for (const std::string& remark : source.remarks) run.remark(remark);
    run.report().set("scan", source.description);
    write_volume(out, volume);
  });
}
