// SPDX-License-Identifier: GPL-3.0-or-later
// Elementary functions with results that are bitwise identical on every x86-64 processor.
//
// The C library selects its exp, log, pow, sin, cos, tan, atan, acos ... according to the
// processor: the last bit differs with and without fused multiply-add, which is enough for a voxel
// to change its label. The functions here are a fixed sequence of additions, multiplications and
// divisions in long double, except for the small last terms of a series: the x87 unit rounds them
// in the same way on every processor and has no vector or fused form. Its 64 bits leave the result
// within 0.51 units in the last place of the exact value (pow: 0.65 where y log x is in the
// hundreds).
//
// Image and geometry stages use only these functions. std::sqrt, floor, hypot and cbrt are safe:
// they are exact or have one version.
#pragma once

namespace breast::elementary {

/// 0 below about -745, infinity above about 709.8, NaN of NaN.
double exp(double x);
/// Natural logarithm: -infinity of 0, NaN below.
double log(double x);
/// x to the power of y for x >= 0; 1 for y = 0, else NaN for x < 0.
double pow(double x, double y);
/// Angles in radians, at most 1000 in size: beyond that accuracy is lost slowly.
double sin(double x);
double cos(double x);
double tan(double x);
/// In [-pi/2, pi/2].
double atan(double x);
/// In [-pi, pi]: the angle of (x, y) from the x axis; 0 of (0, 0).
double atan2(double y, double x);
/// In [0, pi]; NaN outside [-1, 1].
double acos(double x);

}  // namespace breast::elementary
