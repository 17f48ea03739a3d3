#include <skein/core/error.hpp>
#include <skein/scene/earlier_ends.hpp>

#include "scene_value.hpp"

#include <optional>
#include <string_view>

namespace skein {
namespace {

constexpr std::string_view table_line = "\n[time]\n", end_key = "\nend = ", list_key = "\nearlier_ends = [";

/// Where in a text the lines stand that change.
struct EndLines {
  std::size_t end, end_size;    ///< the value of `end`
  std::string::size_type list;  ///< the line break before `earlier_ends`, or before whatever follows `end`
  std::size_t list_size;        ///< of that line; 0: there is none
  std::string_view earlier;     ///< what stands between the brackets
};

std::optional<EndLines> find_end_lines(const std::string_view text) {
  const auto first = text.find(table_line);
  if (first == std::string_view::npos) return std::nullopt;
  const auto last = text.find("\n[", first + table_line.size() - 1);  // of the next table; the file may end without one
  const auto key = text.find(end_key, first);
  if (key == std::string_view::npos || key > last) return std::nullopt;
  EndLines lines{key + end_key.size(), 0, 0, 0, {}};
  lines.list = text.find('\n', lines.end);
  if (lines.list == std::string_view::npos) return std::nullopt;
  lines.end_size = lines.list - lines.end;
  if (!text.substr(lines.list).starts_with(list_key)) return lines;
  const auto line_end = text.find('\n', lines.list + 1);
  if (line_end == std::string_view::npos || text[line_end - 1] != ']') return std::nullopt;
  lines.list_size = line_end - lines.list;
  lines.earlier = text.substr(lines.list + list_key.size(), lines.list_size - list_key.size() - 1);
  return lines;
}

std::string replace_lines(const std::string& text, const EndLines& lines, const std::string_view end,
                          const std::string_view list) {
  std::string replaced = text.substr(0, lines.end);
  replaced.append(end).append(list);
  return replaced + text.substr(lines.list + lines.list_size);
}

}  // namespace

std::string prolong_scene_text(const std::string& text, const double end) {
  const auto lines = find_end_lines(text);
  if (!lines)
    throw Error(ExitCode::damaged_data,
                "the scene of the run is not as skein writes it: it has no line 'end = ' in "
                "[time] to change");
  std::string list(list_key);
  if (!lines->earlier.empty()) list.append(lines->earlier).append(", ");
  list.append(text, lines->end, lines->end_size).append("]");
  return replace_lines(text, *lines, format_number(end), list);
}

bool is_prolonged_from(const std::string& text, const std::string& before) {
  for (std::string found = text; found != before;) {
    const auto lines = find_end_lines(found);
    if (!lines || lines->earlier.empty()) return false;
    const auto comma = lines->earlier.rfind(", ");
    const bool is_only_one = comma == std::string_view::npos;
    std::string list;
    if (!is_only_one) list.append(list_key).append(lines->earlier.substr(0, comma)).append("]");
    found = replace_lines(found, *lines, lines->earlier.substr(is_only_one ? 0 : comma + 2), list);
  }
  return true;
}

std::string find_first_scene_text(const std::string& text) {
  const auto lines = find_end_lines(text);
  if (!lines || lines->earlier.empty()) return text;
  return replace_lines(text, *lines, lines->earlier.substr(0, lines->earlier.find(',')), "");
}

}  // namespace skein
