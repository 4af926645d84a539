#include <cmath>

#include "contact/compression.hpp"
#include "core/error.hpp"

namespace breast {

namespace {
/// Ranges of clinical practice and where they come from.
struct Range {
  const char* name;
  const char* unit;
  double low, high;
  const char* source;
};
constexpr Range force_range{"paddle force", "N", 50, 180, "Dutch protocol, Radiology 181:355"};
constexpr Range pressure_range{"mean pressure", "kPa", 5, 25, "de Groot 2013"};
constexpr Range area_range{"contact area", "cm2", 60, 150, "100 N on 100 cm2 is typical"};
constexpr Range thickness_range{"thickness", "mm", 35, 70, "Helvie; UK 2022 mean 62 mm"};
constexpr Range reduction_range{"reduction", "%", 35, 55, "VICTRE 45-51 %"};

std::string judge(const Range& range, double value) {
  const double shown = std::abs(value) >= 10 ? std::round(value) : std::round(10 * value) / 10;
  const char* verdict = value < range.low ? "below" : value > range.high ? "above" : "within";
  return message(range.name, " ", shown, " ", range.unit, " is ", verdict,
                 " the clinical range of ", range.low, "-", range.high, " ", range.unit, " (",
                 range.source, ")");
}
}  // namespace

std::vector<std::string> judge_compression(double force_N, double mean_kPa, double area_cm2,
                                           double thickness_mm, double reduction_percent) {
  std::vector<std::string> words{judge(force_range, force_N), judge(pressure_range, mean_kPa),
                                 judge(area_range, area_cm2), judge(thickness_range, thickness_mm),
                                 judge(reduction_range, reduction_percent)};
  if (force_N < force_range.low) {
    words.push_back(
        "a held rigid chest wall and soft moduli give too little force: most of the machine's "
        "force "
        "acts on the stiff tissue at the chest wall, which the model leaves out");
  }
  if (force_N > force_range.high) {
    words.push_back(
        "no patient bears this force: the laws stiffen too much in compression, or the plate edge "
        "is "
        "too close to the held chest wall");
  }
  return words;
}

}  // namespace breast
