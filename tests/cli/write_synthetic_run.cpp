// Writes a run of two synthetic fibers, no solver involved: write_synthetic_run FOLDER double|single [frames
// [segments]]
#include <skein/core/error.hpp>
#include <skein/io/event_log.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/io/run_log.hpp>
#include <skein/io/trajectory_writer.hpp>
#include <skein/scene/words.hpp>

#include "tests/unit/synthetic_run.hpp"

#include <cstdio>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  using namespace skein;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 2) {
    std::fputs("usage: write_synthetic_run FOLDER double|single [frames [segments]]\n", stderr);
    return static_cast<int>(ExitCode::usage);
  }
  const int n_frames = arguments.size() > 2 ? std::stoi(arguments[2]) : 11;
  const int n_segments = arguments.size() > 3 ? std::stoi(arguments[3]) : 3;
  try {
    OutputConfig output;
    output.precision = words_of_stored_precision().value_of(arguments[1]);
    const TrajectoryLayout layout = make_synthetic_layout("title = \"two synthetic tubes\"\n");
    const RunFolder folder = RunFolder::create(arguments[0], layout.attributes.at("scene"), /*overwrite=*/true);
    RunLog log(folder.run_log());
    EventLog events(folder.events());
    log.write("synthetic run");
    TrajectoryWriter writer(folder, layout, output, {.bytes = 1 << 30, .seconds = 1e9});
    for (int frame = 0; frame < n_frames; ++frame) {
      for (int step = 10 * frame - 9; step <= 10 * frame; ++step)
        if (step > 0) writer.append(make_synthetic_record(step));
      writer.append(make_synthetic_frame(layout, frame));
      events.write("frame", {{"frame", std::int64_t{frame}}});
      if ((frame + 1) * n_segments / n_frames > frame * n_segments / n_frames) writer.close_segment();
    }
    writer.finish("done");
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
}
