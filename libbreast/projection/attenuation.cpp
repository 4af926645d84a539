// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection/attenuation.hpp"

#include <cmath>

namespace breast {

Energy::Energy(std::string name, const std::vector<double>& weights,
               const std::vector<Attenuation>& attenuation)
    : name_(std::move(name)) {
  const auto n = Eigen::Index(weights.size());
  for (auto* list : {&weights_, &fat_, &fibroglandular_, &skin_, &tumour_}) list->resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Attenuation& mu = attenuation[std::size_t(i)];
    weights_[i] = float(weights[std::size_t(i)]);
    fat_[i] = float(mu.fat);
    fibroglandular_[i] = float(mu.fibroglandular);
    skin_[i] = float(mu.skin);
    tumour_[i] = float(mu.tumour);
  }
  weights_ /= weights_.sum();
}

double Energy::path(const TissuePath& mm) const {
  constexpr double fat_weight = 0.5;
  const double watery = mm.fibroglandular + mm.muscle;
  if (weights_.size() == 0) return fat_weight * mm.fat + watery + mm.skin + mm.tumour;
  const auto exponent = float(mm.fat) * fat_ + float(watery) * fibroglandular_ +
                        float(mm.skin) * skin_ + float(mm.tumour) * tumour_;
  if (weights_.size() == 1) return exponent.sum();
  // Relative to the best transmitted energy, so that no thickness underflows.
  const float least = exponent.minCoeff();
  return least - std::log((weights_ * (least - exponent).exp()).sum());
}

}  // namespace breast
