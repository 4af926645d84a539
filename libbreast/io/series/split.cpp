// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/series/split.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/statistics/percentile.hpp"
#include "core/table.hpp"

namespace breast {

namespace {

using Part = std::vector<DicomImage>;

constexpr double same_place_mm = 1e-3;

double along_normal(const DicomImage& slice, const DicomImage& first) {
  return slice.position.dot(first.row.cross(first.column).normalized());
}

/// How many images lie at the place that has most of them; `all` tells whether every place has as many.
std::size_t most_at_a_place(const Part& sorted, bool& all) {
  const std::vector<double> at = places_of(sorted);
  std::size_t most = 0, least = sorted.size();
  for (std::size_t from = 0; from < at.size();) {
    std::size_t to = from + 1;
    while (to < at.size() && at[to] - at[from] < same_place_mm) ++to;
    most = std::max(most, to - from);
    least = std::min(least, to - from);
    from = to;
  }
  all = most == least;
  return most;
}

bool has_distinct_places(const Part& part) {
  Part sorted = part;
  sort_slices(sorted);
  bool all = false;
  return most_at_a_place(sorted, all) <= 1;
}

/// Numbers in their order, before texts.
struct MarkOrder {
  bool operator()(const std::string& a, const std::string& b) const {
    const auto x = number_in(a), y = number_in(b);
    if (x && y && *x != *y) return *x < *y;
    if (x.has_value() != y.has_value()) return x.has_value();
    return a < b;
  }
};
using Parts = std::map<std::string, Part, MarkOrder>;

Parts divided(const Part& part, Mark mark) {
  Parts parts;
  for (const DicomImage& image : part) parts[image.mark(mark)].push_back(image);
  return parts;
}

bool all_distinct(const Parts& parts) {
  return std::all_of(parts.begin(), parts.end(),
                     [](const auto& part) { return has_distinct_places(part.second); });
}

bool of_time(Mark mark) {
  return mark < Mark::kind;
}

constexpr std::array time_marks{Mark::time, Mark::acquisition, Mark::trigger, Mark::acquired_at,
                                Mark::stored_at};
constexpr std::array kind_marks{Mark::kind, Mark::component, Mark::echo, Mark::weighting};

DicomStack part_of(const DicomStack& whole, Part slices) {
  DicomStack part = whole;
  part.slices = std::move(slices);
  sort_slices(part.slices);
  return part;
}

/// The stack divided by one mark; empty if two images at the same place carry the same mark. A kind may have
/// images at a few places only (a map, a projection), so that no place need have all kinds.
std::vector<DicomStack> by_one(const DicomStack& stack, Mark mark, std::size_t wanted) {
  const Parts parts = divided(stack.slices, mark);
  const bool enough = mark == Mark::kind ? parts.size() >= wanted : parts.size() == wanted;
  if (!enough || !all_distinct(parts)) return {};
  std::vector<DicomStack> stacks;
  for (const auto& [value, slices] : parts) {
    stacks.push_back(part_of(stack, slices));
    (of_time(mark) ? stacks.back().time : stacks.back().kind) = int(stacks.size());
    (of_time(mark) ? stacks.back().times : stacks.back().kinds) = int(parts.size());
  }
  return stacks;
}

/// Divided by a mark of time and, within every time point, one of kind.
std::vector<DicomStack> by_two(const DicomStack& stack, Mark time, Mark kind, std::size_t wanted) {
  const Parts times = divided(stack.slices, time);
  if (times.size() < 2 || wanted % times.size() != 0) return {};
  std::vector<DicomStack> stacks;
  int number = 0;
  for (const auto& [value, slices] : times) {
    DicomStack at_time = part_of(stack, slices);
    at_time.time = ++number;
    at_time.times = int(times.size());
    std::vector<DicomStack> kinds = by_one(at_time, kind, wanted / times.size());
    if (kinds.empty()) return {};
    stacks.insert(stacks.end(), kinds.begin(), kinds.end());
  }
  return stacks;
}

/// The nth image of every place, in the order in which the scanner numbered them.
std::vector<DicomStack> by_number(const DicomStack& stack, std::size_t wanted) {
  std::vector<Part> parts(wanted);
  Part ordered = stack.slices;
  std::stable_sort(ordered.begin(), ordered.end(), [](const DicomImage& a, const DicomImage& b) {
    return a.instance_number != b.instance_number ? a.instance_number < b.instance_number
                                                  : a.frame < b.frame;
  });
  struct Place {
    std::size_t images = 0;
    std::pair<int, int> last;
  };
  std::map<long long, Place> places;
  for (const DicomImage& image : ordered) {
    Place& place = places[std::llround(along_normal(image, stack.slices.front()) / same_place_mm)];
    const std::pair number(image.instance_number, image.frame);
    if (place.images > 0 && place.last == number) return {};  // nothing tells them apart
    place.last = number;
    parts[std::min(place.images++, wanted - 1)].push_back(image);
  }
  std::vector<DicomStack> stacks;
  for (Part& part : parts) {
    if (part.empty() || !has_distinct_places(part)) return {};
    stacks.push_back(part_of(stack, std::move(part)));
    stacks.back().time = int(stacks.size());
    stacks.back().times = int(wanted);
  }
  return stacks;
}

}  // namespace

void sort_slices(std::vector<DicomImage>& slices) {
  if (slices.empty()) return;
  const DicomImage first = slices.front();
  std::stable_sort(slices.begin(), slices.end(), [&](const DicomImage& a, const DicomImage& b) {
    const double x = along_normal(a, first), y = along_normal(b, first);
    return x != y ? x < y : a.file != b.file ? a.file < b.file : a.frame < b.frame;
  });
}

std::vector<double> places_of(const std::vector<DicomImage>& slices) {
  std::vector<double> places;
  for (const DicomImage& slice : slices) places.push_back(along_normal(slice, slices.front()));
  return places;
}

std::vector<DicomStack> by_time_and_kind(DicomStack stack) {
  sort_slices(stack.slices);
  bool all_places = false;
  const std::size_t wanted = most_at_a_place(stack.slices, all_places);
  if (wanted < 2 || wanted == stack.slices.size()) return {std::move(stack)};
  for (const Mark kind : kind_marks) {
    if (auto stacks = by_one(stack, kind, wanted); !stacks.empty()) return stacks;
  }
  for (const Mark time : time_marks) {
    if (auto stacks = by_one(stack, time, wanted); !stacks.empty()) return stacks;
  }
  for (const Mark time : time_marks) {
    for (const Mark kind : kind_marks) {
      if (auto stacks = by_two(stack, time, kind, wanted); !stacks.empty()) return stacks;
    }
  }
  if (all_places) {
    if (auto stacks = by_number(stack, wanted); !stacks.empty()) return stacks;
  }
  return {std::move(stack)};
}

std::vector<DicomStack> by_slab(DicomStack stack) {
  constexpr double least_gap_mm = 20, least_gap = 3;  // of the usual step
  constexpr std::size_t least_slices = 4;
  const std::size_t count = stack.slices.size();
  const DicomImage& first = stack.first();
  const Vec3 normal = first.row.cross(first.column);
  if (count < 2 * least_slices || std::abs(normal.x()) < 0.7) return {std::move(stack)};
  const std::vector<double> at = places_of(stack.slices);
  std::vector<double> steps;
  for (std::size_t n = 1; n < count; ++n) steps.push_back(at[n] - at[n - 1]);
  const auto widest = std::max_element(steps.begin(), steps.end());
  const std::size_t split = std::size_t(widest - steps.begin()) + 1;
  if (*widest < std::max(least_gap_mm, least_gap * median(steps)) || split < least_slices ||
      count - split < least_slices)
    return {std::move(stack)};
  const auto middle = stack.slices.begin() + std::ptrdiff_t(split);
  std::vector<DicomStack> slabs{part_of(stack, Part(stack.slices.begin(), middle)),
                                part_of(stack, Part(middle, stack.slices.end()))};
  const bool left_first = normal.x() < 0;  // x grows to the patient's left
  for (DicomStack& slab : slabs) slab.of_side = true;
  slabs[0].side = left_first ? Side::left : Side::right;
  slabs[1].side = left_first ? Side::right : Side::left;
  return slabs;
}

}  // namespace breast
