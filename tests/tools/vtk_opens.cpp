// SPDX-License-Identifier: GPL-3.0-or-later
// VTK 9.1's own reader opens every kind of VTKHDF file we write, with the arrays where a user of
// ParaView looks for them.
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkHDFReader.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "fixtures/run_tool.hpp"
#include "fixtures/samples.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/geometry_file.hpp"
#include "io/label_file.hpp"
#include "io/mesh_file.hpp"
#include "io/tet_mesh_file.hpp"

namespace breast {
namespace {

vtkDataSet* open(vtkHDFReader* reader, const std::filesystem::path& file) {
  EXPECT_TRUE(reader->CanReadFile(file.c_str()));
  reader->SetFileName(file.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), 0u);
  return reader->GetOutputAsDataSet();
}

void expect_vectors(vtkDataArray* array, const std::vector<Vec3>& expected, const char* name) {
  ASSERT_NE(array, nullptr) << name;
  ASSERT_EQ(array->GetNumberOfTuples(), vtkIdType(expected.size())) << name;
  ASSERT_EQ(array->GetNumberOfComponents(), 3) << name;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(array->GetComponent(vtkIdType(i), c), expected[i][c]) << name;
  }
}

TEST(VtkOpens, Meshes) {
  const ScratchFolder folder;
  for (const int order : {1, 2}) {
    const HexMesh mesh = samples::full_mesh(3, order);
    write_mesh(folder / "mesh.vtkhdf", mesh);
    vtkNew<vtkHDFReader> reader;
    auto* grid = vtkUnstructuredGrid::SafeDownCast(open(reader, folder / "mesh.vtkhdf"));
    ASSERT_NE(grid, nullptr);
    ASSERT_EQ(grid->GetNumberOfCells(), 27);
    EXPECT_EQ(grid->GetCellType(3), order == 1 ? VTK_HEXAHEDRON : VTK_TRIQUADRATIC_HEXAHEDRON);
    expect_vectors(grid->GetPoints()->GetData(), mesh.points, "points");
    expect_vectors(grid->GetPointData()->GetArray("imaged"), mesh.imaged, "imaged");
    expect_vectors(grid->GetPointData()->GetArray("reference"), mesh.reference, "reference");
    ASSERT_NE(grid->GetPointData()->GetArray("displacement_from_stress_free"), nullptr);
    ASSERT_NE(grid->GetPointData()->GetArray("displacement_from_scan"), nullptr);
    ASSERT_NE(grid->GetPointData()->GetArray("contact_pressure"), nullptr);
    vtkDataArray* tissue = grid->GetCellData()->GetArray("tissue");
    ASSERT_NE(tissue, nullptr);
    EXPECT_EQ(tissue->GetDataType(), VTK_UNSIGNED_CHAR);
    EXPECT_EQ(tissue->GetTuple1(0), double(mesh.tissue[0]));
    for (const char* name : {"fibroglandular_fraction", "pressure", "det_F", "scaled_jacobian"}) {
      EXPECT_NE(grid->GetCellData()->GetArray(name), nullptr) << name;
    }
    vtkDataArray* seconds = grid->GetFieldData()->GetArray("wall_seconds");
    ASSERT_NE(seconds, nullptr);
    EXPECT_EQ(seconds->GetTuple1(0), mesh.wall_seconds);
  }
}

// The same arrays, for programs that do not read VTKHDF.
TEST(VtkOpens, MeshesAsXml) {
  const ScratchFolder folder;
  for (const int order : {1, 2}) {
    const HexMesh mesh = samples::full_mesh(3, order);
    write_mesh(folder / "mesh.vtkhdf", mesh);
    const ToolResult result = run_tool("export-vtu", {"mesh.vtkhdf", "mesh.vtu"}, folder.path());
    ASSERT_EQ(result.exit_code, 0) << result.err;
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName((folder / "mesh.vtu").c_str());
    reader->Update();
    vtkUnstructuredGrid* grid = reader->GetOutput();
    vtkNew<vtkHDFReader> original;
    auto* same = vtkUnstructuredGrid::SafeDownCast(open(original, folder / "mesh.vtkhdf"));
    ASSERT_EQ(grid->GetNumberOfCells(), same->GetNumberOfCells());
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
      ASSERT_EQ(grid->GetCellType(cell), same->GetCellType(cell));
      for (vtkIdType k = 0; k < grid->GetCell(cell)->GetNumberOfPoints(); ++k)
        ASSERT_EQ(grid->GetCell(cell)->GetPointId(k), same->GetCell(cell)->GetPointId(k));
    }
    expect_vectors(grid->GetPoints()->GetData(), mesh.points, "points");
    const auto expect_same = [](vtkDataArray* ours, vtkDataArray* theirs, const char* name) {
      ASSERT_NE(ours, nullptr) << name;
      ASSERT_EQ(ours->GetNumberOfValues(), theirs->GetNumberOfValues()) << name;
      for (vtkIdType i = 0; i < ours->GetNumberOfTuples(); ++i) {
        for (int c = 0; c < ours->GetNumberOfComponents(); ++c)
          EXPECT_EQ(ours->GetComponent(i, c), theirs->GetComponent(i, c)) << name;
      }
    };
    for (const char* name : {"tissue", "pressure", "det_F"})
      expect_same(grid->GetCellData()->GetArray(name), same->GetCellData()->GetArray(name), name);
    for (const char* name :
         {"displacement_from_scan", "displacement_from_stress_free", "contact_pressure"})
      expect_same(grid->GetPointData()->GetArray(name), same->GetPointData()->GetArray(name), name);
  }
}

