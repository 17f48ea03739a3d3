#include <skein/core/error.hpp>
#include <skein/core/json.hpp>
#include <skein/core/utf8.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

// Control characters, and marks that would change how the text looks, are written as numbers: they mean the same to
// programs, and do nothing to a terminal.
std::string quote(const std::string_view text) {
  std::string quoted = "\"";
  for (std::size_t at = 0; at < text.size();) {
    const Utf8Character character = read_utf8(text, at);
    const char c = text[at];
    if (character.n_bytes == 0) {
      quoted += "\\ufffd";
    } else if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (is_control_character(character.code)) {
      quoted += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(character.code));
    } else {
      quoted += text.substr(at, character.n_bytes);
    }
    at += std::max<std::size_t>(character.n_bytes, 1);
  }
  return quoted + '"';
}

}  // namespace

JsonWriter& JsonWriter::key(const std::string_view name) {
  SKEIN_REQUIRE(!levels_.empty() && levels_.back().closing == '}' && !has_key_, "a key stands in an object");
  begin_element();
  text_ += quote(name) + ": ";
  has_key_ = true;
  return *this;
}

JsonWriter& JsonWriter::value(const std::string_view text) { return add_scalar(quote(text)); }

JsonWriter& JsonWriter::value(const double number) {
  if (!std::isfinite(number)) return null();
  std::string digits = fmt::format("{}", number);
  if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
  return add_scalar(digits);
}

JsonWriter& JsonWriter::value(const bool truth) { return add_scalar(truth ? "true" : "false"); }

std::string JsonWriter::take() {
  SKEIN_REQUIRE(levels_.empty() && !text_.empty(), "a JSON text is one value, with all its brackets closed");
  return std::exchange(text_, {});
}

JsonWriter& JsonWriter::begin(const char opening, const char closing) {
  begin_value();
  text_ += opening;
  levels_.push_back({closing});
  return *this;
}

JsonWriter& JsonWriter::end(const char closing) {
  SKEIN_REQUIRE(!levels_.empty() && levels_.back().closing == closing && !has_key_, "brackets close as they open");
  const bool was_empty = levels_.back().is_empty;
  levels_.pop_back();
  if (!was_empty && levels_.size() < static_cast<std::size_t>(n_open_levels_)) break_line(levels_.size());
  text_ += closing;
  return *this;
}

JsonWriter& JsonWriter::add_scalar(const std::string_view text) {
  begin_value();
  text_ += text;
  return *this;
}

void JsonWriter::begin_value() {
  const bool is_in_object = !levels_.empty() && levels_.back().closing == '}';
  SKEIN_REQUIRE(is_in_object ? has_key_ : !levels_.empty() || text_.empty(), "a value stands where JSON has one");
  if (!is_in_object && !levels_.empty()) begin_element();
  has_key_ = false;
}

void JsonWriter::begin_element() {
  Level& level = levels_.back();
  const bool has_line = levels_.size() <= static_cast<std::size_t>(n_open_levels_);
  if (!level.is_empty) text_ += has_line ? "," : ", ";
  if (has_line) break_line(levels_.size());
  level.is_empty = false;
}

void JsonWriter::break_line(const std::size_t n_brackets) { text_ += '\n' + std::string(2 * n_brackets, ' '); }

}  // namespace skein
