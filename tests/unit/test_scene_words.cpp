// The words of scenes: each stands for one enumerator, and one that is near to what was written is proposed.

#include <skein/scene/nearest_name.hpp>
#include <skein/scene/words.hpp>

#include "tests/unit/scene_text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace skein {
namespace {

TEST(SceneWords, StandForOneEnumeratorEach) {
  const Words<TimeMethod>& words = words_of<TimeMethod>();
  EXPECT_EQ(words.choices().size(), 6u);
  for (const Choice& choice : words.choices()) EXPECT_EQ(words.word_of(words.value_of(choice.word)), choice.word);
  EXPECT_EQ(read("[fiber]\n[hydrodynamics]\nprecision = \"single\"\non_miss = \"stop\"\n").hydrodynamics.on_miss,
            OnMiss::stop);
  try {
    words.value_of("rk5");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::scene_error);
    EXPECT_NE(std::string(error.what()).find("\"rk5\" is not known: write \"auto\", \"rkc2\""), std::string::npos);
  }
}

TEST(SceneWords, AreNotWrittenForWhatAKeyCannotBe) {
  SceneConfig scene;
  scene.fibers.resize(1);
  scene.output.precision = Precision::automatic;
  try {
    write_scene(scene);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::internal);
  }
  scene.output.precision = Precision::in_single;
  scene.time.method = static_cast<TimeMethod>(99);
  EXPECT_THROW(write_scene(scene), Error);
}

TEST(NearestName, CountsEdits) {
  EXPECT_EQ(compute_edit_distance("", "blob"), 4);
  EXPECT_EQ(compute_edit_distance("blob", "blob"), 0);
  EXPECT_EQ(compute_edit_distance("blbo", "blob"), 1);  // neighbours swapped
  EXPECT_EQ(compute_edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(compute_edit_distance("sitting", "kitten"), 3);
}

TEST(NearestName, IsGivenOnlyWhereItMayBeMeant) {
  const std::vector<std::string> known{"blob", "roll", "radius", "sections"};
  EXPECT_EQ(find_nearest_name("blobb", known), "blob");
  EXPECT_EQ(find_nearest_name("Radius", known), "radius");
  EXPECT_EQ(find_nearest_name("section", known), "sections");
  EXPECT_EQ(find_nearest_name("temperature", known), "");
  EXPECT_EQ(find_nearest_name("x", known), "");
}

}  // namespace
}  // namespace skein