TEST(VtkOpens, Tetrahedra) {
  const ScratchFolder folder;
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  mesh.tissue = {Tissue::tumour};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  mesh.part = {2, 1, 0, 0};
  write_tet_mesh(folder / "t.vtu", mesh);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "t.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  ASSERT_EQ(grid->GetNumberOfCells(), 5);
  EXPECT_EQ(grid->GetCellType(0), VTK_TETRA);
  EXPECT_EQ(grid->GetCellType(4), VTK_TRIANGLE);
  EXPECT_EQ(grid->GetCell(1)->GetPointId(1), 1);  // triangles are turned outwards
  expect_vectors(grid->GetPoints()->GetData(), mesh.points, "points");
  EXPECT_EQ(grid->GetCellData()->GetArray("tissue")->GetTuple1(0), double(Tissue::tumour));
  EXPECT_EQ(grid->GetCellData()->GetArray("part")->GetTuple1(1), 2);
  EXPECT_EQ(grid->GetCellData()->GetArray("part")->GetTuple1(0), 255);
}

TEST(VtkOpens, LabelVolumes) {
  const ScratchFolder folder;
  const LabelVolume labels = samples::labels();
  write_labels(folder / "labels.vtkhdf", labels);
  vtkNew<vtkHDFReader> reader;
  auto* image = vtkImageData::SafeDownCast(open(reader, folder / "labels.vtkhdf"));
  ASSERT_NE(image, nullptr);
  for (int d = 0; d < 3; ++d) {
    EXPECT_EQ(image->GetDimensions()[d], labels.grid.size[d]);
    EXPECT_EQ(image->GetSpacing()[d], labels.grid.spacing[d]);
    EXPECT_EQ(image->GetOrigin()[d], labels.grid.origin[d]);
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(image->GetDirectionMatrix()->GetElement(d, c), labels.grid.direction(d, c));
    }
  }
  vtkDataArray* tissue = image->GetPointData()->GetArray("tissue");
  vtkDataArray* fraction = image->GetPointData()->GetArray("fibroglandular_fraction");
  ASSERT_NE(tissue, nullptr);
  ASSERT_NE(fraction, nullptr);
  ASSERT_NE(image->GetPointData()->GetArray("chest_wall_confidence"), nullptr);
  ASSERT_EQ(tissue->GetNumberOfTuples(), vtkIdType(labels.grid.voxels()));
  for (vtkIdType v = 0; v < tissue->GetNumberOfTuples(); ++v) {
    EXPECT_EQ(tissue->GetTuple1(v), labels.tissue[std::size_t(v)]);
    EXPECT_EQ(float(fraction->GetTuple1(v)), labels.fibroglandular_fraction[std::size_t(v)]);
  }
  // VTK 9.1 keeps the direction it read but forgets to recompute its
  // transform; copying recomputes it.
  vtkNew<vtkMatrix3x3> direction;
  direction->DeepCopy(image->GetDirectionMatrix());
  vtkNew<vtkImageData> placed;
  placed->SetSpacing(image->GetSpacing());
  placed->SetOrigin(image->GetOrigin());
  placed->SetDirectionMatrix(direction);
  const int ijk[3] = {3, 2, 5};
  double x[3];
  placed->TransformIndexToPhysicalPoint(ijk, x);
  const Vec3 expected = labels.grid.to_patient({3, 2, 5});
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(x[d], expected[d], 1e-12);
}

TEST(VtkOpens, Geometries) {
  const ScratchFolder folder;
  const BreastGeometry geometry = samples::geometry();
  write_geometry(folder / "geometry.vtkhdf", geometry);
  vtkNew<vtkHDFReader> reader;
  auto* grid = vtkUnstructuredGrid::SafeDownCast(open(reader, folder / "geometry.vtkhdf"));
  ASSERT_NE(grid, nullptr);
  const vtkIdType rim = vtkIdType(geometry.rim_skin.size());
  EXPECT_EQ(grid->GetNumberOfCells(), rim * (2 * 12 + 1));  // 12 rings a sheet, one band between
  EXPECT_NE(grid->GetCellData()->GetArray("part"), nullptr);
  // The outermost ring of the skin is the rim.
  double x[3];
  grid->GetPoint(1 + 11 * rim + 7, x);
  const Vec3 expected = geometry.skin.position(geometry.rim_skin[7]);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(x[d], expected[d], 1e-12);
}

}  // namespace
}  // namespace breast
