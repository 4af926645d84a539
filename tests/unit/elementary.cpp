// SPDX-License-Identifier: GPL-3.0-or-later
// Elementary functions against the C library's, at special values, and bit for bit.
#include "core/elementary.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

namespace breast {
namespace {

using Function = double (*)(double);
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Case {
  const char* name;
  Function ours, library;
  double low, high;
  std::uint64_t bits;  ///< of all values together: the same on every processor
};

double ours_power(double x) {
  return elementary::pow(x, 1.7);
}
double library_power(double x) {
  return std::pow(x, 1.7);
}
double ours_angle(double x) {
  return elementary::atan2(x, -0.7);
}
double library_angle(double x) {
  return std::atan2(x, -0.7);
}

const std::vector<Case> cases = {
    {"exp", elementary::exp, std::exp, -700, 700, 0x8f496adce2f8554eu},
    {"exp near 0", elementary::exp, std::exp, -1, 1, 0x558ded327c78481u},
    {"log", elementary::log, std::log, 1e-3, 1e5, 0xf2efa1b785b6af19u},
    {"log near 1", elementary::log, std::log, 0.9, 1.1, 0x9d40992751569240u},
    {"pow", ours_power, library_power, 0, 3000, 0x329d975f74cd874du},
    {"sin", elementary::sin, std::sin, -40, 40, 0xe3676979af2d707au},
    {"cos", elementary::cos, std::cos, -1000, 1000, 0x1fc6469cb415bcfbu},
    {"tan", elementary::tan, std::tan, -1.57, 1.57, 0xe7071d9cba741a31u},
    {"atan", elementary::atan, std::atan, -30, 30, 0xbd57fb672d238e6au},
    {"atan2", ours_angle, library_angle, -2, 2, 0xf89c77570a8a74fu},
    {"acos", elementary::acos, std::acos, -1, 1, 0xb98d6a88f7b29835u},
};

double unit_in_last_place(double value) {
  const double size = std::abs(value);
  return std::nextafter(size, infinity) - size;
}

TEST(Elementary, WithinOneUnitOfTheLibrarysLastPlace) {
  constexpr int n = 20001;
  for (const Case& c : cases) {
    std::uint64_t bits = 1469598103934665603u;
    for (int i = 0; i < n; ++i) {
      const double x = c.low + (c.high - c.low) * i / (n - 1), ours = c.ours(x),
                   other = c.library(x);
      ASSERT_LE(std::abs(ours - other), unit_in_last_place(other)) << c.name << " of " << x;
      bits = (bits ^ std::bit_cast<std::uint64_t>(ours)) * 1099511628211u;
    }
    EXPECT_EQ(bits, c.bits) << c.name;
  }
}

TEST(Elementary, SpecialValues) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(elementary::exp(0), 1);
  EXPECT_EQ(elementary::exp(1000), infinity);
  EXPECT_EQ(elementary::exp(-infinity), 0);
  EXPECT_TRUE(std::isnan(elementary::exp(nan)));
  EXPECT_EQ(elementary::log(1), 0);
  EXPECT_EQ(elementary::log(0), -infinity);
  EXPECT_EQ(elementary::log(infinity), infinity);
  EXPECT_TRUE(std::isnan(elementary::log(-1)));
  EXPECT_EQ(elementary::pow(0, 0), 1);
  EXPECT_EQ(elementary::pow(0, 2), 0);
  EXPECT_EQ(elementary::pow(2, 10), 1024);
  for (const double x : {1e-300, 0.1, 2.0 / 3, 1.7, 12345.678, 1e200}) {
    EXPECT_EQ(elementary::pow(x, 1), x);
    EXPECT_EQ(elementary::pow(x, 0.5), std::sqrt(x));
    EXPECT_NEAR(elementary::pow(x, 0.5) / elementary::pow(x, std::nextafter(0.5, 1)), 1, 1e-12);
  }
  EXPECT_EQ(elementary::pow(2, 2000), infinity);
  EXPECT_TRUE(std::isnan(elementary::pow(-2, 0.5)));
  EXPECT_EQ(elementary::sin(0), 0);
  EXPECT_EQ(elementary::cos(0), 1);
  EXPECT_EQ(elementary::sin(std::numbers::pi), std::sin(std::numbers::pi));
  EXPECT_TRUE(std::isnan(elementary::sin(infinity)));
  EXPECT_EQ(elementary::atan(infinity), std::numbers::pi / 2);
  EXPECT_EQ(elementary::atan2(0, -1), std::numbers::pi);
  EXPECT_EQ(elementary::atan2(-1, 0), -std::numbers::pi / 2);
  EXPECT_EQ(elementary::atan2(0, 0), 0);
  EXPECT_EQ(elementary::acos(1), 0);
  EXPECT_EQ(elementary::acos(-1), std::numbers::pi);
  EXPECT_TRUE(std::isnan(elementary::acos(1.5)));
}

}  // namespace
}  // namespace breast
