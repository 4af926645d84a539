// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/grid/itk_filters.hpp"

#include <itkConfidenceConnectedImageFilter.h>
#include <itkConnectedComponentImageFilter.h>
#include <itkMultiThreaderBase.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text/library_message.hpp"

namespace breast {

namespace {

/// Index space suffices for these filters; spacing matters only to distances.
template <class T>
typename itk::Image<T, 3>::Pointer image_of(const Volume<T>& volume) {
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(unsigned(threads()));
  auto image = itk::Image<T, 3>::New();
  typename itk::Image<T, 3>::SizeType size;
  typename itk::Image<T, 3>::SpacingType spacing;
  for (int d = 0; d < 3; ++d) {
    size[d] = volume.grid.size[d];
    spacing[d] = volume.grid.spacing[d];
  }
  image->SetRegions(typename itk::Image<T, 3>::RegionType(size));
  image->SetSpacing(spacing);
  image->Allocate();
  std::memcpy(image->GetBufferPointer(), volume.voxels.data(), volume.voxels.size() * sizeof(T));
  return image;
}

template <class Filter>
void run(Filter& filter) {
  try {
    filter.Update();
  } catch (const itk::ExceptionObject& exception) {
    throw failed_error(filter.GetNameOfClass(),
                       " failed: ", library_message(exception.GetDescription()));
  }
}

using Numbers = itk::Image<std::uint32_t, 3>;

/// As Components, in the image that the filter has filled.
struct NumberedImage {
  Numbers::Pointer image;
  std::uint32_t count;
  std::span<const std::uint32_t> label;
};

NumberedImage numbered_components(const Mask& mask) {
  auto filter = itk::ConnectedComponentImageFilter<itk::Image<std::uint8_t, 3>, Numbers>::New();
  filter->SetInput(image_of(mask));
  run(*filter);
  const Numbers::Pointer image = filter->GetOutput();
  return {image,
          std::uint32_t(filter->GetObjectCount()),
          {image->GetBufferPointer(), mask.voxels.size()}};
}

std::vector<std::size_t> sizes_of(std::uint32_t parts, std::span<const std::uint32_t> label) {
  std::vector<std::size_t> count(std::size_t(parts) + 1, 0);
  for (const std::uint32_t part : label) ++count[part];
  count[0] = 0;
  return count;
}

}  // namespace

Components components(const Mask& mask) {
  const NumberedImage parts = numbered_components(mask);
  return {parts.count, {parts.label.begin(), parts.label.end()}};
}

std::vector<std::size_t> sizes(const Components& parts) {
  return sizes_of(parts.count, parts.label);
}

Mask largest_component(const Mask& mask) {
  const NumberedImage parts = numbered_components(mask);
  const std::vector<std::size_t> count = sizes_of(parts.count, parts.label);
  const auto largest = std::uint32_t(std::max_element(count.begin(), count.end()) - count.begin());
  Mask out(mask.grid);
  if (count[largest] == 0) return out;
  for (std::size_t n = 0; n < mask.voxels.size(); ++n) out.voxels[n] = parts.label[n] == largest;
  return out;
}

Volume<float> signed_distance(const Mask& mask) {
  using Filter =
      itk::SignedMaurerDistanceMapImageFilter<itk::Image<std::uint8_t, 3>, itk::Image<float, 3>>;
  auto filter = Filter::New();
  filter->SetInput(image_of(mask));
  filter->SetSquaredDistance(false);
  filter->SetUseImageSpacing(true);
  filter->SetInsideIsPositive(false);
  run(*filter);
  Volume<float> out(mask.grid);
  std::memcpy(out.voxels.data(), filter->GetOutput()->GetBufferPointer(),
              out.voxels.size() * sizeof(float));
  return out;
}

Mask confidence_connected(Volume<float> volume, const std::vector<std::array<int, 3>>& seeds,
                          double multiplier, int radius, int iterations) {
  auto filter =
      itk::ConfidenceConnectedImageFilter<itk::Image<float, 3>, itk::Image<std::uint8_t, 3>>::New();
  filter->SetInput(image_of(volume));
  volume.voxels = std::vector<float>();  // `= {}` would keep the memory
  for (const auto& seed : seeds) filter->AddSeed({{seed[0], seed[1], seed[2]}});
  filter->SetMultiplier(multiplier);
  filter->SetInitialNeighborhoodRadius(unsigned(radius));
  filter->SetNumberOfIterations(unsigned(iterations));
  filter->SetReplaceValue(1);
  run(*filter);
  Mask out(volume.grid);
  std::memcpy(out.voxels.data(), filter->GetOutput()->GetBufferPointer(), out.voxels.size());
  return out;
}

}  // namespace breast
