#include <skein/core/utf8.hpp>

namespace skein {

Utf8Character read_utf8(const std::string_view text, const std::size_t at) {
  const auto byte = [text](const std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : static_cast<unsigned char>(0);
  };
  const unsigned char first = byte(at), second = byte(at + 1);
  if (first < 0x80) return {1, first};
  Utf8Character character;
  if (first >= 0xc2 && first <= 0xdf) character = {2, first & 0x1fU};
  if (first >= 0xe0 && first <= 0xef) character = {3, first & 0x0fU};
  if (first >= 0xf0 && first <= 0xf4) character = {4, first & 0x07U};
  for (std::size_t i = 1; i < character.n_bytes; ++i) {
    if ((byte(at + i) & 0xc0) != 0x80) return {};
    character.code = character.code << 6 | (byte(at + i) & 0x3fU);
  }
  const bool forbidden = (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
                         (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f);
  return forbidden ? Utf8Character{} : character;
}

std::size_t find_utf8_fault(const std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t n_bytes = read_utf8(text, at).n_bytes;
    if (n_bytes == 0) return at;
    at += n_bytes;
  }
  return std::string_view::npos;
}

bool is_control_character(const char32_t code) {
  if (code < 0x20 || (code >= 0x7f && code < 0xa0)) return true;
  return code == 0x061c || code == 0x200e || code == 0x200f || (code >= 0x2028 && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069);
}

}  // namespace skein
