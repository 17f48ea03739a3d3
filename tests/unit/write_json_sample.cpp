// Prints what check_json.py expects: text, numbers and nesting that are hard to write. With an argument, the layout on
// so many levels of lines.
#include <skein/core/json.hpp>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

int main(int argc, char** argv) {
  std::string bytes;
  for (int byte = 0; byte < 256; ++byte) bytes += static_cast<char>(byte);
  skein::JsonWriter json(argc > 1 ? std::atoi(argv[1]) : 0);
  json.begin_object().member("bytes", bytes).member("\"a\\key\"\t", "\xf0\x9f\xa7\xb6 \xed\xa0\x80 \xc0\xaf");
  json.key("reals").begin_array();
  for (const double real : {0.1, 1.0 / 3.0, -0.0, 1e308, 5e-324, 1e23, 123456789012345680.0}) json.value(real);
  json.end_array().key("none").begin_array();
  json.value(std::numeric_limits<double>::quiet_NaN()).value(-std::numeric_limits<double>::infinity());
  json.end_array().key("counts").begin_array();
  json.value(std::numeric_limits<std::int64_t>::min()).value(std::numeric_limits<std::uint64_t>::max());
  json.end_array().key("nested").begin_array().begin_array().begin_object().end_object().end_array();
  json.begin_array().end_array().value(false).end_array();
  std::puts(json.end_object().take().c_str());
}
