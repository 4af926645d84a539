// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/series/contrast.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text/lists.hpp"
#include "core/text/lower_case.hpp"
#include "core/text/trimmed.hpp"

namespace breast {

namespace {

/// Words of some element, in small letters and in their order.
class Words {
 public:
  void add_values(const std::string& text) {  // "ORIGINAL\PRIMARY\W"
    for (const std::string& value : split(lower_case(text), '\\')) words_.push_back(trimmed(value));
  }
  void add_words(const std::string& text) {  // "t1_fl3d_tra fatsat"
    std::string word;
    const std::string small = spelled_out(lower_case(text)) + " ";
    for (const char c : small) {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
        word += c;
      } else if (!word.empty()) {
        words_.push_back(std::exchange(word, ""));
      }
    }
    words_.emplace_back();  // what follows is another text
  }
  using Names = std::vector<std::string_view>;
  bool any(const Names& names) const {
    return std::any_of(words_.begin(), words_.end(),
                       [&](const std::string& word) { return is_one(word, names); });
  }
  bool any_ends(std::string_view ending) const {
    return std::any_of(words_.begin(), words_.end(),
                       [&](const std::string& word) { return word.ends_with(ending); });
  }
  /// Whether one of `names` occurs that none of `before` precedes and none of `after` follows.
  bool any_but(const Names& names, const Names& before, const Names& after) const {
    for (std::size_t n = 0; n < words_.size(); ++n) {
      const bool excluded = (n > 0 && is_one(words_[n - 1], before)) ||
                            (n + 1 < words_.size() && is_one(words_[n + 1], after));
      if (is_one(words_[n], names) && !excluded) return true;
    }
    return false;
  }
  /// Whether these words occur one after the other, and none of `before` precedes them.
  bool in_row(const Names& first, const Names& second, const Names& before = {}) const {
    for (std::size_t n = 0; n + 1 < words_.size(); ++n) {
      if (is_one(words_[n], first) && is_one(words_[n + 1], second) &&
          !(n > 0 && is_one(words_[n - 1], before)))
        return true;
    }
    return false;
  }

 private:
  static bool is_one(const std::string& word, const Names& names) {
    return std::find(names.begin(), names.end(), word) != names.end();
  }
  /// "w/o" and "w/" are words, not the letter that stands for water.
  static std::string spelled_out(std::string text) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 2> short_forms{
        {{"w/o", " without "}, {"w/", " with "}}};
    for (const auto& [form, words] : short_forms) {
      std::size_t at = text.find(form);
      while (at != std::string::npos) {
        const bool in_word = at > 0 && std::isalnum(static_cast<unsigned char>(text[at - 1])) != 0;
        const bool after_weighting = at > 1 && text[at - 2] == 't';  // "t1w/o fs"
        const bool stays = in_word && !after_weighting;
        if (!stays) text.replace(at, form.size(), words);
        at = text.find(form, at + (stays ? form.size() : words.size()));
      }
    }
    return text;
  }

  std::vector<std::string> words_;
};

/// Words that take back what follows them, as in "no fat sat".
const Words::Names negations{"no",   "non",  "not",   "without", "wo",
                             "ohne", "sans", "senza", "sin",     "zonder"};
/// Words after "fat" that say that its signal is suppressed.
const Words::Names suppression{"sat",  "sats",  "saturation",  "saturated", "sup",
                               "supp", "suppr", "suppression", "suppressed"};

enum class Weighting { unknown, t1, t2 };

Weighting weighting_by_times(double repetition_ms, double echo_ms) {
  constexpr double short_echo = 30, long_echo = 60, short_repetition = 1200;
  if (echo_ms >= long_echo) return Weighting::t2;
  if (echo_ms > 0 && echo_ms <= short_echo && repetition_ms > 0 &&
      repetition_ms <= short_repetition)
    return Weighting::t1;
  return Weighting::unknown;
}

