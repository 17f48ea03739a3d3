#pragma once

#include <string>

namespace skein {

/// Whether a run writes a file of this name into its folder, also half-written as "<name>.partial".
bool is_file_of_a_run(const std::string& name);

/// Whether it is the name of a segment or a checkpoint: digits and ".h5" or ".checkpoint", also of what became of one,
/// "<name>.partial" and "<name>.damaged".
bool is_numbered_file(const std::string& name);

/// Whether `skein analyze`, or `skein plot`, writes a file of this name into its folder, also half-written.
bool is_table(const std::string& name);
bool is_picture(const std::string& name);

/// Whether it is the checkpoint that is written for its time alone and not kept.
bool is_rehearsal(const std::string& name);

/// Whether a write that did not come to its end has left a file of this name.
bool is_half_written(const std::string& name);

}  // namespace skein
