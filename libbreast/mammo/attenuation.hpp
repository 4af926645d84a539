// Linear attenuation of breast tissues, and what a mammogram's `path` is made of.
#pragma once

#include <string>
#include <vector>

namespace breast {

/// mm of each tissue along one ray.
struct TissuePath {
  double fat = 0, fibroglandular = 0, skin = 0, tumour = 0;
  double total() const { return fat + fibroglandular + skin + tumour; }
};

/// Linear attenuation coefficients in 1/mm at one energy.
struct Attenuation {
  double fat = 0, fibroglandular = 0, skin = 0, tumour = 0;
};
/// Means of Johns and Yaffe, Phys. Med. Biol. 32 (1987) 675–695, for fat, fibroglandular tissue and
/// infiltrating ductal carcinoma, 18–50 keV, interpolated linearly in log energy and log
/// coefficient; skin is 1.064 times fibroglandular (ratio at 20 keV of the elemental compositions
/// of Hammerstein et al., Radiology 130 (1979) 485–491). Published values for fat differ by tens of
/// per cent. Throws Error (input) outside 18–50 keV.
Attenuation attenuation_at(double kev);

/// How a ray's tissue becomes one number.
class Energy {
 public:
  /// "fraction": mm of fibroglandular-equivalent tissue, fat counting half (the grey of
  /// Pathmanathan et al. 2008, chosen from the proportions of fat, fibroglandular tissue and air in
  /// a column); a number: monoenergetic line integral at that many keV; anything else: a spectrum
  /// file, TSV with columns energy_keV and weight, path = −ln of the weighted mean transmission.
  static Energy parse(const std::string& text);

  double path(const TissuePath& mm) const;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  std::vector<double> weights_;  ///< empty for "fraction"; sum 1
  std::vector<Attenuation> attenuation_;
};

}  // namespace breast
