// SPDX-License-Identifier: GPL-3.0-or-later
// Small helpers that all libraries share: median and percentile, words and lower case.
#include <gtest/gtest.h>

#include <cmath>

#include "core/statistics/percentile.hpp"
#include "core/text/library_message.hpp"
#include "core/text/lower_case.hpp"
#include "fixtures/words.hpp"

namespace breast {
namespace {

TEST(Median, IsTheUpperOfTwoMiddleValues) {
  EXPECT_EQ(median(std::vector<double>{4, 1, 3, 2}), 3);
  EXPECT_EQ(median(std::vector<float>{5, 1, 3}), 3);
}

TEST(Median, OfNothingIsTheFallback) {
  EXPECT_TRUE(std::isnan(median(std::vector<double>{})));
  EXPECT_EQ(median(std::vector<double>{}, 7), 7);
}

TEST(Percentile, IsAValueOfTheRankRoundedDown) {
  const std::vector<double> values{4, 1, 3, 2};
  EXPECT_EQ(percentile(values, 0), 1);
  EXPECT_EQ(percentile(values, 0.5), 2);
  EXPECT_EQ(percentile(values, 0.9), 3);
  EXPECT_EQ(percentile(values, 1), 4);
  EXPECT_EQ(percentile(std::vector<double>{}, 0.5, 7), 7);
}

TEST(LowerCase, ChangesLettersOfAsciiOnly) {
  EXPECT_EQ(lower_case("SCAN.Nii.GZ"), "scan.nii.gz");
  EXPECT_EQ(lower_case("\xC3\x84"), "\xC3\x84");
}

TEST(LibraryMessage, NamesNoPlaceInMemory) {
  EXPECT_EQ(library_message(
                "itk::ERROR: itk::ERROR: NrrdImageIO(0x55d1a0):\n ReadImageInformation:  failed "),
            "ReadImageInformation: failed");
  EXPECT_EQ(library_message("itk::ERROR: Filter (0x7f12ab): Input 0x7f12abcd is not set"),
            "Input ? is not set");
}

TEST(Words, AreSeparatedByBlanksTabsAndLineBreaks) {
  EXPECT_EQ(words_of(" a\tb\n c "), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_TRUE(words_of(" \t").empty());
}

}  // namespace
}  // namespace breast
