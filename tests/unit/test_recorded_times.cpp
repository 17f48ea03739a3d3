// At which times a run has frames, and where its steps have to end.

#include <skein/scene/earlier_ends.hpp>
#include <skein/scene/recorded_times.hpp>
#include <skein/scene/scene_file.hpp>

#include "tests/unit/error_code.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace skein {
namespace {

SceneConfig make_scene(const double interval, const double end, std::vector<double> earlier_ends = {}) {
  SceneConfig scene;
  scene.fibers.resize(1);
  scene.time.end = end;
  scene.time.earlier_ends = std::move(earlier_ends);
  scene.output.frame_interval = interval;
  return scene;
}

std::vector<double> list_frames(const SceneConfig& scene) {
  std::vector<double> times{0.0};
  while (std::isfinite(find_next_frame(scene, times.back()))) times.push_back(find_next_frame(scene, times.back()));
  return times;
}

// By counting, which cannot be off by a rounded quotient.
std::vector<double> count_frames(const SceneConfig& scene) {
  std::vector<double> times;
  for (std::int64_t n = 0; static_cast<double>(n) * scene.output.frame_interval < scene.time.end; ++n)
    times.push_back(static_cast<double>(n) * scene.output.frame_interval);
  for (const double end : scene.time.earlier_ends) times.push_back(end);
  times.push_back(scene.time.end);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

TEST(RecordedTimes, FramesAreAtMultiplesAndEnds) {
  for (const double interval : {0.1, 0.05, 1.0 / 3.0, 0.7e-3, 3.0, 2.5e-13})
    for (const double n : {0.5, 1.0, 3.0, 10.0, 1000.0, 99.37})
      for (const double at : {0.25, 0.5, 0.831}) {
        const SceneConfig scene = make_scene(interval, n * interval, {at * n * interval, 0.9 * n * interval});
        EXPECT_EQ(list_frames(scene), count_frames(scene)) << interval << " " << n;
      }
}

TEST(RecordedTimes, OneAfterTheOtherFromAnyTimeBetween) {
  const SceneConfig scene = make_scene(0.1, 2.03, {0.4, 1.11});
  const auto frames = list_frames(scene);
  EXPECT_EQ(frames.size(), 23u);  // 0.4 is a multiple, 1.11 and 2.03 are not
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
    EXPECT_EQ(find_next_frame(scene, std::nextafter(frames[i + 1], 0.0)), frames[i + 1]);
    EXPECT_EQ(find_next_frame(scene, 0.5 * (frames[i] + frames[i + 1])), frames[i + 1]);
    EXPECT_TRUE(is_frame_time(scene, frames[i]));
    EXPECT_FALSE(is_frame_time(scene, 0.5 * (frames[i] + frames[i + 1])));
  }
  EXPECT_TRUE(is_frame_time(scene, 2.03));
}

TEST(RecordedTimes, WithoutAnIntervalThatCountsOnlyEndsAreThere) {
  for (const double interval : {0.0, 1e-300}) {
    const SceneConfig scene = make_scene(interval, 2.0, {0.4});
    EXPECT_EQ(find_next_frame(scene, 1e-3), 0.4);
    EXPECT_EQ(find_next_frame(scene, 0.4), 2.0);
  }
}

TEST(RecordedTimes, StepsEndAtEveryEnd) {
  const TimeConfig time = make_scene(0.1, 2.0, {0.4, 1.1}).time;
  EXPECT_EQ(find_next_end(time, 0.0), 0.4);
  EXPECT_EQ(find_next_end(time, 0.4), 1.1);
  EXPECT_EQ(find_next_end(time, 1.9), 2.0);
  EXPECT_TRUE(std::isinf(find_next_end(time, 2.0)));
}

TEST(EarlierEnds, TheFirstTextComesBackFromEveryLaterOne) {
  SceneConfig scene = make_scene(0.1, 12.0);
  scene.title = "a \"title\"\n[time]\nend = 3.0\n";  // is escaped, and so no line of its own
  scene.flows.front().stop = 2.0;
  const std::string first = write_scene(scene);
  EXPECT_EQ(find_first_scene_text(first), first);
  std::string text = first;
  std::vector<double> earlier;
  double end = 12.0;
  for (const double later : {12.5, 1.0 / 3.0 + 20.0, 12345.678}) {
    text = prolong_scene_text(text, later);
    earlier.push_back(end);
    end = later;
    const SceneConfig read = read_scene_text(text, "prolonged", {"time.max_step=1e9"}).config;
    EXPECT_EQ(read.time.end, later);
    EXPECT_EQ(read.time.earlier_ends, earlier);
    EXPECT_EQ(find_first_scene_text(text), first);
    SceneConfig expected = scene;
    expected.time.end = end;
    expected.time.earlier_ends = earlier;
    EXPECT_EQ(text, write_scene(expected)) << "as if it had been written anew";
  }
}

TEST(EarlierEnds, OnlyWhatWasProlongedIsTakenForIt) {
  const std::string first = write_scene(make_scene(0.1, 12.0));
  std::vector<std::string> texts{first};
  for (const double later : {12.5, 13.0, 14.25}) texts.push_back(prolong_scene_text(texts.back(), later));
  for (std::size_t after = 0; after < texts.size(); ++after)
    for (std::size_t before = 0; before < texts.size(); ++before)
      EXPECT_EQ(is_prolonged_from(texts[after], texts[before]), before <= after) << before << " " << after;
  EXPECT_FALSE(is_prolonged_from(texts.back() + "\n", texts.back()));
  EXPECT_FALSE(is_prolonged_from(prolong_scene_text(first, 15.0), texts[1]));
  EXPECT_FALSE(is_prolonged_from(write_scene(make_scene(0.1, 15.0)), first));
}

TEST(EarlierEnds, WhatIsNoSceneOfARunIsLeftAlone) {
  for (const char* text : {"", "[time]\nend = 3.0\n", "\n[time]\n[output]\nend = 3.0\n", "\n[time]\nend = 3.0",
                           "\n[time]\nend = 3.0\nearlier_ends = [1.0\n"}) {
    EXPECT_EQ(code_of([&] { prolong_scene_text(text, 4.0); }), ExitCode::damaged_data) << text;
    EXPECT_EQ(find_first_scene_text(text), text);
  }
}

}  // namespace
}  // namespace skein