/// Words after "water" that say that only water is excited, which suppresses fat.
const Words::Names excitation{"excitation", "exc", "selective"};

/// The same by the name of a series. Single letters mean water or fat only where a Dixon scan is named.
ScanContrast named_kind(const Words& name) {
  if (name.any({"sub", "subtr", "subtraction", "subtraktion", "subtracted"}))
    return ScanContrast::subtraction;
  if (name.any({"mip"})) return ScanContrast::projection;
  if (name.any({"dwi", "adc", "eadc", "diffusion", "resolve", "ep2d"}))
    return ScanContrast::diffusion;
  if (name.any({"map"})) return ScanContrast::map;
  const bool is_dixon = name.any({"dixon", "mdixon", "dix", "ideal", "flex"});
  if (name.any_but({"water"}, negations, excitation) || (is_dixon && name.any({"w"})))
    return ScanContrast::water;
  if (name.any({"outphase", "opposed", "opp"}) || name.in_row({"out"}, {"phase", "of"}) ||
      name.any_but({"op"}, {"post", "pre", "prae"}, {}) || (is_dixon && name.any({"out"})))
    return ScanContrast::opposed_phase;
  if (name.any({"inphase", "ip"}) || name.in_row({"in"}, {"phase"}) ||
      (is_dixon && name.any({"in"})))
    return ScanContrast::in_phase;
  if (name.any_but({"fat"}, negations, suppression) || (is_dixon && name.any({"f"})))
    return ScanContrast::fat;
  return ScanContrast::unknown;
}

/// Whether it is said not to be a magnitude where the type does not tell.
bool is_part_of_signal(const std::string& component) {
  return component == "PHASE" || component == "REAL" || component == "IMAGINARY";
}

/// What is made from other images, or shows a part of the signal.
ScanContrast derived_kind(const std::function<std::string(const char*)>& value, const Words& type,
                          const Words& description) {
  if (type.any({"projection image", "mip", "mpr", "minip", "max_ip", "min_ip", "mean_ip"}))
    return ScanContrast::projection;
  if (type.any({"p", "phase", "phase map", "r", "real", "i", "imaginary"}) &&
      !type.any({"m", "magnitude"}))
    return ScanContrast::phase;
  if (is_part_of_signal(value("0008|9208"))) return ScanContrast::phase;
  if (type.any({"sub", "subtraction", "subtracted"})) return ScanContrast::subtraction;
  if (type.any({"diffusion", "adc", "tracew", "trace"})) return ScanContrast::diffusion;
  if (type.any({"ff", "fat_fraction", "water_fraction", "r2_star", "t2_star", "quantity"}) ||
      type.any_ends("map"))
    return ScanContrast::map;
  if (type.any({"w", "water", "dixon_water"})) return ScanContrast::water;
  if (type.any({"f", "fat", "dixon_fat"})) return ScanContrast::fat;
  if (type.any({"ip", "in_phase", "inphase"})) return ScanContrast::in_phase;
  if (type.any({"op", "out_phase", "opp_phase", "outphase", "out_of_phase"}))
    return ScanContrast::opposed_phase;
  return named_kind(description);
}

bool is_fat_suppressed(const std::function<std::string(const char*)>& value,
                       const Words& description) {
  Words options;
  options.add_values(value("0018|0022"));
  options.add_values(value("0018|0021"));
  if (options.any({"fs", "fatsat", "fat sat", "spir", "spair", "fsat"})) return true;
  const std::string suppressed = lower_case(value("0018|9025"));  // enhanced objects
  if (suppressed.starts_with("fat")) return true;
  return description.any_but(
             {"fs", "fatsat", "spair", "spir", "stir", "tirm", "fatsup", "fsat", "we"}, negations,
             {}) ||
         description.in_row({"fat"}, suppression, negations) ||
         description.in_row({"water"}, excitation, negations);
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
  const ScanContrast kind = derived_kind(value, type, description);
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
