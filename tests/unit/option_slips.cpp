// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers in another unit than asked for: refused with the number that was likely meant.
#include <gtest/gtest.h>

#include <functional>

#include "contact/options.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "meshing/skin.hpp"

namespace breast {
namespace {

std::string refusal(const std::function<void()>& parse) {
  try {
    parse();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 2);
    return error.what();
  }
  return "accepted";
}

TEST(OptionSlips, AReductionAsAFraction) {
  const auto reduced = [](double percent) {
    CompressionChoices choices;
    choices.reduction = percent;
    return refusal([&] { compression_options(choices, posture_gravity(Posture::upright)); });
  };
  EXPECT_NE(reduced(0.5).find("did you mean 50?"), std::string::npos) << reduced(0.5);
  EXPECT_EQ(reduced(1), "accepted");
  EXPECT_EQ(reduced(50), "accepted");
}

TEST(OptionSlips, ASkinInMetresOrMicrometres) {
  const auto skin = [](const char* text) { return refusal([&] { parse_skin_thickness(text); }); };
  EXPECT_NE(skin("0.00145").find("did you mean 1.45?"), std::string::npos) << skin("0.00145");
  EXPECT_NE(skin("1450").find("did you mean 1.45?"), std::string::npos) << skin("1450");
  EXPECT_NE(skin("0.02").find("from 0.1 to 10"), std::string::npos);
  for (const char* fine : {"0", "0.1", "0.5", "1.45", "10"})
    EXPECT_EQ(skin(fine), "accepted") << fine;
}

}  // namespace
}  // namespace breast
