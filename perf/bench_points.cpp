// Evaluations of the fast multipole method at points of a file, one for each line of the standard input: what
// perf/python_mobility.py takes turns with. Usage: bench_points FILE TOLERANCE CHECK_EVERY, or bench_points tiny
//
// The file holds doubles: x of all points, y, z, then the forces alike, then the blobs. Each line on standard output is
// the wall time of an evaluation in seconds; at the end of the input the last velocities are written to FILE.velocity.

#include <skein/arrays/runtime.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace skein;

constexpr double viscosity = 1.7;
constexpr std::size_t numbers_of_a_point = 7;

std::vector<double> read_numbers(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::vector<double> numbers(static_cast<std::size_t>(file.tellg()) / sizeof(double));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(numbers.size() * sizeof(double)));
  if (!file || numbers.size() % numbers_of_a_point != 0) {
    std::fprintf(stderr, "%s cannot be read as points\n", path.c_str());
    std::exit(1);
  }
  return numbers;
}

/// [n] of a coordinate follow those of the one before.
Vectors take_vectors(const char* label, const double* numbers, const std::size_t n) {
  std::vector<Vec3> vectors(n);
  for (std::size_t i = 0; i < n; ++i) vectors[i] = {numbers[i], numbers[n + i], numbers[2 * n + i]};
  return to_device(label, vectors);
}

double evaluate(Mobility& mobility, const Sources& sources, const Vectors& velocity) {
  const auto start = std::chrono::steady_clock::now();
  Kokkos::deep_copy(velocity, 0.0);
  mobility.add_velocity(sources, sources.position, velocity);
  Kokkos::fence();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

int main(int argc, char** argv) {
  const Runtime runtime;
  const bool is_tiny = argc == 2 && std::string(argv[1]) == "tiny";
  if (argc != 4 && !is_tiny) {
    std::fprintf(stderr, "usage: bench_points FILE TOLERANCE CHECK_EVERY\n");
    return 1;
  }
  std::vector<double> numbers(numbers_of_a_point, 1.0);
  if (!is_tiny) numbers = read_numbers(argv[1]);
  const std::size_t n = numbers.size() / numbers_of_a_point;
  const Sources sources{
      take_vectors("bench::position", numbers.data(), n), take_vectors("bench::force", numbers.data() + 3 * n, n),
      to_device("bench::blob", std::vector<double>(numbers.end() - static_cast<std::ptrdiff_t>(n), numbers.end()))};
  const Vectors velocity("bench::velocity", n);
  FmmOptions options;
  options.direct_when_cheaper = true;
  if (!is_tiny) {
    options.tolerance = std::stod(argv[2]);
    options.check_every = std::stoi(argv[3]);
  }
  FmmMobility mobility(viscosity, options);
  if (is_tiny) return std::printf("%.9f\n", evaluate(mobility, sources, velocity)) > 0 ? 0 : 1;

  for (std::string line; std::getline(std::cin, line);) {
    std::printf("%.9f\n", evaluate(mobility, sources, velocity));
    std::fflush(stdout);
  }
  std::ofstream file(std::string(argv[1]) + ".velocity", std::ios::binary);
  for (int c = 0; c < 3; ++c)
    for (const Vec3& u : to_host(velocity)) {
      const double component = c == 0 ? u.x : c == 1 ? u.y : u.z;
      file.write(reinterpret_cast<const char*>(&component), sizeof component);
    }
  return file ? 0 : 1;
}
