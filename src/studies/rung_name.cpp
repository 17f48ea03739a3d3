#include "studies/rung_name.hpp"

#include <skein/core/error.hpp>

#include <fmt/format.h>

#include <charconv>

namespace skein {

std::string name_of_rung(const int rung) {
  if (rung == rigid_rung) return "rigid";
  return rung == chain_rung ? "chain" : std::to_string(rung);
}

int read_rung(const std::string& name) {
  for (const int line : {rigid_rung, chain_rung})
    if (name == name_of_rung(line)) return line;
  int nodes = 0;
  const char* end = name.data() + name.size();
  const auto [rest, code] = std::from_chars(name.data(), end, nodes);
  constexpr int coarsest_tube = 3;
  if (code == std::errc() && rest == end && nodes >= coarsest_tube && nodes <= finest_rung) return nodes;
  throw Error(ExitCode::usage,
              fmt::format("--rung: '{}' is none: there are rigid, chain, and {} to {} nodes on a section", name,
                          coarsest_tube, finest_rung));
}

std::string describe_rung(const int rung) {
  if (rung == rigid_rung) return "rigid fibers";
  return rung == chain_rung ? "a chain" : fmt::format("{} nodes on a section", rung);
}

}  // namespace skein
