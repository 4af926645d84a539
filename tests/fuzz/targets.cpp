// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer targets for our own checks of every format: anything but an Error (input) is a crash.
// One program, which is the target that the environment variable FUZZ_TARGET names. Meshes, labels and geometries are fuzzed behind
// HDF5, which reads in a child process: their inputs are packed documents (io/hdf5/packed.hpp).
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "core/report.hpp"
#include "core/table.hpp"
#include "export/deck/results.hpp"
#include "io/derivative_file.hpp"
#include "io/dicom/mammogram_header.hpp"
#include "io/geometry_file.hpp"
#include "io/hdf5/packed.hpp"
#include "io/label_file.hpp"
#include "io/markups_file.hpp"
#include "io/segmentation_file.hpp"
#include "io/volume/header.hpp"
#include "io/volume_file.hpp"
#ifdef FUZZ_VTK
#include "io/vtk/vtk_messages.hpp"
#include "io/vtk/xml_check.hpp"
#endif
#include "material/material_set.hpp"

namespace breast {

namespace {

std::string input;

// The input as a file of that ending, in memory.
std::filesystem::path as_file(const std::string& ending) {
  static const std::string folder = [] {
    std::string name = "/dev/shm/breast-fuzz-" + std::to_string(getpid());
    mkdir(name.c_str(), 0700);
    std::atexit(
        [] { std::filesystem::remove_all("/dev/shm/breast-fuzz-" + std::to_string(getpid())); });
    return name;
  }();
  const std::filesystem::path file = folder + "/input" + ending;
  std::ofstream(file, std::ios::binary).write(input.data(), std::streamsize(input.size()));
  return file;
}

void nrrd() {
  nrrd_grid(as_file(".nrrd"));
}
void nifti() {
  read_nifti(as_file(".nii"));
}
void meta() {
  meta_grid(as_file(".mha"));
}
void segmentation() {
  labels_of(read_segmentation(as_file(".seg.nrrd")), {}, std::nullopt, "input");
}
void markups() {
  point_named(read_markups(as_file(".mrk.json")), "tumour", "input");
}
void dicom() {
  read_mammogram_header(as_file(".dcm"));
}
void table() {
  const Table read = parse_table(input, "input");
  for (std::size_t row = 0; row < read.rows.size(); ++row) read.number(row, read.columns.front());
}
void materials() {
  load_materials(as_file(".tsv").string());
}
void report() {
  const Report read = Report::parse(input, "input");
  Report::parse(read.json(), "again");
}
void mesh() {
  read_derivatives("input", read_mesh("input"));
}
void labels() {
  read_labels("input");
}
void geometry() {
  read_geometry("input");
}
#ifdef FUZZ_VTK
void vtk() {
  const VtkMessages messages;
  check_xml(as_file(".vtp"), "PolyData");
}
#endif
void results() {
  constexpr int nodes = 8;
  const char* const endings[] = {".frd", ".dat", ".log"};
  const std::size_t which = input.empty() ? 0 : std::uint8_t(input[0]) % 3;
  if (!input.empty()) input.erase(0, 1);
  read_deck_result(as_file(endings[which]), nodes);
}

struct Target {
  void (*check)();
  bool document = false;  ///< its input is a packed document
};
const std::map<std::string, Target> targets{
    {"nrrd", {nrrd}},
    {"nifti", {nifti}},
    {"meta", {meta}},
    {"segmentation", {segmentation}},
    {"markups", {markups}},
    {"dicom", {dicom}},
    {"table", {table}},
    {"materials", {materials}},
    {"report", {report}},
    {"mesh", {mesh, true}},
    {"labels", {labels, true}},
    {"geometry", {geometry, true}},
    {"results", {results}},
#ifdef FUZZ_VTK
    {"vtk", {vtk}},
#endif
};
Target chosen{};

}  // namespace

// For document_mutator.cpp.
bool is_document_target() {
  return chosen.document;
}

// In place of io/hdf5/load.cpp: the document HDF5 would have handed over.
Document load_document(const std::filesystem::path&, const std::string&, const std::string&) {
  try {
    return unpacked(input);
  } catch (const Error&) {
    throw input_error("input is no document");
  }
}
void save_document(const std::filesystem::path&, const Document&) {}
// In place of io/volume/read_volume.cpp, where ITK reads the voxels behind the same check: one of each value that a header names.
Volume<float> read_volume(const std::filesystem::path& file, const ScanChoice&, VolumeSource*) {
  nrrd_grid(file);
  Grid grid;
  grid.size = {4, 3, 2};
  Volume<float> out(grid);
  for (std::size_t v = 0; v < out.voxels.size(); ++v) out.voxels[v] = float(v % 7);
  return out;
}
}  // namespace breast

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  const char* const name = std::getenv("FUZZ_TARGET");
  const auto found = breast::targets.find(name == nullptr ? "" : name);
  if (found == breast::targets.end()) {
    std::fprintf(stderr, "FUZZ_TARGET: there is no such target\n");
    std::exit(2);
  }
  breast::chosen = found->second;
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  breast::input.assign(reinterpret_cast<const char*>(data), size);
  try {
    breast::chosen.check();
  } catch (const breast::Error& error) {
    // A run of another program may be unfinished; nothing here may fail otherwise.
    if (error.kind() == breast::ErrorKind::failed) std::abort();
  }
  return 0;
}
