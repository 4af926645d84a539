// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/elementary.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace breast::elementary {

namespace {

using Extended = long double;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr Extended pi = 0xc90fdaa22168c235p-62L;
// The first parts have few enough bits that their product with a small integer is exact.
constexpr Extended ln2_high = 0x1.62e42fefap-1L, ln2_low = 0xe7bcd5e4f1d9cc02p-103L;
constexpr Extended half_pi_high = 0x1.921fb54442d18p0L, half_pi_low = 0x8d313198a2e03707p-117L;

int nearest(double x) {
  return int(x + (x < 0 ? -0.5 : 0.5));
}

// 1 + x/first (1 + x/(first + 1) (1 + ... x/last)), the exponential series from the back.
template <int first, int last>
constexpr Extended series(Extended x) {
  if constexpr (first > last) {
    return 1;
  } else {
    return 1 + x * (Extended(1) / first) * series<first + 1, last>(x);
  }
}

// 1 + q/3 + q^2/5 + ... (sign = 1: atanh(s)/s of q = s^2) or with
// alternating signs (-1: atan(s)/s).
template <int sign, int term, int last>
constexpr Extended odd_series(Extended q) {
  if constexpr (term == last) {
    return Extended(1) / (2 * last + 1);
  } else {
    return Extended(1) / (2 * term + 1) + sign * q * odd_series<sign, term + 1, last>(q);
  }
}

// The 128 parts of an octave: 2^(i/128).
constexpr int parts = 128;
constexpr auto powers_of_two = [] {
  std::array<Extended, parts> table{};
  for (int i = 0; i < parts; ++i)
    table[i] = series<1, 20>(i * (ln2_high / parts) + i * (ln2_low / parts));
  return table;
}();

// value * 2^n, n between -1100 and 1100.
double scaled(Extended value, int n) {
  if (n < -1000 || n > 1000) return std::ldexp(double(value), n);
  return double(value) * std::bit_cast<double>(std::uint64_t(n + 1023) << 52);
}

// e^x for |x| < 800. What follows the first power of `rest` is small enough for double.
double exp_of(Extended x) {
  const int n = nearest(double(x) * (1.4426950408889634 * parts));
  const Extended rest = (x - n * (ln2_high / parts)) - n * (ln2_low / parts);
  const double r = double(rest), q = r * r;
  const double higher =
      q * ((1.0 / 2 + r * (1.0 / 6)) + q * ((1.0 / 24 + r * (1.0 / 120)) + q * (1.0 / 720)));
  return scaled(powers_of_two[n & (parts - 1)] * (1 + (rest + higher)), n >> 7);
}

// j/256 between sqrt(1/2) and sqrt(2), by j - 181: reciprocal and logarithm.
constexpr int steps = 256, first_step = 181, last_step = 362;
struct LogStep {
  Extended reciprocal, log;
};
constexpr auto log_steps = [] {
  std::array<LogStep, last_step - first_step + 1> table{};
  for (int j = first_step; j <= last_step; ++j) {
    const Extended s = Extended(j - steps) / (j + steps);
    table[j - first_step] = {Extended(steps) / j, 2 * s * odd_series<1, 0, 14>(s * s)};
  }
  return table;
}();

// For 0 < x < infinity. What follows the second power of r is small enough for double.
Extended log_of(double x) {
  int exponent = 0;
  if (x < 0x1p-1022) x *= 0x1p60, exponent = -60;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  exponent += int(bits >> 52) - 1022;
  double mantissa = std::bit_cast<double>((bits & 0xfffffffffffffu) | 0x3fe0000000000000u);
  if (mantissa < 0.7071067811865476) mantissa *= 2, --exponent;
  const int j = nearest(mantissa * steps);
  const LogStep& step = log_steps[j - first_step];
  const Extended r = (mantissa - Extended(j) / steps) * step.reciprocal;
  const double d = double(r), q = d * d;
  const double higher =
      d * q *
      ((1.0 / 3 - d * (1.0 / 4)) + q * ((1.0 / 5 - d * (1.0 / 6)) + q * (1.0 / 7 - d * (1.0 / 8))));
  return exponent * ln2_high + (exponent * ln2_low + (step.log + (r - (r * r / 2 - higher))));
}

// Product of (1 - q/(k (k + 1))) ..., k = first, first + 2, ...: sine (from 2) and cosine (from 1).
template <int first, int last>
Extended wave_series(Extended q) {
  if constexpr (first > last) {
    return 1;
  } else {
    return 1 - q * (Extended(1) / (first * (first + 1))) * wave_series<first + 2, last>(q);
  }
}

struct Wave {
  Extended sine, cosine;
};

Wave wave(double x) {
  if (!(std::abs(x) < 1e9)) return {not_a_number, not_a_number};
  const int quarter = nearest(x * 0.6366197723675814);
  const Extended rest = (x - quarter * half_pi_high) - quarter * half_pi_low, q = rest * rest;
  const Extended sine = rest * wave_series<2, 22>(q), cosine = wave_series<1, 21>(q);
  switch (quarter & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

Extended small_atan(Extended t) {  // |t| < 1/4
  return t * odd_series<-1, 0, 16>(t * t);
}

// For x >= 0, infinity included.
Extended atan_of(Extended x) {
  constexpr Extended atan_half = 0xed63382b0dda7b45p-65L;
  if (x > 1) return pi / 2 - atan_of(1 / x);
  if (x > 0.75L) return pi / 4 + small_atan((x - 1) / (x + 1));
  if (x > 0.25L) return atan_half + small_atan((x - 0.5L) / (1 + 0.5L * x));
  return small_atan(x);
}

}  // namespace

double exp(double x) {
  if (std::isnan(x)) return x;
  if (x > 710) return infinity;
  if (x < -746) return 0;
  return exp_of(x);
}

double log(double x) {
  if (std::isnan(x) || x == infinity) return x;
  if (x <= 0) return x == 0 ? -infinity : not_a_number;
  return double(log_of(x));
}

double pow(double x, double y) {
  if (y == 0) return 1;
  if (!(x >= 0) || std::isnan(y)) return not_a_number;
  if (x == 0) return y > 0 ? 0 : infinity;
  if (x == infinity) return y > 0 ? infinity : 0;
  // Ellipses instead of superellipses: these two are exact and the same on every processor, too.
  if (y == 1) return x;
  if (y == 0.5) return std::sqrt(x);
  const Extended power = y * log_of(x);
  if (power > 710) return infinity;
  if (power < -746) return 0;
  return exp_of(power);
}

double sin(double x) {
  return double(wave(x).sine);
}

double cos(double x) {
  return double(wave(x).cosine);
}

double tan(double x) {
  const Wave at = wave(x);
  return double(at.sine / at.cosine);
}

double atan(double x) {
  if (std::isnan(x)) return x;
  return x < 0 ? -double(atan_of(-x)) : double(atan_of(x));
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return not_a_number;
  if (x == 0 && y == 0) return 0;
  const Extended across = std::abs(Extended(y)), along = std::abs(Extended(x));
  const Extended acute =
      across > along ? pi / 2 - atan_of(along / across) : atan_of(across / along);
  const Extended angle = x < 0 ? pi - acute : acute;
  return y < 0 ? -double(angle) : double(angle);
}

double acos(double x) {
  if (!(x >= -1 && x <= 1)) return not_a_number;
  const Extended c = x, s = std::sqrt((1 - c) * (1 + c));
  const Extended acute =
      std::abs(c) > s ? atan_of(s / std::abs(c)) : pi / 2 - atan_of(std::abs(c) / s);
  return double(x < 0 ? pi - acute : acute);
}

}  // namespace breast::elementary
