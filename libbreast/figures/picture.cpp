// SPDX-License-Identifier: GPL-3.0-or-later
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtk_glew.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/own_file.hpp"
#include "figures/canvas.hpp"
#include "figures/canvas_impl.hpp"
#include "figures/drawing_memory.hpp"

namespace breast {

struct Picture::Impl {
  DrawingMemory memory;
  int width = 0, height = 0;
  std::vector<std::unique_ptr<Panel>> panels;
  vtkSmartPointer<vtkRenderWindow> window;
};

Picture::Picture(int width, int height) : impl_(std::make_unique<Impl>()) {
  impl_->width = width;
  impl_->height = height;
  impl_->window = vtkSmartPointer<vtkRenderWindow>::New();
  impl_->window->SetOffScreenRendering(1);
  impl_->window->SetSize(width * supersampling, height * supersampling);
  impl_->window->SetMultiSamples(0);
  impl_->window->SetAlphaBitPlanes(1);
  impl_->window->SetNumberOfLayers(2);
}

Picture::~Picture() = default;

Panel& Picture::panel(double left, double bottom, double right, double top) {
  auto panel = std::make_unique<Panel::Impl>();
  panel->renderer->SetViewport(left, bottom, right, top);
  panel->renderer->SetBackground(1, 1, 1);
  panel->renderer->SetUseDepthPeeling(1);
  panel->renderer->SetMaximumNumberOfPeels(12);
  panel->renderer->SetOcclusionRatio(0);
  panel->lights->SetKeyLightIntensity(0.85);
  panel->lights->SetKeyLightAngle(35, -25);
  panel->lights->AddLightsToRenderer(panel->renderer);
  panel->pixels = Vec2((right - left) * impl_->width, (top - bottom) * impl_->height);
  panel->front->SetViewport(left, bottom, right, top);
  panel->front->SetLayer(1);
  panel->front->SetActiveCamera(panel->renderer->GetActiveCamera());
  panel->front_lights->SetKeyLightIntensity(0.85);
  panel->front_lights->SetKeyLightAngle(35, -25);
  panel->front_lights->AddLightsToRenderer(panel->front);
  impl_->window->AddRenderer(panel->renderer);
  impl_->window->AddRenderer(panel->front);
  impl_->panels.push_back(std::make_unique<Panel>(std::move(panel)));
  return *impl_->panels.back();
}

namespace {

// Rounds to every third of 256 values, including black and white: the difference is invisible, and
// a noisy scan takes two thirds of the bytes.
unsigned char rounded(double value) {
  constexpr int step = 3;
  return static_cast<unsigned char>(step * int(std::lround(value / step)));
}

// Mean of each block of supersampled pixels.
vtkSmartPointer<vtkImageData> averaged(vtkUnsignedCharArray* pixels, int width, int height) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* out = static_cast<unsigned char*>(image->GetScalarPointer());
  const unsigned char* in = pixels->GetPointer(0);
  constexpr int s = supersampling;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int k = 0; k < s * s; ++k) {
          sum += in[(std::size_t(y * s + k / s) * (width * s) + x * s + k % s) * 3 + c];
        }
        *out++ = rounded(double(sum) / (s * s));
      }
    }
  }
  return image;
}

}  // namespace

void Picture::save(const std::filesystem::path& file) {
  impl_->window->Render();
  // VTK asks OpenGL for errors in debug builds only, and draws on.
  if (impl_->memory.refused() || glGetError() == GL_OUT_OF_MEMORY) throw std::bad_alloc();
  vtkNew<vtkUnsignedCharArray> pixels;
  const int w = impl_->width * supersampling, h = impl_->height * supersampling;
  impl_->window->GetPixelData(0, 0, w - 1, h - 1, 0, pixels);
  if (pixels->GetNumberOfValues() != vtkIdType(3) * w * h) {
    throw failed_error(file.string(),
                       ": the picture could not be drawn (OpenGL returned no pixels)");
  }
  vtkNew<vtkPNGWriter> writer;
  writer->WriteToMemoryOn();
  writer->SetCompressionLevel(9);
  writer->SetInputData(averaged(pixels, impl_->width, impl_->height));
  writer->Write();
  if (writer->GetErrorCode() != 0) throw failed_error(file.string(), ": cannot be written");
  vtkUnsignedCharArray* png = writer->GetResult();
  write_bytes(file, marked_png({reinterpret_cast<const char*>(png->GetPointer(0)),
                                std::size_t(png->GetNumberOfValues())}));
}

}  // namespace breast
