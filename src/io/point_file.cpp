#include <skein/core/error.hpp>
#include <skein/io/point_file.hpp>
#include <skein/io/read_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace skein {
namespace {

constexpr std::string_view blanks = " \t\r";
constexpr std::string_view separators = ",;";

/// One word of a line, and its column from 1.
struct Word {
  std::string_view text;
  std::size_t column;
};

std::string make_printable(const std::string_view text) {
  constexpr std::size_t n_shown = 40;
  std::string shown(text.substr(0, n_shown));
  std::replace_if(
      shown.begin(), shown.end(), [](const char c) { return c < ' ' || c > '~'; }, '?');
  return text.size() > n_shown ? shown + "..." : shown;
}

class PointParser {
 public:
  explicit PointParser(const std::string& name) : name_(name) {}

  void add_line(const std::string_view line) {
    ++line_;
    const std::vector<Word> words = split(line.substr(0, line.find('#')));
    if (words.empty()) return;
    if (points_.empty() && !has_heading_ && is_heading(words)) {
      has_heading_ = true;
      return;
    }
    if (words.size() != 3) fail(words[std::min<std::size_t>(words.size() - 1, 3)].column, describe_count(words.size()));
    points_.push_back({read(words[0]), read(words[1]), read(words[2])});
    if (static_cast<double>(points_.size()) > largest_number_of_points)
      fail(1, fmt::format("there are more than {:g} points", largest_number_of_points));
  }

  std::vector<Vec3> take() {
    if (points_.empty()) fail(1, "there is no point; write x, y and z on a line for each");
    return std::move(points_);
  }

 private:
  [[noreturn]] void fail(const std::size_t column, const std::string& message) const {
    throw Error(ExitCode::damaged_data, fmt::format("{}:{}:{}: {}", name_, std::max(line_, 1), column, message));
  }

  static std::string describe_count(const std::size_t n) {
    return n > 3 ? "a fourth value; a line has x, y and z"
                 : fmt::format("only {} value{}; a line has x, y and z", n, n == 1 ? "" : "s");
  }

  static bool is_heading(const std::vector<Word>& words) {
    return words.size() == 3 && words[0].text == "x" && words[1].text == "y" && words[2].text == "z";
  }

  // Between two values stand blanks, one separator, or both.
  std::vector<Word> split(const std::string_view line) const {
    std::vector<Word> words;
    bool is_separated = true;
    for (std::size_t at = 0; at < line.size();) {
      if (blanks.find(line[at]) != std::string_view::npos) {
        ++at;
      } else if (separators.find(line[at]) != std::string_view::npos) {
        if (is_separated) fail(at + 1, "a value is missing before this separator");
        is_separated = true;
        ++at;
      } else {
        const std::size_t end = std::min(line.find_first_of(" \t\r,;", at), line.size());
        words.push_back({line.substr(at, end - at), at + 1});
        is_separated = false;
        at = end;
      }
    }
    if (is_separated && !words.empty()) fail(line.size(), "a value is missing after this separator");
    return words;
  }

  double read(const Word& word) const {
    double number = 0.0;
    if (!parse_number(word.text, number))
      fail(word.column, fmt::format("'{}' is no number", make_printable(word.text)));
    if (!(std::abs(number) <= largest_coordinate))
      fail(word.column, fmt::format("'{}' is no coordinate: a finite number of at most {:g} is one",
                                    make_printable(word.text), largest_coordinate));
    return number;
  }

  const std::string& name_;
  std::vector<Vec3> points_;
  int line_ = 0;
  bool has_heading_ = false;
};

}  // namespace

bool parse_number(std::string_view text, double& number) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double parsed = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed);
  if (error != std::errc() || end != text.data() + text.size()) return false;
  number = parsed;
  return true;
}

std::vector<Vec3> parse_points(std::string_view text, const std::string& name) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  PointParser parser(name);
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    parser.add_line(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return parser.take();
}

std::vector<Vec3> read_points(const std::filesystem::path& path) {
  return parse_points(read_file(path), path.string());
}

}  // namespace skein
