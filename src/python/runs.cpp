#include <skein/core/error.hpp>
#include <skein/io/run_lock.hpp>

#include "python/bindings.hpp"
#include "python/device_thread.hpp"
#include "python/messages.hpp"
#include "python/script_listener.hpp"
#include "runs/finished_run.hpp"
#include "runs/resumption.hpp"
#include "runs/run_control.hpp"
#include "runs/run_start.hpp"
#include "runs/simulate.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace skein {
namespace {

namespace py = pybind11;
using Changes = std::vector<std::string>;

/// How a run came to its end, if it did.
struct RunEnd {
  bool is_done = true;
  std::string reason;  ///< of a stop, in words
  int signal = 0;      ///< that stopped it; 0: none
};

/// One at a time, since signals are the process's.
bool a_run_goes_on = false;

/// Does the work of a run on the device's thread, and throws what its callback threw. @param max_walltime  from now on,
/// s
RunEnd attend(const double max_walltime, const py::object& on_frame,
              const std::function<ExitCode(RunControl&, RunListener&)>& work) {
  RunEnd end;
  std::optional<ScriptListener> listener;
  const py::gil_scoped_release unlocked;
  run_on_device_thread([&] {
    if (a_run_goes_on)
      throw Error(ExitCode::usage, "a run cannot be begun by the on_frame of another one, which is not over yet");
    a_run_goes_on = true;
    try {
      RunControl control(RunControl::seconds_since_program_start() + max_walltime);
      listener.emplace(control, on_frame);
      end.is_done = work(control, *listener) == ExitCode::done;
      end.reason = control.reason();
      end.signal = control.signal();
    } catch (...) {
      a_run_goes_on = false;
      throw;
    }
    a_run_goes_on = false;
  });
  if (listener) listener->rethrow();
  return end;
}

void say_note(const RunLock& lock) {
  if (!lock.note().empty()) log_warning(lock.note());
}

RunEnd run(const NewRun& scene, const std::filesystem::path& file, const std::filesystem::path& folder,
           const bool overwrite, const double max_walltime, const py::object& on_frame) {
  return attend(max_walltime, on_frame, [&](RunControl& control, RunListener& listener) {
    std::optional<RunLock> lock;
    const RunFolder made = create_run_folder(scene, file, folder, overwrite, lock);
    say_note(*lock);
    return simulate(scene.placed.config, made, nullptr, control, listener, scene.what_happened);
  });
}

RunEnd resume(const std::filesystem::path& path, const Changes& changes, const bool from_start,
              const double max_walltime, const py::object& on_frame) {
  return attend(max_walltime, on_frame, [&](RunControl& control, RunListener& listener) {
    const RunFolder folder = RunFolder::open_begun(path);
    const RunLock lock(folder);
    say_note(lock);
    const Resumption run = prepare_resumption(folder, changes, from_start);
    if (!run.warnings.empty()) log_warning(run.warnings);
    if (!is_at_end(run.scene, run.point))
      return simulate(run.scene, folder, run.checkpoint(), control, listener, run.first_words);
    if (const std::string mended = mend_finished_run(run.scene, folder, *run.checkpoint()); !mended.empty())
      log_warning(mended + ": mended");
    return ExitCode::done;
  });
}

}  // namespace

void bind_runs(py::module_& module) {
  py::class_<RunEnd>(module, "RunEnd")
      .def_readonly("is_done", &RunEnd::is_done)
      .def_readonly("reason", &RunEnd::reason)
      .def_readonly("signal", &RunEnd::signal);
  module.def("run", &run, py::arg("scene"), py::arg("file"), py::arg("folder"), py::arg("overwrite"),
             py::arg("max_walltime"), py::arg("on_frame"));
  module.def("resume", &resume, py::arg("folder"), py::arg("changes"), py::arg("from_start"), py::arg("max_walltime"),
             py::arg("on_frame"));
  module.def("set_messages", &set_messages, py::arg("log_message"), py::arg("log_warning"));
}

}  // namespace skein
