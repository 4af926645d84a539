// SPDX-License-Identifier: GPL-3.0-or-later
// The mammographic views and their names in files, reports and tables.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace breast {

/// Craniocaudal, mediolateral oblique, mediolateral.
enum class View : std::uint8_t { cc, mlo, ml };

/// "CC", "MLO" or "ML", as in files, reports, captions and on the command line.
std::string view_name(View view);
/// "cc", "mlo" or "ml", as in names of table columns and postures.
std::string view_column(View view);
/// Inverse of view_name; no value for any other text.
std::optional<View> view_from_name(std::string_view name);
/// The same; throws Error (input) naming the choices.
View view_named(std::string_view name);

/// Default beam angle in degrees from craniocaudal: CC 0, MLO 45, ML 90.
double view_angle_deg(View view);

}  // namespace breast
