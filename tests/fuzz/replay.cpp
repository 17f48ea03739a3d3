// Gives the files of folders to a fuzzer's function, each whole, in halves, and with a byte changed here and there:
// what is built without libFuzzer is run, too. usage: fuzz_... FOLDER...

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

int try_input(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  return 1;
}

int try_with_changes(std::string bytes) {
  int n_tried =
      try_input(bytes) + try_input(bytes.substr(0, bytes.size() / 2)) + try_input(bytes.substr(bytes.size() / 2));
  constexpr std::size_t n_changes = 7;
  for (std::size_t i = 0; i < n_changes && !bytes.empty(); ++i) {
    char& changed = bytes[bytes.size() * (2 * i + 1) / (2 * n_changes)];
    const char before = changed;
    changed = static_cast<char>(changed ^ (1 << i));
    n_tried += try_input(bytes);
    changed = before;
  }
  return n_tried;
}

}  // namespace

int main(const int n_arguments, char** arguments) {
  int n_tried = 0;
  for (int i = 1; i < n_arguments; ++i)
    for (const auto& entry : std::filesystem::directory_iterator(arguments[i])) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path(), std::ios::binary);
      n_tried += try_with_changes({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
    }
  std::printf("%d inputs\n", n_tried);
  return n_tried > 0 ? 0 : 1;
}
