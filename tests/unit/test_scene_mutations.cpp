// A valid scene, damaged in many ways: no damage may pass unseen, crash the reader, or be reported without its place.

#include <skein/scene/scene_file.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace skein {
namespace {

std::vector<std::string> make_valid_lines() {
  SceneConfig scene;
  scene.title = "a scene";
  scene.fibers.resize(2);
  std::vector<std::string> lines(1);
  for (const char c : write_scene(scene)) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  return lines;
}

std::string join(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += line + '\n';
  return text;
}

/// The problems of a scene; empty if it is valid.
std::vector<Problem> find_problems(const std::string& text) {
  try {
    read_scene_text(text, "scene.toml", {});
  } catch (const SceneError& error) {
    return error.problems();
  }
  return {};
}

void expect_single_problem(const std::vector<std::string>& lines, const std::size_t changed, const std::string& words) {
  const auto problems = find_problems(join(lines));
  ASSERT_EQ(problems.size(), 1u) << lines[changed] << "\n" << describe_problems(problems);
  EXPECT_EQ(problems[0].where.line, static_cast<int>(changed) + 1) << lines[changed];
  EXPECT_NE(problems[0].message.find(words), std::string::npos) << lines[changed] << "\n" << problems[0].message;
}

TEST(MutatedScene, BeforeMutationIsValid) { EXPECT_EQ(find_problems(join(make_valid_lines())).size(), 0u); }

TEST(MutatedScene, EveryWrongValueOfEveryKeyIsFoundAtItsLine) {
  const auto valid = make_valid_lines();
  int n_mutations = 0;
  for (std::size_t i = 0; i < valid.size(); ++i) {
    const auto equals = valid[i].find(" = ");
    if (equals == std::string::npos) continue;
    const std::string key = valid[i].substr(0, equals);
    for (const char* wrong : {"nan", "inf", "-inf", "-1e300", "1e300", "true", "1979-05-27", "{}", "[[1]]", "[]",
                              "[nan, 1.0, 1.0]", "[0.0, 0.0, 0.0, 0.0]", "\"word\""}) {
      const bool may_be_a_word = key == "title" || key == "checksum" || key == "parent" || key == "certificate";
      if (may_be_a_word && wrong[0] == '"') continue;
      const std::string_view value = wrong;
      if (key == "max_step" && (value == "inf" || value == "1e300")) continue;  // as good as none
      auto lines = valid;
      lines[i] = key + " = " + wrong;
      expect_single_problem(lines, i, key + " must be ");
      ++n_mutations;
    }
  }
  EXPECT_GT(n_mutations, 300);
}

TEST(MutatedScene, EveryMistypedKeyIsRecognized) {
  const auto valid = make_valid_lines();
  int n_mutations = 0;
  for (std::size_t i = 0; i < valid.size(); ++i) {
    const auto equals = valid[i].find(" = ");
    if (equals == std::string::npos) continue;
    const std::string key = valid[i].substr(0, equals);
    // Two letters of "end" are another name; the rest must be recognized with a letter lost, doubled, or swapped.
    for (std::size_t at = 0; at + 1 < key.size() && key.size() > 3; ++at) {
      std::string lost = key, doubled = key, swapped = key;
      lost.erase(at, 1);
      doubled.insert(at, 1, key[at]);
      std::swap(swapped[at], swapped[at + 1]);
      for (const auto& mistyped : {lost, doubled, swapped}) {
        if (mistyped == key) continue;
        auto lines = valid;
        lines[i] = mistyped + valid[i].substr(equals);
        expect_single_problem(lines, i, "did you mean '" + key + "'?");
        ++n_mutations;
      }
    }
  }
  EXPECT_GT(n_mutations, 300);
}

TEST(MutatedScene, RandomDamageIsReportedWithItsPlaceOrHarmless) {
  const std::string valid = join(make_valid_lines());
  const std::vector<std::string> pieces{"\"", "'", "[", "]",    "{",    "}",    "=",      ".",         "\n",
                                        "#",  "-", "e", "\xff", "\xc3", "\\u0", "\"\"\"", "[[fiber]]", "nan"};
  std::mt19937 random(7);
  const auto draw = [&random](const std::size_t n) { return random() % n; };
  int n_refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = valid;
    for (std::size_t n_changes = 1 + draw(4); n_changes > 0; --n_changes) {
      const std::size_t at = draw(text.size());
      switch (draw(4)) {
        case 0:
          text.insert(at, pieces[draw(pieces.size())]);
          break;
        case 1:
          text.erase(at, 1 + draw(30));
          break;
        case 2:
          text[at] = static_cast<char>(draw(256));
          break;
        default:
          text.insert(at, text.substr(draw(text.size()), draw(40)));
      }
      if (text.empty()) text = " ";
    }
    const auto n_lines = std::count(text.begin(), text.end(), '\n') + 1;
    const auto problems = find_problems(text);
    n_refused += problems.empty() ? 0 : 1;
    for (const Problem& problem : problems) {
      ASSERT_TRUE(problem.where.line >= 1 && problem.where.line <= n_lines && problem.where.column >= 1)
          << problem.describe() << "\nin\n"
          << text;
    }
  }
  EXPECT_GT(n_refused, 2000);
  EXPECT_LT(n_refused, 3000);
}

}  // namespace
}  // namespace skein
