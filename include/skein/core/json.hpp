#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace skein {

/// Writes one JSON value (RFC 8259) that every reader takes, whatever it is given:
///   JsonWriter json;
///   json.begin_object().member("time", 0.1).key("points").begin_array().value(1).value(2).end_array().end_object();
///   json.take();  // {"time": 0.1, "points": [1, 2]}
/// A value where a key must stand, or an end without its begin, is Error(internal).
class JsonWriter {
 public:
  /// @param n_open_levels  what is nested in at most so many brackets gets lines of its own; 0: all is one line
  explicit JsonWriter(int n_open_levels = 0) : n_open_levels_(n_open_levels) {}

  JsonWriter& begin_object() { return begin('{', '}'); }
  JsonWriter& begin_array() { return begin('[', ']'); }
  JsonWriter& end_object() { return end('}'); }
  JsonWriter& end_array() { return end(']'); }

  JsonWriter& key(std::string_view name);

  /// Bytes that are no UTF-8 become U+FFFD each; control characters and the like are written by their numbers.
  JsonWriter& value(std::string_view text);
  JsonWriter& value(const char* text) { return value(std::string_view(text)); }
  /// The fewest digits that read back as the same number; whole numbers end in ".0", so that readers can tell them from
  /// counts and -0.0 keeps its sign. What JSON lacks (NaN, infinity) is null.
  JsonWriter& value(double number);
  JsonWriter& value(bool truth);
  JsonWriter& value(std::integral auto number) { return add_scalar(std::to_string(number)); }
  JsonWriter& null() { return add_scalar("null"); }

  /// A key and its value.
  template <class Value>
  JsonWriter& member(const std::string_view name, const Value& content) {
    return key(name).value(content);
  }

  /// The whole text, without a line break at its end; the writer is as new.
  std::string take();

 private:
  struct Level {
    char closing;
    bool is_empty = true;
  };

  JsonWriter& begin(char opening, char closing);
  JsonWriter& end(char closing);
  JsonWriter& add_scalar(std::string_view text);
  void begin_value();
  void begin_element();
  void break_line(std::size_t n_brackets);

  int n_open_levels_;
  std::string text_;
  std::vector<Level> levels_;  ///< of the brackets that are open, outermost first
  bool has_key_ = false;       ///< a key waits for its value
};

}  // namespace skein
