#include <skein/io/atomic_file.hpp>
#include <skein/io/read_file.hpp>

#include <cstdio>

int main() {
  skein::write_file_atomically("written", "by a user of skein::io alone");
  std::puts(skein::read_file("written").c_str());
}
