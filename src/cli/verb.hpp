#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace skein {

/// Where a time goes that people write as 90, 30m, 2h or 1:30:00.
struct Duration {
  double* seconds;
};

/// The place that an argument sets, which says what can be written: a flag for a bool, one text after each use of an
/// option for a list of texts, numbers between commas for a list of numbers. What is not written stays as it is.
using Target =
    std::variant<bool*, int*, double*, Duration, std::string*, std::filesystem::path*, std::vector<std::string>*,
                 std::vector<double>*, std::optional<std::int64_t>*, std::optional<double>*>;

/// What can stand behind a verb, as data: the parser translates it.
struct Argument {
  std::string names;  ///< "scene" is a word at its place, "-o,--output" an option or a flag
  Target target;
  std::string type_name;  ///< for the help text, and what shells complete (completion.cpp); empty: what the target says
  std::string meaning;
  bool is_required = false;
  std::optional<std::pair<double, double>> bounds;  ///< of a number, and of each in a list; both are within
  std::vector<std::string> words;                   ///< the only ones; empty: any
  int count = 0;                                    ///< of the numbers in a list; 0: any
  std::string excluded;                             ///< the option that cannot stand beside it

  bool is_option() const { return names.starts_with('-'); }

  Argument&& require() && {
    is_required = true;
    return std::move(*this);
  }
  Argument&& within(const double low, const double high) && {
    bounds = {low, high};
    return std::move(*this);
  }
  Argument&& among(std::vector<std::string> allowed) && {
    words = std::move(allowed);
    return std::move(*this);
  }
  Argument&& exactly(const int numbers) && {
    count = numbers;
    return std::move(*this);
  }
  Argument&& exclude(std::string option) && {
    excluded = std::move(option);
    return std::move(*this);
  }
};

inline Argument make_argument(std::string names, Target target, std::string type_name, std::string meaning) {
  return {std::move(names), target, std::move(type_name), std::move(meaning), false, {}, {}, 0, {}};
}

inline Argument make_flag(std::string names, bool* is_given, std::string meaning) {
  return make_argument(std::move(names), is_given, "", std::move(meaning));
}

/// One thing that the program does.
struct Verb {
  std::string name;
  std::string summary;
  std::vector<Argument> arguments;  ///< whose targets `run` owns
  std::string footer;               ///< of its help text: examples, then what else is to be known
  std::function<int()> run;         ///< does it; returns the exit code
  bool takes_ranks = false;         ///< processes of an MPI launcher do it together
};

}  // namespace skein
