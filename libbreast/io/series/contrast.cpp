// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/series/contrast.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text/lists.hpp"
#include "core/text/lower_case.hpp"
#include "core/text/trimmed.hpp"

namespace breast {

namespace {

/// Words of some element, in small letters.
class Words {
 public:
  void add_values(const std::string& text) {  // "ORIGINAL\PRIMARY\W"
    for (const std::string& value : split(lower_case(text), '\\')) words_.push_back(trimmed(value));
  }
  void add_words(const std::string& text) {  // "t1_fl3d_tra fatsat"
    std::string word;
    for (const char c : lower_case(text) + " ") {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
        word += c;
      } else if (!word.empty()) {
        words_.push_back(std::exchange(word, ""));
      }
    }
  }
  bool any(std::initializer_list<std::string_view> names) const {
    return std::any_of(words_.begin(), words_.end(), [&](const std::string& word) {
      return std::find(names.begin(), names.end(), word) != names.end();
    });
  }

 private:
  std::vector<std::string> words_;
};

enum class Weighting { unknown, t1, t2 };

Weighting weighting_by_times(double repetition_ms, double echo_ms) {
  constexpr double short_echo = 30, long_echo = 60, short_repetition = 1200;
  if (echo_ms >= long_echo) return Weighting::t2;
  if (echo_ms > 0 && echo_ms <= short_echo && repetition_ms > 0 &&
      repetition_ms <= short_repetition)
    return Weighting::t1;
  return Weighting::unknown;
}

/// What is made from other images, or shows a part of the signal.
ScanContrast derived_kind(const Words& type, const Words& description) {
  if (type.any({"projection image", "mip", "mpr", "minip", "max_ip", "min_ip", "mean_ip"}))
    return ScanContrast::projection;
  if (type.any({"p", "phase", "phase map", "r", "real", "i", "imaginary"}) &&
      !type.any({"m", "magnitude"}))
    return ScanContrast::phase;
  if (type.any({"sub", "subtraction", "subtracted"})) return ScanContrast::subtraction;
  if (type.any({"diffusion", "adc", "tracew", "trace"})) return ScanContrast::diffusion;
  if (type.any({"ff", "fat_fraction", "water_fraction", "r2_star", "r2_star_map", "t2_star",
                "t2_star_map", "b0_map", "field_map", "quantity"}))
    return ScanContrast::map;
  if (type.any({"w", "water", "dixon_water"})) return ScanContrast::water;
  if (type.any({"f", "fat", "dixon_fat"})) return ScanContrast::fat;
  if (type.any({"ip", "in_phase", "inphase"})) return ScanContrast::in_phase;
  if (type.any({"op", "out_phase", "opp_phase", "outphase", "out_of_phase"}))
    return ScanContrast::opposed_phase;
  if (description.any({"sub", "subtraction", "subtracted"})) return ScanContrast::subtraction;
  if (description.any({"mip"})) return ScanContrast::projection;
  if (description.any({"dwi", "adc", "diffusion", "resolve", "ep2d"}))
    return ScanContrast::diffusion;
  if (description.any({"water", "w"})) return ScanContrast::water;
  const bool of_phase = description.any({"phase", "dixon"});  // "in phase", "dixon_in"
  if (description.any({"outphase", "opposed", "op", "opp"}) ||
      (of_phase && description.any({"out"})))
    return ScanContrast::opposed_phase;
  if (description.any({"inphase", "ip"}) || (of_phase && description.any({"in"})))
    return ScanContrast::in_phase;
  if (description.any({"fat", "f"}) &&
      !description.any({"sat", "sup", "without", "no", "nofat", "non"}))
    return ScanContrast::fat;
  return ScanContrast::unknown;
}

bool is_fat_suppressed(const std::function<std::string(const char*)>& value,
                       const Words& description) {
  Words options;
  options.add_values(value("0018|0022"));
  options.add_values(value("0018|0021"));
  if (options.any({"fs", "fatsat", "fat sat", "spir", "spair", "fsat"})) return true;
  const std::string suppressed = lower_case(value("0018|9025"));  // enhanced objects
  if (suppressed.starts_with("fat")) return true;
  if (description.any({"nofs", "nonfs", "nofatsat", "non", "without", "no", "wofs"})) return false;
  return description.any({"fs", "fatsat", "spair", "spir", "stir", "tirm", "fatsup", "fsat"}) ||
         (description.any({"fat"}) && description.any({"sat", "saturation", "sup", "suppressed"}));
}

}  // namespace

const char* contrast_name(ScanContrast contrast) {
  constexpr std::array names{"T1",
                             "in phase",
                             "not stated",
                             "T1 fat-suppressed",
                             "water",
                             "T2",
                             "T2 fat-suppressed",
                             "opposed phase",
                             "fat",
                             "diffusion",
                             "subtraction",
                             "phase or complex part",
                             "map of a quantity",
                             "projection"};
  return names[std::size_t(contrast)];
}

ScanContrast contrast_of(const std::function<std::string(const char*)>& value) {
  Words type, description;
  type.add_values(value("0008|0008"));
  description.add_words(value("0008|103e"));
  description.add_words(value("0018|1030"));
  const ScanContrast kind = derived_kind(type, description);
  if (kind != ScanContrast::unknown) return kind;
  Weighting weighting = weighting_by_times(std::atof(value("0018|0080").c_str()),
                                           std::atof(value("0018|0081").c_str()));
  if (weighting == Weighting::unknown &&
      description.any({"t1", "t1w", "vibrant", "thrive", "vibe"}))
    weighting = Weighting::t1;
  if (weighting == Weighting::unknown && description.any({"t2", "t2w", "stir", "tirm"}))
    weighting = Weighting::t2;
  const bool suppressed = is_fat_suppressed(value, description);
  if (weighting == Weighting::t1)
    return suppressed ? ScanContrast::t1_fat_suppressed : ScanContrast::t1;
  if (weighting == Weighting::t2)
    return suppressed ? ScanContrast::t2_fat_suppressed : ScanContrast::t2;
  return suppressed ? ScanContrast::t1_fat_suppressed : ScanContrast::unknown;
}

}  // namespace breast
