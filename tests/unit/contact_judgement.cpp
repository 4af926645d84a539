// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of a compression: every figure against its range, the balance of the plates.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "contact/grip.hpp"
#include "contact/judgement.hpp"

using namespace breast;

namespace {

/// A CC compression nobody would object to.
ContactRecord ordinary() {
  ContactRecord contact;
  contact.view = View::cc;
  contact.thickness_mm = 45;
  contact.reduction_percent = 48;
  for (const char* name : {"paddle", "detector"}) {
    PlateRecord plate;
    plate.name = name;
    plate.force_N = 100;
    plate.area_cm2 = 100;
    plate.mean_kPa = 10;
    plate.peak_kPa = 20;
    contact.plates.push_back(plate);
  }
  return contact;
}

/// In equilibrium with it: the wall carries the rest along the beam.
PressedState state_of(const ContactRecord& contact) {
  PressedState state;
  state.weight_N = Vec3(0, 0, -5);
  state.wall_reaction_N = Vec3(0, -100, contact.plates[0].force_N - contact.plates[1].force_N + 5);
  state.max_volume_error = 1e-12;
  state.places = {{Vec3(1, 2, 3), 40, 0.3}, {Vec3(4, 5, 6), 2.5, 0.3}};
  return state;
}

std::vector<std::string> doubts(const ContactRecord& contact) {
  std::vector<std::string> ids;
  for (const Judgement& j : judge_compression(contact, state_of(contact))) {
    if (j.doubtful) ids.push_back(j.id);
  }
  return ids;
}

using Ids = std::vector<std::string>;

}  // namespace

TEST(Judgement, OrdinaryCompressionIsNotDoubted) {
  const ContactRecord contact = ordinary();
  EXPECT_EQ(doubts(contact), Ids{});
  const std::vector<Judgement> all = judge_compression(contact, state_of(contact));
  Ids ids;
  for (const Judgement& j : all) {
    ids.push_back(j.id);
    EXPECT_FALSE(j.sentence.empty());
  }
  EXPECT_EQ(ids, (Ids{"paddle_force_within", "paddle_pressure_within", "detector_force_within",
                      "detector_pressure_within", "pressure_against_sensors", "thickness_within",
                      "penetration_within", "volume_kept", "paddle_presses_with_its_flat",
                      "detector_presses_with_its_flat", "plates_balanced"}));
}

TEST(Judgement, EachFigureOutsideItsRangeIsDoubted) {
  const auto with = [](const auto& change) {
    ContactRecord contact = ordinary();
    change(contact);
    return doubts(contact);
  };
  EXPECT_EQ(with([](ContactRecord& c) { c.plates[0].mean_kPa = 31; }),
            Ids{"paddle_pressure_above"});
  EXPECT_EQ(with([](ContactRecord& c) { c.plates[1].mean_kPa = 3; }),
            Ids{"detector_pressure_below"});
  EXPECT_EQ(with([](ContactRecord& c) { c.thickness_mm = 20; }), Ids{"thickness_below"});
  EXPECT_EQ(with([](ContactRecord& c) { c.thickness_mm = 100; }), Ids{"thickness_above"});
  EXPECT_EQ(with([](ContactRecord& c) { c.plates[1].worst_gap_mm = 0.2; }),
            Ids{"penetration_above"});
  EXPECT_EQ(with([](ContactRecord& c) {
              c.plates[0].force_N = std::numeric_limits<double>::quiet_NaN();
            }).front(),
            "paddle_force_above");
  EXPECT_EQ(with([](ContactRecord& c) { c.plates[0].force_N = c.plates[1].force_N = 20; }),
            (Ids{"paddle_force_below", "detector_force_below"}));
  // A search for 50 N may end at 49.8 N, one for 180 N at 180.5 N.
  EXPECT_EQ(with([](ContactRecord& c) { c.plates[0].force_N = c.plates[1].force_N = 180.5; }),
            Ids{});
  EXPECT_EQ(with([](ContactRecord& c) { c.plates[0].force_N = c.plates[1].force_N = 181.5; }),
            (Ids{"paddle_force_above", "detector_force_above"}));
  EXPECT_EQ(with([](ContactRecord& c) { c.plates[0].force_N = c.plates[1].force_N = 49.8; }),
            Ids{});
  EXPECT_EQ(with([](ContactRecord& c) { c.plates[0].force_N = c.plates[1].force_N = 49.5; }),
            (Ids{"paddle_force_below", "detector_force_below"}));
}

