// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/contrast/refusals.hpp"

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

std::string refusal_of_suppressed(const SuppressedFat& fat, const FatContrast& shown) {
  const std::string reason = refusal_of(fat);
  const double evidence = saturation_evidence(shown);
  if (!reason.empty() || !(evidence > most_evidence)) return reason;
  return message("what is dark does not lie as fat does (evidence ", format_fixed(evidence, 1),
                 ", at most ", most_evidence, ")");
}

std::string ways_out(bool half_of_dixon, bool by_wall) {
  return message(ways_out_begin,
                 half_of_dixon ? "the water image as MR and the fat image as --fat, " : "",
                 "a T1 series without fat saturation as MR or beside this one (--also), ",
                 by_wall ? "the chest wall (--chest-wall), " : "",
                 "or --contrast fat-bright if fat is bright");
}

std::string refusal_of_both(const std::string& bright, bool half, const std::string& suppressed,
                            DarkFat found) {
  if (bright == suppressed) return bright + ways_out(half);
  if (half && found == DarkFat::suppressed)
    return "fat is suppressed in this scan, and " + suppressed + ways_out(false);
  return bright + "; as a scan with suppressed fat: " + suppressed +
         ways_out(half || found == DarkFat::silent, !half || found == DarkFat::silent);
}

}  // namespace breast
