#include "runs/finished_run.hpp"

#include <skein/core/error.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/io/folder_listing.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/run_leftovers.hpp>
#include <skein/io/run_summary.hpp>
#include <skein/io/trajectory_end.hpp>
#include <skein/io/trajectory_writer.hpp>

#include "runs/run_description.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace skein {
namespace {

constexpr const char* status_of_done = "done";

// Empty where the index tells of a whole, finished run.
std::string find_index_fault(const RunFolder& folder, const TrajectoryEnd& end) {
  if (!is_there(folder.index())) return fmt::format("'{}' was missing", folder.index().string());
  try {
    const RunSummary summary = read_run_summary(folder.path());
    if (summary.status != status_of_done) return fmt::format("its status was \"{}\"", summary.status);
    if (summary.segments != end.segments || summary.frames != end.frames || summary.steps != end.records)
      return fmt::format("'{}' did not list all frames", folder.index().string());
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

bool is_at_end(const SceneConfig& scene, const ResumePoint& point) {
  // The first checkpoint stands before the first frame, also where the scene ends there.
  return point.checkpoint && point.checkpoint->number("state.time") >= scene.time.end &&
         read_trajectory_end(*point.checkpoint).frames > 0;
}

std::string mend_finished_run(const SceneConfig& scene, const RunFolder& folder, const Checkpoint& checkpoint) {
  const TrajectoryEnd end = read_trajectory_end(checkpoint);
  std::vector<std::string> faults;
  if (std::string fault = find_index_fault(folder, end); !fault.empty()) faults.push_back(std::move(fault));
  if (!is_there(folder.xdmf())) faults.push_back(fmt::format("'{}' was missing", folder.xdmf().string()));
  for (const auto& path : find_leftovers(folder, end.segments))
    faults.push_back(fmt::format("'{}' was left", path.string()));
  if (faults.empty()) return "";
  TrajectoryWriter trajectory(folder, describe_layout(scene, read_file(folder.scene()), make_fibers(scene.fibers)),
                              scene.output, end);
  trajectory.begin();
  trajectory.finish(status_of_done);
  return fmt::format("{}", fmt::join(faults, "; "));
}

}  // namespace skein
