#pragma once

#include <skein/io/run_folder.hpp>
#include <skein/io/trajectory.hpp>

#include "segment.hpp"
#include "series.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace skein {

/// Writes trajectory.h5, the H5MD 1.1 root of a run, in place of the one before:
///
///   /h5md, /particles/fibers, /observables   frames and step records: virtual datasets over all segments
///   /connectivity/surface                    [n_quads, 4], nodes, see surface_mesh.hpp
///   /parameters                              attributes: the layout's, and status
///     fiber_sections, fiber_nodes_per_section, fiber_radius, first_node, first_section    [n_fibers]
///     blob, node_fiber, node_section         [n_nodes]
///     segments/{frames, steps, last_time}    [n_segments]; attribute xxh3: end of the chain so far; attribute chain:
///                                            the xxh3 of every segment, 16 digits each, one after the other
///     and the layout's parameters
///
/// Springs are not listed: there are hundreds for each node, and the scene says which (docs/model.md).
///
/// @returns the bytes written
std::uint64_t write_trajectory_index(const RunFolder& folder, const TrajectoryLayout& layout, const Series& frames,
                                     const Series& records, const std::vector<Segment>& segments,
                                     const std::string& status);

}  // namespace skein
