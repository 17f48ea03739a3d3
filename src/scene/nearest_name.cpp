#include <skein/scene/nearest_name.hpp>

#include <algorithm>
#include <cctype>

namespace skein {
namespace {

std::string lower_case(std::string word) {
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

}  // namespace

// Rows of the table of distances between beginnings of both words; a swap looks two rows back (optimal string
// alignment, Damerau 1964).
int compute_edit_distance(const std::string& a, const std::string& b) {
  std::vector<int> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string find_nearest_name(const std::string& name, const std::vector<std::string>& known) {
  std::string nearest;
  int smallest = static_cast<int>(name.size());  // a name replaced as a whole was not meant
  for (const auto& candidate : known) {
    const auto limit = static_cast<int>(std::max<std::size_t>(1, candidate.size() / 3));
    // Also keeps names of absurd length out of the quadratic comparison.
    if (name.size() > candidate.size() + limit) continue;
    const int distance = compute_edit_distance(lower_case(name), lower_case(candidate));
    if (distance <= limit && distance < smallest) {
      smallest = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace skein
