// Waves of curvature whose places and speeds are prescribed.
#include <skein/analysis/curvature_extrema.hpp>
#include <skein/analysis/signed_curvature.hpp>

#include "known_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace skein {
namespace {

constexpr int n_sections = 200;
constexpr double spacing = 0.003, length = n_sections * spacing;

using CurvatureOf = std::function<double(double arclength, double time)>;

struct Movie {
  std::vector<double> time;
  std::vector<std::vector<CurvatureExtremum>> extrema;
};

/// Extrema of the given curvature, sampled at the sections.
Movie film(const CurvatureOf& curvature_of, const double least, const int n_moments = 60) {
  Movie movie;
  for (int moment = 0; moment < n_moments; ++moment) {
    const double time = 1.0 + 0.05 * moment;
    std::vector<double> arclength, curvature;
    for (int s = 0; s < n_sections; ++s) {
      arclength.push_back(s * spacing);
      curvature.push_back(curvature_of(s * spacing, time));
    }
    movie.time.push_back(time);
    movie.extrema.push_back(find_curvature_extrema(arclength, curvature, least));
  }
  return movie;
}

double bump(const double x, const double width) { return std::exp(-x * x / (width * width)); }

TEST(CurvatureExtrema, LieBetweenSections) {
  const double place = 0.3003 + 0.4 * spacing;
  const auto movie = film([&](const double s, double) { return -40.0 * bump(s - place, 0.03); }, 10.0, 1);
  ASSERT_EQ(movie.extrema[0].size(), 1u);
  EXPECT_NEAR(movie.extrema[0][0].arclength, place, 0.02 * spacing);
  EXPECT_NEAR(movie.extrema[0][0].curvature, -40.0, 2e-3);
}

TEST(CurvatureExtrema, OfASineAreItsCrests) {
  const auto movie =
      film([](const double s, double) { return 9.0 * std::sin(4.0 * std::numbers::pi * s / length); }, 4.0, 1);
  const auto& found = movie.extrema[0];
  ASSERT_EQ(found.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(found[i].arclength, (0.125 + 0.25 * i) * length, 0.05 * spacing);
    EXPECT_NEAR(found[i].curvature, i % 2 == 0 ? 9.0 : -9.0, 1e-3);
  }
}

TEST(CurvatureExtrema, StandOut) {
  // A ripple of 5 % on a bump is none; two bumps with a valley between them are two.
  const auto ripple =
      film([](const double s, double) { return 20.0 * bump(s - 0.3, 0.1) + std::sin(s / (2.0 * spacing)); }, 4.0, 1);
  EXPECT_EQ(ripple.extrema[0].size(), 1u);
  const auto two =
      film([](const double s, double) { return 20.0 * bump(s - 0.2, 0.05) + 12.0 * bump(s - 0.4, 0.05); }, 1.0, 1);
  ASSERT_EQ(two.extrema[0].size(), 2u);
  EXPECT_NEAR(two.extrema[0][1].curvature, 12.0, 0.1);
  EXPECT_TRUE(film([](double, double) { return 0.0; }, 1.0, 1).extrema[0].empty());
}

TEST(Tracks, RecoverTheSpeedsOfTravellingBends) {
  // Two hooks that run towards each other, as in a snake turn.
  const double speed = 0.0612;
  const auto movie = film(
      [&](const double s, const double t) {
        const double place = 0.05 + speed * (t - 1.0);
        return 50.0 * bump(s - place, 0.02) - 50.0 * bump(length - s - place, 0.02);
      },
      10.0);
  const auto tracks = track_extrema(movie.time, movie.extrema, 0.015);
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_EQ(tracks[0].time.size(), movie.time.size());
  EXPECT_NEAR(tracks[0].fit().slope, speed, 1e-3 * speed);
  EXPECT_NEAR(tracks[1].fit().slope, -speed, 1e-3 * speed);
  for (const auto& track : tracks) EXPECT_EQ(judge_wave(track, length), Wave::travelling);
}

// A travelling sine: new crests come in at one end and leave at the other, each a track of its own.
TEST(Tracks, RecoverTheSpeedOfATravellingSine) {
  const double speed = 0.0931, wave_number = 6.0 * std::numbers::pi / length;
  const auto movie =
      film([&](const double s, const double t) { return 9.0 * std::sin(wave_number * (s - speed * t)); }, 4.0, 150);
  const auto tracks = track_extrema(movie.time, movie.extrema, 0.015);
  EXPECT_GE(tracks.size(), 8u);
  int n_long = 0;
  for (const auto& track : tracks) {
    if (track.time.size() < 20) continue;
    ++n_long;
    EXPECT_NEAR(track.fit().slope, speed, 5e-3 * speed);
    EXPECT_GT(track.fit().determination, 0.999);
  }
  EXPECT_GE(n_long, 6);
}

TEST(Tracks, TellStandingBends) {
  // Two bends that grow and decay where they are, but for a small shift.
  const auto movie = film(
      [&](const double s, const double t) {
        const double place = 0.15 + 0.02 * (t - 1.0), height = 30.0 * std::sin(std::numbers::pi * (t - 1.0) / 3.0);
        return height * (bump(s - place, 0.05) - bump(length - s - place, 0.05));
      },
      10.0);
  const auto tracks = track_extrema(movie.time, movie.extrema, 0.015);
  ASSERT_EQ(tracks.size(), 2u);
  for (const auto& track : tracks) {
    EXPECT_LT(track.time.size(), movie.time.size());
    EXPECT_EQ(judge_wave(track, length), Wave::standing);
  }
}

TEST(Tracks, DoNotJoinBendsOfOppositeSignOrFarApart) {
  std::vector<double> time;
  std::vector<std::vector<CurvatureExtremum>> extrema;
  for (int i = 0; i < 20; ++i) {
    time.push_back(i);
    extrema.push_back({{i < 10 ? 0.1 : 0.2, 5.0}, {0.4, i < 10 ? 5.0 : -5.0}});
  }
  const auto tracks = track_extrema(time, extrema, 0.05);
  ASSERT_EQ(tracks.size(), 4u);
  for (const auto& track : tracks) EXPECT_EQ(track.time.size(), 10u);
  EXPECT_TRUE(track_extrema(time, extrema, 0.05, 11).empty());
}

}  // namespace
}  // namespace skein
