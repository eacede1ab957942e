/// How dither acts on the sensor calibrated on the example recordings.
#include "spoolflow/analysis/dither_study.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::analysis {
namespace {

const model::Model& dithered_model() {
  static const model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  return model;
}

DitherPoint held_in_the_middle() {
  const model::Model& model = dithered_model();
  const auto point =
      dither_point(model, {0.5 * model.valve.stroke_m, 40e5, uncertainty::map_temperature_K(model), true});
  EXPECT_TRUE(point);
  return *point;
}

DitherQuestion few_settings() {
  DitherQuestion question;
  question.points.positions_percent = {40, 80};
  question.amplitudes = 11;
  question.frequencies = 4;
  return question;
}

DitherStudy studied(const DitherQuestion& question) {
  return dither_study(dithered_model(), question, 2);
}

TEST(Dither, HoldsThePointAgainstSpringAndFlowForce) {
  const DitherPoint point = held_in_the_middle();
  const auto& valve = dithered_model().observer->parameters;
  const auto edge = valve.edge.at(point.point.oil_temperature_K, 40e5, point.point.position_m);
  sensor::ActuatorState<double> state;
  const auto held =
      sensor::step(valve.actuator, state, {1e-3, point.current_A, NAN, point.point.position_m, NAN}, true);
  EXPECT_NEAR(held.magnetic_force_N, valve.spring.at(point.point.position_m).value + edge.flow_force_N, 1e-6);
  EXPECT_GT(point.sticking_N, point.sliding_N) << "contacts grow stronger at rest";
}

TEST(Dither, MoreAmplitudeNeverWidensTheBandAndNeverCalmsTheForce) {
  const DitherStudy study = studied(few_settings());
  ASSERT_GE(study.points.size(), 4U);
  for (const auto& effects : study.effects) {
    for (std::size_t f = 0; f < study.frequency_Hz.size(); ++f) {
      for (std::size_t a = 1; a < study.amplitude_A.size(); ++a) {
        const DitherEffect& less = effects[study.place(a - 1, f)];
        const DitherEffect& more = effects[study.place(a, f)];
        EXPECT_LE(more.band_m3_per_s, less.band_m3_per_s);
        EXPECT_GE(more.half_swing_N, less.half_swing_N);
      }
    }
    const DitherEffect& slow_and_large = effects[study.place(study.amplitude_A.size() - 1, 0)];
    EXPECT_LT(slow_and_large.band_m3_per_s, 0.9 * effects.front().band_m3_per_s) << "dither is of use at all";
  }
}

TEST(Dither, HigherFrequencyNeedsMoreAmplitudeForTheSameSwing) {
  const DitherPoint point = held_in_the_middle();
  double swing_before_N = 1e9;
  for (const double frequency_Hz : {60.0, 120.0, 180.0, 250.0}) {
    const double swing_N = dither_effect(dithered_model(), point, 0.2, frequency_Hz, DitherShape::sine).half_swing_N;
    EXPECT_LT(swing_N, swing_before_N) << "eddy currents keep the flux from following";
    swing_before_N = swing_N;
  }
}

TEST(Dither, WithoutAmplitudeTheBandIsThatOfFrictionAndMaps) {
  const DitherPoint point = held_in_the_middle();
  for (const double frequency_Hz : {60.0, 250.0}) {
    const DitherEffect effect = dither_effect(dithered_model(), point, 0, frequency_Hz, DitherShape::square);
    EXPECT_NEAR(effect.half_swing_N, 0, 1e-3);
    EXPECT_DOUBLE_EQ(effect.band_N, point.sticking_N + point.maps_N);
    EXPECT_NEAR(effect.motion_m, 0, 1e-9);
  }
}

TEST(Dither, TheSpoolGivesWayElasticallyUpToFrictionAndMovesBeyond) {
  const DitherPoint point = held_in_the_middle();
  const double stiffness = dithered_model().observer->parameters.friction.contact_stiffness_N_per_m;
  bool held = false, freed = false;
  for (double amplitude_A = 0.05; amplitude_A < 0.6; amplitude_A += 0.05) {
    const DitherEffect effect = dither_effect(dithered_model(), point, amplitude_A, 80, DitherShape::sine);
    const double elastic_m = effect.half_swing_N / stiffness;
    if (effect.half_swing_N < moving_friction_share * point.sliding_N) {
      held = true;
      EXPECT_NEAR(effect.motion_m, elastic_m, 1e-12);
    } else if (effect.half_swing_N > 1.3 * point.sliding_N) {
      freed = true;
      EXPECT_TRUE(effect.frees);
      EXPECT_GT(effect.motion_m, 1.5 * elastic_m);
      EXPECT_NEAR(effect.band_N, point.maps_N, 1e-9) << "no friction is left to hide in";
    }
  }
  EXPECT_TRUE(held && freed);
}

TEST(Dither, AFreedSpoolObeysNewtonsLaw) {
  DitherPoint point = held_in_the_middle();
  point.sliding_N = point.sticking_N = 0.01;  // hardly any friction: only mass is left
  point.stiffness_N_per_m = 0;
  const DitherEffect effect = dither_effect(dithered_model(), point, 0.1, 200, DitherShape::sine);
  const double mass_kg = dithered_model().observer->parameters.moving_mass_kg;
  EXPECT_NEAR(effect.motion_m, effect.half_swing_N / (mass_kg * std::pow(2 * M_PI * 200, 2)), 0.1 * effect.motion_m);
}

TEST(Dither, TheRecommendationKeepsTheRipplesLimitAndPrefersTheSmallerAmplitude) {
  double band_before = 1e9;
  for (const double limit : {0.0002, 0.002, 0.02}) {
    DitherQuestion question = few_settings();
    question.ripple_limit_share = limit;
    const DitherStudy study = studied(question);
    const DitherSetting& best = study.settings[study.recommended];
    EXPECT_LE(best.largest_ripple_m3_per_s, limit * dithered_model().valve.rated_flow_m3_per_s);
    EXPECT_LE(best.mean_band_m3_per_s, band_before + small_gain_share * study.settings.front().mean_band_m3_per_s);
    band_before = best.mean_band_m3_per_s;
    for (std::size_t place = 0; place < study.settings.size(); ++place) {
      const DitherSetting& other = study.settings[place];
      bool leaps = false;  // with a little more amplitude
      for (std::size_t above = place; above < study.settings.size(); above += study.frequency_Hz.size()) {
        leaps = leaps || !study.settings[above].within_limit;
      }
      if (leaps) continue;
      EXPECT_LE(best.mean_band_m3_per_s,
                other.mean_band_m3_per_s + small_gain_share * study.settings.front().mean_band_m3_per_s);
      if (study.amplitude_at_A(place) == study.amplitude_at_A(study.recommended)) {
        EXPECT_LE(best.mean_band_m3_per_s, other.mean_band_m3_per_s);
      }
    }
  }
}

TEST(Dither, RefusesAModelThatCannotTell) {
  model::Model condensed = dithered_model();
  condensed.observer.reset();
  EXPECT_THROW(static_cast<void>(dither_study(condensed, {}, 1)), model::ModelError);
  DitherQuestion outside;
  outside.points.pressure_differences_bar = {340};
  EXPECT_THROW(static_cast<void>(studied(outside)), model::ModelError);
}

}  // namespace
}  // namespace spoolflow::analysis