// A detector that squeezes tissue against the held cut: the paddle's force alone looks clinical.
TEST(Judgement, APlatePressingOnTheWallIsSaidWithThePlace) {
  ContactRecord contact = ordinary();
  contact.plates[0].force_N = 115;
  contact.plates[1].force_N = 21000;
  EXPECT_EQ(doubts(contact), (Ids{"detector_force_above", "plates_unbalanced"}));
  const std::vector<Judgement> all = judge_compression(contact, state_of(contact));
  const std::string& sentence = all.back().sentence;
  EXPECT_NE(sentence.find("21000 N"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("the detector presses on the chest wall or the cut"), std::string::npos)
      << sentence;
  EXPECT_NE(sentence.find("2.5 mm from the chest wall or cut"), std::string::npos) << sentence;
}

TEST(Judgement, WeightAloneIsNoImbalance) {
  ContactRecord contact = ordinary();
  contact.plates[1].force_N = 105;
  EXPECT_EQ(doubts(contact), Ids{});
  contact.plates[1].force_N = 140;
  EXPECT_EQ(doubts(contact), Ids{"plates_unbalanced"});
}

TEST(Judgement, AnEdgeThatCarriesMostOfTheForceIsDoubted) {
  const ContactRecord contact = ordinary();
  PressedState state = state_of(contact);
  state.places[1].edge_part = 0.8;
  Ids ids;
  for (const Judgement& j : judge_compression(contact, state)) {
    if (j.doubtful) ids.push_back(j.id);
  }
  EXPECT_EQ(ids, Ids{"detector_presses_with_its_edge"});
}

// What the plates of a machine must do: the same places as for any plates, but stricter.
TEST(Judgement, PlatesAtTheEdgeOfTheImageMustGripTheBreastAndShowIt) {
  ContactRecord contact = ordinary();
  contact.ends_image = true;
  PressedState usual = state_of(contact);
  usual.projected_cm2 = 130;
  usual.volume_in_front_percent = 70;
  usual.min_scaled_jacobian = 0.3;
  const auto with = [&](const auto& change) {
    PressedState state = usual;
    change(state);
    Ids ids;
    for (const Judgement& j : judge_compression(contact, state)) {
      if (!j.doubtful) continue;
      EXPECT_TRUE(j.decides) << j.id;
      ids.push_back(j.id);
    }
    return ids;
  };
  EXPECT_EQ(with([](PressedState&) {}), Ids{});
  EXPECT_EQ(with([](PressedState& s) { s.projected_cm2 = 260; }), Ids{"contact_too_small"});
  EXPECT_EQ(with([](PressedState& s) { s.places[1].edge_part = 0.45; }), Ids{"edge_carries_force"});
  EXPECT_EQ(with([](PressedState& s) { s.volume_in_front_percent = 50; }),
            Ids{"volume_in_image_below"});
  EXPECT_EQ(with([](PressedState& s) { s.min_scaled_jacobian = 0.05; }),
            Ids{"scaled_jacobian_below"});
  contact.view = View::mlo;
  EXPECT_EQ(with([](PressedState&) {}), Ids{"volume_in_image_below"});
}

TEST(Judgement, ForceOfTheClinicIsLessForASmallBreast) {
  const auto force = [](double projected_cm2) {
    const std::vector<CompressionStop> stops = clinical_stops(projected_cm2);
    EXPECT_EQ(stops[0].at, StopAt::force);
    EXPECT_EQ(stops[1].at, StopAt::thickness);
    EXPECT_EQ(stops[1].value, 35);
    return stops[0].value;
  };
  EXPECT_EQ(force(150), 110);
  EXPECT_NEAR(force(20), 80, 1e-12);
  EXPECT_EQ(force(10), 50);
  EXPECT_EQ(least_pressed_cm2(50), 25);
  EXPECT_NEAR(least_pressed_cm2(100), 40, 1e-12);
}

TEST(Judgement, ABreastThatTouchesItselfOrTheThoraxIsDoubted) {
  const ContactRecord contact = ordinary();
  PressedState state = state_of(contact);
  state.self = {0.2, 0.5};
  const auto doubted = [&](const std::string& id) {
    const std::vector<Judgement> all = judge_compression(contact, state);
    return std::any_of(all.begin(), all.end(),
                       [&](const Judgement& j) { return j.doubtful && j.id == id; });
  };
  EXPECT_FALSE(doubted("touches_itself"));
  EXPECT_FALSE(doubted("touches_thorax"));
  state.self = {2, 3};
  EXPECT_TRUE(doubted("touches_itself"));
  EXPECT_TRUE(doubted("touches_thorax"));
}

TEST(Judgement, AnIndefiniteWayToAStableEndIsNoDoubt) {
  PathResult path;
  EXPECT_TRUE(judge_path(path, true).empty());
  path.first_indefinite_thickness = 60;
  path.indefinite = 3;
  ASSERT_EQ(judge_path(path, true).size(), 1u);
  EXPECT_FALSE(judge_path(path, true)[0].doubtful);
  EXPECT_TRUE(judge_path(path, false)[0].doubtful);
  path.final_step.friction_lag = 0.1;
  path.jump = {{90, 110}};
  Ids ids;
  for (const Judgement& j : judge_path(path, true)) ids.push_back(j.id);
  EXPECT_EQ(ids, (Ids{"slips_or_buckles", "jump_at_target", "friction_lags"}));
}
