// SPDX-License-Identifier: GPL-3.0-or-later
// One small run of every tool, with every kind of file it writes, for fault injection.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "fixtures/chain_files.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/shapes.hpp"
#include "fixtures/synthetic_scan.hpp"
#include "fixtures/words.hpp"
#include "io/markups_file.hpp"
#include "io/segmentation_file.hpp"
#include "io/volume_file.hpp"

namespace breast::faults {

struct Case {
  const char* name;
  const char*
      line;  ///< the tool and its arguments; outputs are called out.*, or lie in a folder out
  int stride =
      1;  ///< the short test lets only every so many output calls fail; 0: it leaves the case out
  int branches_at =
      0;  ///< the output call before which most of its time passes (branches.hpp); 0: none

  /// Whether a test leaves it out because it takes long: only the target `faults` asks for all.
  bool left_out() const {
    return stride == 0 && std::getenv("BREAST_FAULT_ALLOCATIONS") == nullptr;
  }
};

inline const std::vector<Case>& cases() {
  static const std::vector<Case> list = {
      {"segment",
       "segment scan.nrrd out.vtkhdf --side left --points out.vtp --overlay out.png "
       "--measures out.tsv",
       18},
      {"segment_as_nifti", "segment scan.nrrd out.nii.gz --side right", 0},
      {"segment_dicom", "segment series out.nrrd --side right", 16},
      {"fit_hermite", "fit-hermite scan_labels.vtkhdf out.vtkhdf --elements 3x3", 30},
      {"hexmesh",
       "hexmesh geometry.vtkhdf labels.vtkhdf out.vtkhdf --elements 4 --accept-mismatch --surface out.vtp",
       4},
      {"backward", "backward cap.vtkhdf out.vtkhdf --materials seed2008", 3},
      {"forward", "forward cap_reference.vtkhdf out.vtkhdf", 3},
      {"backward_mpi", "backward-mpi cap.vtkhdf out.vtkhdf --materials seed2008", 8},
      {"forward_mpi", "forward-mpi cap_reference.vtkhdf out.vtkhdf", 8},
      {"sensitivity",
       "sensitivity cap_reference.vtkhdf cap_supine.vtkhdf out.vtkhdf --table out.tsv", 3},
      {"difference", "difference supine.vtkhdf supine.vtkhdf supine.vtkhdf out.vtkhdf", 4},
      {"compress",
       "compress pressed.vtkhdf out.vtkhdf --view CC --reduction 5 --materials seed2008", 3},
      {"project",
       "project-mammogram cc.vtkhdf out.vti --labels labels.vtkhdf --png out.png --dicom "
       "out.dcm --pixel 4",
       5},
      {"cc2mlo", "cc2mlo cc.vtkhdf mlo.vtkhdf out.vtp --landmark tumour --table out.tsv", 4},
      {"cc2mlo_images",
       "cc2mlo cc.vtkhdf mlo.vtkhdf out.vtp --point 20,37 --cc-image cc.dcm --mlo-image "
       "mlo.dcm --picture out.png --curve-table out.tsv",
       8},
      {"match_lookup", "match-lookup cc.vtkhdf mlo.vtkhdf out.h5 --pitch 20 --both-ways", 9},
      {"export_inp", "export-deck cap_reference.vtkhdf out.inp --without-skin"},
      {"export_feb", "export-deck cap_reference.vtkhdf out.feb --without-skin"},
      {"export_slicer", "export-slicer . out --spacing 12", 120},
      {"tetrahedra", "tetrahedra mesh.vtkhdf out.vtu", 4},
      {"probe", "probe cc.vtkhdf supine.vtkhdf --base mesh.vtkhdf", 3},
      {"evaluate", "evaluate labels.vtkhdf labels.vtkhdf", 4},
      {"evaluate_nrrd", "evaluate labels.vtkhdf labels.nrrd", 0},
      {"laws", "laws seed2008"},
      {"identify",
       "identify pressed.vtkhdf out.tsv --nipple 0,25,0 --materials seed2008 --parameters stiffness --second "
       "out.vtkhdf --table out.marks.tsv",
       6},
      {"population", "population supine.vtkhdf --table out.tsv --summary out.mean.tsv"},
      {"truth_table", "truth-table landmarks.tsv out.tsv cc.vtkhdf fine_cc.vtkhdf"},
      {"phantom_mesh", "phantom-mesh out.vtkhdf --preset small --level 0.5 --coarse 8", 0, 1},
      {"phantom", "phantom out.nrrd --preset small --coarse 8", 0, 1},
      // Its first call tries whether the folder can be made at all.
      {"phantom_folders",
       "phantom out.nrrd --preset small --coarse 8 --truth out --dicom out-series", 0, 2},
      {"calibrate_softness",
       "calibrate-softness pressed.vtkhdf --pressed pressed.vtkhdf --women women.tsv --set out.tsv "
       "--expected 20,50,100 --wall slide:0.05 --cut spring:0.05 --expected-ln-sd 0.2 --reduction 10",
       0},
  };
  return list;
}

/// Writes what the cases read.
inline void write_inputs(const std::filesystem::path& folder) {
  fixtures::write_chain(folder, 4);
  write_mesh(folder / "fine_cc.vtkhdf",
             fixtures::squashed(fixtures::landmarked_breast(5), View::cc, 0.6));
  const LabelVolume labels = fixtures::analytic_labels();
  Volume<std::uint8_t> codes(labels.grid);
  codes.voxels = labels.tissue;
  write_volume(folder / "labels.nrrd", codes);
  HexMesh cap = fixtures::cap({.elements = 3});
  cap.reference.clear();
  write_mesh(folder / "cap.vtkhdf", cap);
  HexMesh pressed = analytic_breast_mesh(4);
  pressed.reference = pressed.points;
  pressed.history.push_back({"backward", "0", "analytic", {}});
  write_mesh(folder / "pressed.vtkhdf", pressed);
  const Volume<float> scan = testing::SyntheticScan::coarse().image();
  write_volume(folder / "scan.nrrd", scan);
  Volume<std::int16_t> rounded(scan.grid);
  std::copy(scan.voxels.begin(), scan.voxels.end(), rounded.voxels.begin());
  write_dicom_series(folder / "series", rounded, "T1");
  write_text(
      folder / "landmarks.tsv",
      "landmark\tside\tstress_free_x_mm\tstress_free_y_mm\tstress_free_z_mm\tprone_x_mm\tprone_y_mm\t"
      "prone_z_mm\tsupine_x_mm\tsupine_y_mm\tsupine_z_mm\nnipple\tleft\t0\t0\t0\t0\t0\t0\t0\t0\t0\n"
      "tumour\tleft\t14\t30\t12\t14\t30\t12\t14\t30\t12\n\r\n");
  write_text(
      folder / "women.tsv",
      "quantity\tmean\tsd\tunmodelled_sd\nnipple_lateral_mm\t6\t3\t0\nnipple_posterior_mm\t5\t3\t0\n"
      "ribs_change_mm\t-1\t1\t0\n");
  for (const char* line : {
           "backward cap.vtkhdf cap_reference.vtkhdf --materials seed2008",
           "forward cap_reference.vtkhdf cap_supine.vtkhdf",
           "project-mammogram cc.vtkhdf cc.vti --pixel 2 --dicom cc.dcm",
           "project-mammogram mlo.vtkhdf mlo.vti --pixel 2 --dicom mlo.dcm",
           "cc2mlo cc.vtkhdf mlo.vtkhdf curve.vtp --landmark tumour",
           "segment scan.nrrd scan_labels.vtkhdf --side left --points skin.vtp",
       }) {
    const ToolResult made = run_line(std::string(line) + " --threads 1 --quiet", folder);
    if (made.exit_code != 0) throw failed_error(line, ": ", made.err);
  }
}

/// Small files of other formats, beside those of write_inputs, for tests/fuzz/whole-tools.py.
inline void write_more_inputs(const std::filesystem::path& folder) {
  Grid grid;
  grid.size = {6, 5, 4};
  grid.spacing = Vec3(30, 30, 40);
  grid.origin = Vec3(-80, -10, -70);
  Volume<std::uint8_t> tiny(grid);
  for (std::size_t v = 0; v < tiny.voxels.size(); ++v) tiny.voxels[v] = std::uint8_t(v % 6);
  for (const char* name : {"tiny.nrrd", "tiny.nii", "tiny.nii.gz", "tiny.mha"})
    write_volume(folder / name, tiny);
  std::string raw = read_text(folder / "tiny.nrrd");
  raw.erase(raw.find("\n\n") + 2);
  raw.replace(raw.find("encoding: gzip"), std::string("encoding: gzip").size(), "encoding: raw");
  write_text(folder / "tiny_raw.nrrd", raw + std::string(tiny.voxels.begin(), tiny.voxels.end()));
  LabelVolume labels;
  labels.grid = grid;
  labels.tissue = tiny.voxels;
  write_labels(folder / "tiny_labels.vtkhdf", labels);
  write_segmentation(folder / "tiny.seg.nrrd", labels);
  write_markups(folder / "points.mrk.json",
                {"points", false, {1, 0, 0}, {{"tumour", {14, 30, 12}}, {"nipple", {0, 0, 0}}}});
  Volume<std::int16_t> slices(grid);
  std::copy(tiny.voxels.begin(), tiny.voxels.end(), slices.voxels.begin());
  write_dicom_series(folder / "tiny_series", slices, "T1");
  write_text(folder / "patient.case",
             "# a patient\nMR = scan.nrrd\nSIDE = right\nREDUCTION = 40\n"
             "HEXMESH_OPTIONS = --elements 8 --skin 1.5\nLEAVE_OUT = no-skin\n");
  const HexMesh deck = read_mesh(folder / "cap_reference.vtkhdf");
  std::string frd =
      "    1C\n    1PSTEP                         1           1           1\n  100CL  101 1.000000000\n -4  DISP        4    1\n";
  std::string dat = "\n displacements (vx,vy,vz) for set NALL and time  0.1000000E+01\n\n";
  std::string log = "*Step = 1\n*Time = 1\n*Data = u\n";
  for (int n = 1; n <= deck.nodes(); ++n) {
    char line[128];
    std::snprintf(line, sizeof line, " -1%10d%12.5E%12.5E%12.5E\n", n, 0.001 * n, 0.0, -0.5);
    frd += line;
    std::snprintf(line, sizeof line, "%10d  %13.6E  %13.6E  %13.6E\n", n, 0.001 * n, 0.0, -0.5);
    dat += line;
    std::snprintf(line, sizeof line, "%d,%g,%g,%g\n", n, 0.001 * n, 0.0, -0.5);
    log += line;
  }
  write_text(folder / "result.frd", frd + " -3\n");
  write_text(folder / "result.dat", dat);
  write_text(folder / "result.log", log);
}

}  // namespace breast::faults
