#include "contact/options.hpp"

#include <limits>

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

double parse_detector(const std::string& text) {
  if (text == "raised") return std::numeric_limits<double>::infinity();
  if (text == "fixed") return 0;
  const std::optional<double> rise = number_in(text);
  if (rise && *rise >= 0) return *rise;
  throw input_error("--detector ", text, ": give 'raised', 'fixed' or a rise in mm, 0 or more");
}

int CompressionChoices::targets() const {
  return int(thickness.has_value()) + int(reduction.has_value()) + int(force.has_value()) +
         int(pressure.has_value());
}

CompressionOptions compression_options(const CompressionChoices& c, const Vec3& gravity) {
  constexpr double least_reduction = 1;  // percent; a smaller number is a fraction, not a percentage
  if (c.reduction && *c.reduction < least_reduction) {
    throw input_error("--reduction ", *c.reduction, " percent is below ", least_reduction,
                      "; did you mean ", 100 * *c.reduction,
                      "? (for a smaller one give the gap in mm, --thickness)");
  }
  CompressionOptions options;
  options.view = view_named(c.view);
  options.angle_deg = c.angle.value_or(view_angle_deg(options.view));
  options.plates = c.plates;
  options.plates.detector_rise = parse_detector(c.detector);
  options.friction = c.friction;
  options.gravity = gravity;
  options.path.longest_step = c.plate_step.value_or(0);
  options.path.first_step = c.plate_step.value_or(0);
  options.method =
      c.contact == "al" ? ContactMethod::augmented_lagrangian : ContactMethod::active_set;
  const auto stop = [&](const std::optional<double>& value, StopAt at) {
    if (!value) return;
    options.stop_at = at;
    options.target = *value;
  };
  stop(c.thickness, StopAt::thickness);
  stop(c.reduction, StopAt::reduction);
  stop(c.force, StopAt::force);
  stop(c.pressure, StopAt::pressure);
  return options;
}

}  // namespace breast
