// SPDX-License-Identifier: GPL-3.0-or-later
// Options of compression from their text: plates as in the clinic and as before.
#include "contact/options.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace breast {
namespace {

CompressionOptions options_of(const CompressionChoices& choices) {
  return compression_options(choices, Vec3(0, 0, -9810));
}

TEST(ContactOptions, PlatesStandAsBeforeWithoutAnImageEdge) {
  CompressionChoices choices;
  choices.reduction = 50;
  const CompressionOptions options = options_of(choices);
  EXPECT_EQ(options.method, ContactMethod::active_set);
  EXPECT_EQ(options.positioning, Positioning::hanging);
  EXPECT_EQ(options.plates.edge_radius, 15);
  EXPECT_EQ(options.plates.turn_deg, 0);
  EXPECT_EQ(options.friction, 0);
  EXPECT_FALSE(options.plates.image_edge);
}

TEST(ContactOptions, AnImageEdgeBringsTheClinicsPlates) {
  CompressionChoices choices;
  choices.reduction = 50;
  choices.image_edge = "auto";
  const CompressionOptions cc = options_of(choices);
  EXPECT_EQ(cc.method, ContactMethod::surface);
  EXPECT_EQ(cc.positioning, Positioning::lifted);
  EXPECT_EQ(cc.plates.edge_radius, 3);
  EXPECT_FALSE(cc.plates.turn_deg);
  EXPECT_FALSE(cc.plates.lean_deg);
  EXPECT_FALSE(cc.plates.bend_deg);
  EXPECT_EQ(cc.plates.most_turn_deg, 15);
  EXPECT_EQ(cc.plates.image_edge, 5);
  EXPECT_EQ(cc.plates.farthest_image_edge, 10);
  EXPECT_EQ(cc.friction, 0.3);
  EXPECT_EQ(cc.pull_N, 30);
  choices.view = "MLO";
  EXPECT_FALSE(options_of(choices).plates.bend_deg);
  EXPECT_EQ(options_of(choices).plates.image_edge, 0);
  choices.view = "ML";
  EXPECT_EQ(options_of(choices).plates.bend_deg, 0) << "about her long axis she turns";
  choices.view = "MLO";
  // A layer of muscle is in the oblique image.
  EXPECT_EQ(compression_options(choices, Vec3::Zero(), {.muscle_mm = 10}).plates.image_edge, -12.5);
}

TEST(ContactOptions, ABreastThatSlidesIsPlacedAsInTheClinicUnlessAStandoffIsGiven) {
  CompressionChoices choices;
  choices.reduction = 50;
  const CompressedBody sliding{.slides = true};
  EXPECT_EQ(compression_options(choices, Vec3::Zero(), sliding).plates.image_edge, 5);
  EXPECT_EQ(compression_options(choices, Vec3::Zero(), sliding).pull_N, 30);
  choices.plates.standoff = 10;
  EXPECT_FALSE(compression_options(choices, Vec3::Zero(), sliding).plates.image_edge);
  EXPECT_EQ(compression_options(choices, Vec3::Zero(), sliding).friction, 0);
}

TEST(ContactOptions, WhatIsGivenWins) {
  CompressionChoices choices;
  choices.reduction = 50;
  choices.image_edge = "7.5";
  choices.turn = "-10";
  choices.lean = "6";
  choices.bend = "4";
  choices.edge_radius = 5;
  choices.friction = 0;
  choices.positioning = "hanging";
  choices.contact_points = "nodes";
  const CompressionOptions options = options_of(choices);
  EXPECT_EQ(options.method, ContactMethod::active_set);
  EXPECT_EQ(options.positioning, Positioning::hanging);
  EXPECT_EQ(options.plates.edge_radius, 5);
  EXPECT_EQ(options.plates.turn_deg, -10);
  EXPECT_EQ(options.plates.lean_deg, 6);
  EXPECT_EQ(options.plates.bend_deg, 4);
  EXPECT_EQ(options.plates.image_edge, 7.5);
  EXPECT_FALSE(options.plates.farthest_image_edge) << "a stated place stays";
  EXPECT_EQ(options.friction, 0);
  // Nothing would hold a breast that was pulled.
  EXPECT_EQ(options.pull_N, 0);
}

TEST(ContactOptions, ContradictionsAndOtherTextAreRefused) {
  CompressionChoices both;
  both.image_edge = "5";
  both.plates.standoff = 5;
  EXPECT_THROW(options_of(both), Error);
  CompressionChoices lagrangian;
  lagrangian.contact = "al";
  lagrangian.contact_points = "surface";
  EXPECT_THROW(options_of(lagrangian), Error);
  for (const char* text : {"", "near", "1e9", "nan", "5 mm"}) {
    EXPECT_THROW(parse_image_edge(text, View::cc, 0), Error) << text;
    EXPECT_THROW(parse_turn(text), Error) << text;
  }
}

}  // namespace
}  // namespace breast
