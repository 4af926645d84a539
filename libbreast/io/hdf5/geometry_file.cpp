// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geometry_file.hpp"

#include "io/hdf5/hermite_group.hpp"
#include "io/hdf5/vtkhdf.hpp"

namespace breast {

namespace {
constexpr int rings = 12;
constexpr std::uint8_t vtk_triangle = 5, vtk_quad = 9;
enum Part : std::uint8_t { skin_part = 0, wall_part = 1, cut_part = 2 };

// The body's boundary for viewing: polar quads of each sheet inside its rim (triangles at the pole)
// and one band of quads between the rims.
class Boundary {
 public:
  explicit Boundary(const BreastGeometry& geometry) {
    const std::size_t n = geometry.rim_skin.size();
    Vec2 wall_centre(0, 0);
    for (const Vec2& st : geometry.rim_wall) wall_centre += st / double(n);
    add_disc(geometry.skin, geometry.rim_skin, geometry.centre, skin_part);
    const std::size_t skin_rim = points_.size() - n;
    add_disc(geometry.wall, geometry.rim_wall, wall_centre, wall_part);
    const std::size_t wall_rim = points_.size() - n;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + 1) % n;
      add_cell({skin_rim + i, skin_rim + j, wall_rim + j, wall_rim + i}, cut_part);
    }
  }

  void put(Document& document) const {
    put_unstructured_grid(document, points_, connectivity_, offsets_, types_);
    document.datasets["/VTKHDF/CellData/part"] = array_of(parts_);
  }

 private:
  void add_disc(const HermiteSheet& sheet, const std::vector<Vec2>& rim, const Vec2& centre,
                Part part) {
    const std::size_t pole = points_.size(), n = rim.size();
    points_.push_back(sheet.position(centre));
    for (int ring = 1; ring <= rings; ++ring) {
      for (const Vec2& st : rim) {
        points_.push_back(sheet.position(centre + double(ring) / rings * (st - centre)));
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + 1) % n;
      add_cell({pole, pole + 1 + i, pole + 1 + j}, part);
      for (int ring = 1; ring < rings; ++ring) {
        const std::size_t inner = pole + 1 + std::size_t(ring - 1) * n, outer = inner + n;
        add_cell({inner + i, outer + i, outer + j, inner + j}, part);
      }
    }
  }

  void add_cell(const std::vector<std::size_t>& nodes, Part part) {
    connectivity_.insert(connectivity_.end(), nodes.begin(), nodes.end());
    offsets_.push_back(std::int64_t(connectivity_.size()));
    types_.push_back(nodes.size() == 3 ? vtk_triangle : vtk_quad);
    parts_.push_back(part);
  }

  std::vector<Vec3> points_;
  Integers connectivity_, offsets_{0};
  Bytes types_, parts_;
};

}  // namespace

BreastGeometry read_geometry(const std::filesystem::path& file) {
  Document document = load_document(file, "geometry/1", "fit-hermite");
  const std::string sha256 = content_sha256(document);
  const Complaint complain{ErrorKind::input, file.string(), "; make it with fit-hermite"};
  Fields fields(document, complain);
  check_unstructured_grid(fields);
  const FileHeader header = get_header(fields);
  BreastGeometry geometry = get_hermite(fields);
  geometry.side = header.side;
  geometry.history = header.history;
  geometry.content_sha256 = sha256;
  check_geometry(geometry, complain);
  return geometry;
}

void write_geometry(const std::filesystem::path& file, const BreastGeometry& geometry) {
  check_geometry(geometry, {ErrorKind::failed, file.string(), ""});
  Document document;
  put_header(document, {"geometry/1", geometry.side, geometry.history});
  put_hermite(document, geometry);
  Boundary(geometry).put(document);
  save_document(file, document);
}

}  // namespace breast
