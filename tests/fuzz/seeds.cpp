// SPDX-License-Identifier: GPL-3.0-or-later
// seeds FOLDER: small valid inputs for every fuzz target, made by our own writers.
#include <filesystem>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "core/table.hpp"
#include "fixtures/samples.hpp"
#include "io/derivative_file.hpp"
#include "io/geometry_file.hpp"
#include "io/hdf5/packed.hpp"
#include "io/label_file.hpp"
#include "io/markups_file.hpp"
#include "io/segmentation_file.hpp"
#include "io/volume_file.hpp"

namespace breast {

// In place of io/hdf5/save.cpp and load.cpp: documents as the targets take them.
void save_document(const std::filesystem::path& file, const Document& document) {
  write_bytes(file, packed(document));
}
Document load_document(const std::filesystem::path& file, const std::string&, const std::string&) {
  return unpacked(read_text(file));
}
Volume<float> read_volume(const std::filesystem::path&, const ScanChoice&, VolumeSource*) {
  return {};
}

namespace {

Volume<std::int16_t> volume() {
  Grid grid;
  grid.size = {4, 3, 2};
  Volume<std::int16_t> out(grid);
  for (std::size_t v = 0; v < out.voxels.size(); ++v) out.voxels[v] = std::int16_t(v);
  return out;
}

// A small one: most of what a larger one holds is only hashed.
LabelVolume labels() {
  LabelVolume out = samples::labels();
  out.grid.size = {3, 2, 2};
  const std::size_t voxels = out.grid.voxels();
  out.tissue.resize(voxels);
  out.fibroglandular_fraction.resize(voxels);
  out.chest_wall_confidence.resize(voxels);
  return out;
}

constexpr const char* poly_data = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">
  <PolyData>
    <FieldData>
      <Array type="String" Name="schema" NumberOfTuples="1" format="ascii">
        99 117 114 118 101 47 49 0
      </Array>
      <DataArray type="Float64" Name="pitch" NumberOfComponents="3" NumberOfTuples="1" format="ascii">1 2 3</DataArray>
    </FieldData>
    <Piece NumberOfPoints="2" NumberOfVerts="0" NumberOfLines="1" NumberOfStrips="0" NumberOfPolys="0">
      <PointData>
        <DataArray type="Float32" Name="band" format="binary">AQAAAACAAAAIAAAACwAAAA==eJxjYEAAAAAIAAE=</DataArray>
      </PointData>
      <Points><DataArray type="Float64" NumberOfComponents="3" format="appended" offset="0"/></Points>
      <Lines>
        <DataArray type="Int64" Name="connectivity" format="ascii">0 1</DataArray>
        <DataArray type="Int64" Name="offsets" format="ascii">2</DataArray>
      </Lines>
    </Piece>
  </PolyData>
  <AppendedData encoding="raw">_00000000</AppendedData>
</VTKFile>
)";

void write_seeds(const std::filesystem::path& folder) {
  for (const char* name : {"nrrd", "nifti", "meta", "dicom", "table", "materials", "report", "mesh",
                           "labels", "geometry", "results", "vtk", "segmentation", "markups"}) {
    std::filesystem::create_directories(folder / name);
  }
  write_volume(folder / "nrrd/seed.nrrd", volume());
  write_volume(folder / "nifti/seed.nii", volume());
  write_volume(folder / "nifti/seed.nii.gz", volume());
  write_volume(folder / "meta/seed.mha", volume());
  write_dicom_series(folder / "dicom/series", volume(), "T1");
  std::filesystem::rename(folder / "dicom/series/slice_0001.dcm", folder / "dicom/seed.dcm");
  std::filesystem::remove_all(folder / "dicom/series");
  write_table(folder / "table/seed.tsv", {{"name", "x_mm"}, {{"a", "1.5"}, {"b", "2"}}});
  Report report;
  report.set("tool", "seeds");
  report.set("landmarks/nipple/displacement_mm", 1.5);
  write_text(folder / "report/seed.json", report.json());
  Derivatives derivatives;
  const HexMesh mesh = samples::full_mesh();
  derivatives.position["fat"].assign(mesh.points.size(), Vec3(1, 2, 3));
  write_mesh(folder / "mesh/seed", mesh, derivatives);
  write_labels(folder / "labels/seed", labels());
  write_geometry(folder / "geometry/seed", samples::geometry());
  write_segmentation(folder / "segmentation/seed.seg.nrrd", labels());
  write_markups(folder / "markups/seed.mrk.json",
                {"points", false, {1, 0, 0}, {{"tumour", {1, -2.5, 3}}, {"nipple", {0, 1, 0}}}});
  write_text(folder / "vtk/poly", poly_data);
  write_text(folder / "results/log", "2*Step = 1\n*Time = 1\n*Data = u\n1,0,0,0\n2,0,0,1\n");
  write_text(folder / "results/frd",
             "0    1C\n -4  DISP        4    1\n -1         1 0.0 0.0 0.0\n -3\n");
}

}  // namespace
}  // namespace breast

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  breast::write_seeds(argv[1]);
  return 0;
}
