// SPDX-License-Identifier: GPL-3.0-or-later
// What makes a state between plates a compression: the target of one that is given none, and whether
// the plates grip the breast.
#pragma once

#include <vector>

#include "contact/judgement.hpp"
#include "contact/path/target.hpp"
#include "mesh/contact_record.hpp"

namespace breast {

/// The targets of a compression that is given none, the first of which is reached ends it: a paddle
/// force of 110 N, less for a breast that is small in the image, or a thickness of 35 mm. Screening
/// programmes press with 116 N in the mean (Norway, centres 91-147); a small breast is given less,
/// because pressure is what hurts (de Groot 2013): 4 N for each cm2 that its
/// stress-free shape covers in the image, `projected_cm2`, but at least 50 N.
std::vector<CompressionStop> clinical_stops(double projected_cm2);

/// Smallest area (cm²) over which a mean pressure is a target between plates that are placed by the
/// edge of the image: 25 cm², and 40 % of the breast's projection.
double least_pressed_cm2(double projected_cm2);

/// One statement on the grip of plates that are placed by the edge of the image ("gripped"), or a doubt
/// for each reason why they do not grip: they touch less than 40 % of the breast's projection
/// ("contact_too_small"), or the rounded edge of one carries 40 % of its force or more
/// ("edge_carries_force").
std::vector<Judgement> judge_grip(const ContactRecord& contact, const PressedState& state);

}  // namespace breast
