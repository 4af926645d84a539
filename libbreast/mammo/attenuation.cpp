#include "mammo/attenuation.hpp"

#include <array>
#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

namespace {

constexpr double fat_weight = 0.5;
constexpr double skin_over_fibroglandular = 1.064;

struct Row {
  double kev, fat, fibroglandular, carcinoma;  // 1/cm
};
constexpr std::array<Row, 6> johns_yaffe = {{{18, 0.558, 1.028, 1.085},
                                             {20, 0.456, 0.802, 0.844},
                                             {25, 0.322, 0.506, 0.529},
                                             {30, 0.264, 0.378, 0.392},
                                             {40, 0.215, 0.273, 0.281},
                                             {50, 0.194, 0.233, 0.238}}};
constexpr double per_mm = 0.1;

double exponent(const Attenuation& mu, const TissuePath& mm) {
  return mu.fat * mm.fat + mu.fibroglandular * mm.fibroglandular + mu.skin * mm.skin +
         mu.tumour * mm.tumour;
}

}  // namespace

Attenuation attenuation_at(double kev) {
  if (!(kev >= johns_yaffe.front().kev && kev <= johns_yaffe.back().kev)) {
    throw input_error("energy ", kev, " keV: outside ", johns_yaffe.front().kev, "-",
                      johns_yaffe.back().kev, " keV, the range of the attenuation table");
  }
  std::size_t i = 0;
  while (i + 2 < johns_yaffe.size() && johns_yaffe[i + 1].kev < kev) ++i;
  const Row &low = johns_yaffe[i], &high = johns_yaffe[i + 1];
  const double f = std::log(kev / low.kev) / std::log(high.kev / low.kev);
  const auto mix = [f](double a, double b) { return per_mm * std::pow(a, 1 - f) * std::pow(b, f); };
  Attenuation mu;
  mu.fat = mix(low.fat, high.fat);
  mu.fibroglandular = mix(low.fibroglandular, high.fibroglandular);
  mu.skin = skin_over_fibroglandular * mu.fibroglandular;
  mu.tumour = mix(low.carcinoma, high.carcinoma);
  return mu;
}

Energy Energy::parse(const std::string& text) {
  Energy energy;
  energy.name_ = text;
  if (text == "fraction") return energy;
  if (text.find_first_not_of("0123456789.eE+-") == std::string::npos) {
    const double kev = parse_number(text, "--energy");
    energy.name_ = format_number(kev) + " keV";
    energy.weights_ = {1};
    energy.attenuation_ = {attenuation_at(kev)};
    return energy;
  }
  if (!std::filesystem::is_regular_file(text)) {
    throw input_error("--energy ", text,
                      ": not \"fraction\", not a number of keV, and no such file");
  }
  const Table table = read_table(text);
  const int kev = table.column("energy_keV"), weight = table.column("weight");
  double sum = 0;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string where = text + ", row " + std::to_string(r + 1);
    const double w = parse_number(table.rows[r][std::size_t(weight)], where);
    if (!(w >= 0)) throw input_error(where, ": weight ", w, " is negative");
    energy.attenuation_.push_back(
        attenuation_at(parse_number(table.rows[r][std::size_t(kev)], where)));
    energy.weights_.push_back(w);
    sum += w;
  }
  if (!(sum > 0)) throw input_error(text, ": no weight above 0");
  for (double& w : energy.weights_) w /= sum;
  energy.name_ = std::filesystem::path(text).filename().string();
  return energy;
}

double Energy::path(const TissuePath& mm) const {
  if (weights_.empty()) return fat_weight * mm.fat + mm.fibroglandular + mm.skin + mm.tumour;
  if (weights_.size() == 1) return exponent(attenuation_[0], mm);
  double transmission = 0;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    transmission += weights_[i] * std::exp(-exponent(attenuation_[i], mm));
  }
  return -std::log(transmission);
}

}  // namespace breast
