#include <skein/core/terminal_text.hpp>
#include <skein/core/utf8.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace skein {
namespace {

std::string escape(const std::string_view text, const std::string_view kept) {
  std::string shown;
  shown.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const Utf8Character character = read_utf8(text, at);
    const std::size_t n_bytes = std::max<std::size_t>(character.n_bytes, 1);
    const bool is_plain = kept.find(text[at]) != std::string_view::npos;
    if (character.n_bytes == 0 || (character.code < 0x80 && is_control_character(character.code) && !is_plain))
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at]));
    else if (is_control_character(character.code) && !is_plain)
      shown += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(character.code));
    else
      shown += text.substr(at, n_bytes);
    at += n_bytes;
  }
  return shown;
}

}  // namespace

std::string make_terminal_text(const std::string_view text) { return escape(text, "\n\t"); }

std::string make_terminal_line(const std::string_view text) { return escape(text, ""); }

}  // namespace skein
