// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/canvas.hpp"

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCoordinate.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3D.h>
#include <vtkImageActor.h>
#include <vtkImageData.h>
#include <vtkImageMapper3D.h>
#include <vtkImageProperty.h>
#include <vtkLightKit.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTubeFilter.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "figures/canvas_impl.hpp"
#include "figures/colour_scale.hpp"

VTK_MODULE_INIT(vtkRenderingOpenGL2);
VTK_MODULE_INIT(vtkRenderingFreeType);

namespace breast {

namespace {

vtkSmartPointer<vtkPoints> vtk_points(const std::vector<Vec3>& points) {
  auto list = vtkSmartPointer<vtkPoints>::New();
  for (const Vec3& x : points) list->InsertNextPoint(x.data());
  return list;
}

vtkSmartPointer<vtkPolyData> vtk_line(const std::vector<Vec3>& points) {
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(int(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) cells->InsertCellPoint(vtkIdType(i));
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(vtk_points(points));
  data->SetLines(cells);
  return data;
}

vtkSmartPointer<vtkPolyData> vtk_facets(const Facets& facets) {
  vtkNew<vtkCellArray> cells;
  for (const auto& quad : facets.quads) {
    const int corners = quad[2] == quad[3] ? 3 : 4;
    cells->InsertNextCell(corners);
    for (int k = 0; k < corners; ++k) cells->InsertCellPoint(quad[k]);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(vtk_points(facets.points));
  data->SetPolys(cells);
  return data;
}

}  // namespace

Panel::Panel(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Panel::~Panel() = default;

void Panel::draw_through(bool on) {
  impl_->through = on;
}

void Panel::surface(const Facets& facets, const Look& look) {
  const auto data = vtk_facets(facets);
  vtkNew<vtkPolyDataMapper> mapper;
  if (!facets.normals.empty()) {
    vtkNew<vtkDoubleArray> normals;
    normals->SetNumberOfComponents(3);
    for (const Vec3& n : facets.normals) normals->InsertNextTuple(n.data());
    data->GetPointData()->SetNormals(normals);
    mapper->SetInputData(data);
  } else if (look.smooth) {
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(data);
    normals->SetFeatureAngle(50);
    normals->ConsistencyOff();
    mapper->SetInputConnection(normals->GetOutputPort());
  } else {
    mapper->SetInputData(data);
  }
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetColor(look.colour.r, look.colour.g, look.colour.b);
  property->SetOpacity(look.opacity);
  property->SetAmbient(0.12);
  property->SetDiffuse(0.85);
  property->SetSpecular(look.shine);
  property->SetSpecularPower(25);
  if (!look.smooth) property->SetInterpolationToFlat();
  if (look.edges) {
    property->EdgeVisibilityOn();
    property->SetEdgeColor(look.edge_colour.r, look.edge_colour.g, look.edge_colour.b);
    property->SetLineWidth(float(0.7 * supersampling));
  }
  impl_->add(actor);
  for (const auto& quad : facets.quads) {
    for (const int corner : quad) impl_->extend(facets.points[corner]);
  }
}

// The mapper interpolates the values, not their colours, and looks the colours up.
void Panel::values(const Facets& facets, const std::vector<double>& at_points, double high) {
  const auto data = vtk_facets(facets);
  vtkNew<vtkDoubleArray> scalars;
  for (const double value : at_points) scalars->InsertNextValue(value);
  data->GetPointData()->SetScalars(scalars);
  constexpr int shades = 256;
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(shades);
  for (int k = 0; k < shades; ++k) {
    const Colour colour = heat(double(k) / (shades - 1));
    table->SetTableValue(k, colour.r, colour.g, colour.b, 1);
  }
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->InterpolateScalarsBeforeMappingOn();
  mapper->SetLookupTable(table);
  mapper->SetScalarRange(0, high);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  // The colours are compared with the colour bar, so there is hardly any shading.
  property->SetAmbient(0.75);
  property->SetDiffuse(0.25);
  property->EdgeVisibilityOn();
  property->SetEdgeColor(0.6, 0.55, 0.5);
  property->SetLineWidth(float(0.4 * supersampling));
  impl_->add(actor, facets.points);
}

void Panel::sphere(const Vec3& centre, double radius, const Colour& colour) {
  cloud({centre}, radius, colour);
}

void Panel::cloud(const std::vector<Vec3>& points, double radius, const Colour& colour) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(vtk_points(points));
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(radius);
  ball->SetThetaResolution(points.size() > 100 ? 8 : 32);
  ball->SetPhiResolution(points.size() > 100 ? 6 : 24);
  vtkNew<vtkGlyph3D> glyphs;
  glyphs->SetInputData(data);
  glyphs->SetSourceConnection(ball->GetOutputPort());
  glyphs->ScalingOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(glyphs->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour.r, colour.g, colour.b);
  actor->GetProperty()->SetAmbient(0.25);
  actor->GetProperty()->SetSpecular(0.3);
  impl_->add(actor, points);
}

void Panel::tube(const std::vector<Vec3>& points, double radius, const Colour& colour) {
  if (points.size() < 2) return;
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputData(vtk_line(points));
  tube->SetRadius(radius);
  tube->SetNumberOfSides(14);
  tube->CappingOn();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(tube->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour.r, colour.g, colour.b);
  actor->GetProperty()->SetAmbient(0.35);
  impl_->add(actor, points);
}

void Panel::image(const std::vector<std::uint16_t>& grey, int width, int height, double pixel) {
  vtkNew<vtkImageData> data;
  data->SetDimensions(width, height, 1);
  data->SetSpacing(pixel, pixel, 1);
  data->AllocateScalars(VTK_UNSIGNED_SHORT, 1);
  auto* values = static_cast<std::uint16_t*>(data->GetScalarPointer());
  for (int row = 0; row < height; ++row) {
    std::copy_n(grey.begin() + std::ptrdiff_t(row) * width, width,
                values + std::ptrdiff_t(height - 1 - row) * width);
  }
  vtkNew<vtkImageActor> actor;
  actor->GetMapper()->SetInputData(data);
  actor->GetProperty()->SetColorWindow(65535);
  actor->GetProperty()->SetColorLevel(32767.5);
  actor->GetProperty()->SetInterpolationTypeToLinear();
  impl_->renderer->AddViewProp(actor);
  impl_->extend({0, 0, 0});
  impl_->extend({pixel * (width - 1), pixel * (height - 1), 0});
}

void Panel::stroke(const std::vector<Vec3>& points, const Colour& colour, double width) {
  if (points.size() < 2) return;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(vtk_line(points));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour.r, colour.g, colour.b);
  actor->GetProperty()->SetLineWidth(float(width * supersampling));
  actor->GetProperty()->LightingOff();
  impl_->add(actor);
}

void Panel::strokes(const std::vector<std::array<Vec3, 2>>& pieces, const Colour& colour,
                    double width) {
  if (pieces.empty()) return;
  std::vector<Vec3> ends;
  vtkNew<vtkCellArray> cells;
  for (const auto& piece : pieces) {
    cells->InsertNextCell(2);
    for (const Vec3& end : piece) {
      cells->InsertCellPoint(vtkIdType(ends.size()));
      ends.push_back(end);
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(vtk_points(ends));
  data->SetLines(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour.r, colour.g, colour.b);
  actor->GetProperty()->SetLineWidth(float(width * supersampling));
  actor->GetProperty()->LightingOff();
  impl_->add(actor, ends);
}

void Panel::look_along(const Vec3& direction, const Vec3& up, double margin) {
  const Vec3 d = direction.normalized();
  const Vec3 right = d.cross(up).normalized(), top = right.cross(d);
  Vec2 low = Vec2::Constant(1e300), high = -low;
  for (const Vec3& x : impl_->shown) {
    const Vec2 p(x.dot(right), x.dot(top));
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec2 size = this->size();
  const double needed = std::max(high.y() - low.y(), (high.x() - low.x()) * size.y() / size.x());
  const Vec2 middle = 0.5 * (low + high);
  Vec3 mean = Vec3::Zero();
  for (const Vec3& x : impl_->shown) mean += x / double(impl_->shown.size());
  const Vec3 centre = middle.x() * right + middle.y() * top + mean.dot(d) * d;
  look_along(direction, up, centre, needed / (1 - 2 * margin));
}

void Panel::look_along(const Vec3& direction, const Vec3& up, const Vec3& centre,
                       double height_mm) {
  impl_->forward = direction.normalized();
  impl_->right = impl_->forward.cross(up).normalized();
  impl_->top = impl_->right.cross(impl_->forward);
  impl_->centre = centre;
  impl_->height_mm = height_mm;
  vtkCamera* camera = impl_->renderer->GetActiveCamera();
  const Vec3 eye = centre - 1000 * impl_->forward;
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(centre.x(), centre.y(), centre.z());
  camera->SetPosition(eye.x(), eye.y(), eye.z());
  camera->SetViewUp(impl_->top.x(), impl_->top.y(), impl_->top.z());
  camera->SetParallelScale(height_mm / 2);
  camera->SetClippingRange(1, 3000);
}

double Panel::height_mm() const {
  return impl_->height_mm;
}

void Panel::set_height_mm(double height) {
  look_along(impl_->forward, impl_->top, impl_->centre, height);
}

double Panel::mm_per_pixel() const {
  return impl_->height_mm / size().y();
}

Vec2 Panel::size() const {
  return impl_->pixels;
}

Vec2 Panel::to_pixel(const Vec3& x) const {
  const Vec3 d = x - impl_->centre;
  return 0.5 * size() + Vec2(d.dot(impl_->right), d.dot(impl_->top)) / mm_per_pixel();
}

namespace {

vtkSmartPointer<vtkTextActor> words_at(const Vec2& at, const std::string& words, double height,
                                       const Colour& colour, Align align) {
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(words.c_str());
  actor->SetTextScaleModeToNone();
  vtkTextProperty* property = actor->GetTextProperty();
  property->SetFontFamilyToArial();
  property->SetFontSize(int(std::lround(height * supersampling)));
  property->SetColor(colour.r, colour.g, colour.b);
  if (colour.r + colour.g + colour.b > 2.4) {  // light text is drawn on an image
    property->ShadowOn();
    property->SetShadowOffset(supersampling, -supersampling);
  }
  property->SetVerticalJustificationToCentered();
  if (align == Align::left) property->SetJustificationToLeft();
  if (align == Align::centre) property->SetJustificationToCentered();
  if (align == Align::right) property->SetJustificationToRight();
  actor->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  actor->SetPosition(at.x() * supersampling, at.y() * supersampling);
  return actor;
}

}  // namespace

// Objects in the plane of the picture belong to the front layer, over everything that is drawn
// through.
void Panel::text(const Vec2& at, const std::string& words, double height, const Colour& colour,
                 Align align) {
  impl_->front->AddViewProp(words_at(at, words, height, colour, align));
}

void Panel::label(const Vec2& at, const std::string& words, double height, const Colour& colour,
                  Align align) {
  const auto actor = words_at(at, words, height, colour, align);
  actor->GetTextProperty()->SetBackgroundColor(1, 1, 1);
  actor->GetTextProperty()->SetBackgroundOpacity(0.8);
  impl_->front->AddViewProp(actor);
}

void Panel::line(const Vec2& from, const Vec2& to, const Colour& colour, double width) {
  path({from, to}, colour, width);
}

void Panel::path(const std::vector<Vec2>& points, const Colour& colour, double width) {
  vtkNew<vtkCoordinate> viewport;
  viewport->SetCoordinateSystemToViewport();
  vtkNew<vtkPolyDataMapper2D> mapper;
  std::vector<Vec3> lifted;
  for (const Vec2& p : points) {
    lifted.emplace_back(p.x() * supersampling, p.y() * supersampling, 0);
  }
  mapper->SetInputData(vtk_line(lifted));
  mapper->SetTransformCoordinate(viewport);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour.r, colour.g, colour.b);
  actor->GetProperty()->SetLineWidth(float(width * supersampling));
  impl_->front->AddViewProp(actor);
}

}  // namespace breast
