#pragma once

#include <skein/core/error.hpp>
#include <skein/scene/choices.hpp>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <vector>

namespace skein {

/// One of the words that a key may be.
struct Choice {
  std::string word;
  std::string meaning;  ///< half a sentence, for the reference
};

/// `"a", "b" or "c"`.
std::string list_choices(const std::vector<Choice>& choices);

/// The words that a key may be with the enumerators they stand for, in the order of the reference.
template <class Enum>
class Words {
 public:
  struct Row {
    std::string word;
    std::string meaning;
    Enum value;
  };

  Words(const std::initializer_list<Row> rows) {
    for (const Row& row : rows) {
      choices_.push_back({row.word, row.meaning});
      values_.push_back(row.value);
    }
  }

  const std::vector<Choice>& choices() const { return choices_; }
  Enum value_at(const std::size_t index) const { return values_.at(index); }

  /// @throws Error(internal) for an enumerator that the key cannot be
  std::size_t index_of(const Enum value) const {
    const auto found = std::find(values_.begin(), values_.end(), value);
    SKEIN_REQUIRE(found != values_.end(), "this key has no word for enumerator " +
                                              std::to_string(static_cast<int>(value)) + ": it may be " +
                                              list_choices(choices_));
    return static_cast<std::size_t>(found - values_.begin());
  }
  const std::string& word_of(const Enum value) const { return choices_[index_of(value)].word; }

  /// @throws Error(scene_error) naming the known words for another
  Enum value_of(const std::string& word) const {
    for (std::size_t i = 0; i < choices_.size(); ++i)
      if (choices_[i].word == word) return values_[i];
    throw Error(ExitCode::scene_error, "\"" + word + "\" is not known: write " + list_choices(choices_));
  }

 private:
  std::vector<Choice> choices_;
  std::vector<Enum> values_;
};

/// The table of an enum; there is one for each that a scene chooses from.
template <class Enum>
const Words<Enum>& words_of();
template <>
const Words<FlowKind>& words_of<FlowKind>();
template <>
const Words<FiberModel>& words_of<FiberModel>();
template <>
const Words<PlacementKind>& words_of<PlacementKind>();
template <>
const Words<Orientation>& words_of<Orientation>();
template <>
const Words<SymmetryAxis>& words_of<SymmetryAxis>();
template <>
const Words<SumMethod>& words_of<SumMethod>();
template <>
const Words<Precision>& words_of<Precision>();
template <>
const Words<FarField>& words_of<FarField>();
template <>
const Words<OnMiss>& words_of<OnMiss>();
template <>
const Words<TimeMethod>& words_of<TimeMethod>();

/// Of numbers in files, which are never left to choose themselves.
const Words<Precision>& words_of_stored_precision();

template <class Enum>
const std::string& word_of(const Enum value) {
  return words_of<Enum>().word_of(value);
}

}  // namespace skein
