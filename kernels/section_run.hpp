#pragma once

namespace skein {

/// A run of equal sections, for kernels: node a of section s has the index first_node + s * nodes_per_section + a.
struct SectionRun {
  int first_node;
  int n_sections;
  int nodes_per_section;
  double radius;  ///< at rest, length
};

}  // namespace skein
