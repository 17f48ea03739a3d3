#include <skein/io/start_name.hpp>

namespace skein {
namespace {

constexpr std::string_view start_prefix = "start-", start_suffix = ".checkpoint", partial = ".partial";
constexpr std::size_t checksum_size = 16;

}  // namespace

std::string make_start_name(const std::string_view checksum) {
  return std::string(start_prefix).append(checksum).append(start_suffix);
}

bool is_start_name(std::string_view name) {
  if (name.ends_with(partial)) name.remove_suffix(partial.size());
  if (name.size() != start_prefix.size() + checksum_size + start_suffix.size() || !name.starts_with(start_prefix) ||
      !name.ends_with(start_suffix))
    return false;
  const std::string_view checksum = name.substr(start_prefix.size(), checksum_size);
  return checksum.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

}  // namespace skein
