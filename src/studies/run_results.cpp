#include "studies/run_results.hpp"

#include <skein/io/array_file.hpp>
#include <skein/io/folder_listing.hpp>

#include <fmt/format.h>

#include <vector>

namespace skein {
namespace {

/// What the numbers stand for, in their order.
std::string list_quantities() {
  std::string names;
  for (const MeasuredQuantity& quantity : list_run_quantities()) names += fmt::format("{} ", quantity.name);
  names += "fiber:";
  for (const MeasuredQuantity& quantity : list_fiber_quantities()) names += fmt::format(" {}", quantity.name);
  return names;
}

}  // namespace

bool fails_always(const ExitCode code) {
  return code == ExitCode::numerical || code == ExitCode::scene_error || code == ExitCode::internal;
}

void write_run_result(const std::filesystem::path& file, const RunResult& result) {
  const auto as_list = [](const char* name, const std::vector<double>& values) {
    return NamedArray{name, "", {values.size()}, values};
  };
  write_array_file(file,
                   {as_list("exit_code", {static_cast<double>(result.code)}), as_list("of_run", result.measures.of_run),
                    as_list("of_fibers", result.measures.of_fibers)},
                   {{"names", list_quantities()}, {"message", result.message.empty() ? "none" : result.message}});
}

std::optional<RunResult> read_run_result(const std::filesystem::path& file) {
  if (!is_there(file)) return std::nullopt;
  try {
    if (read_array_attribute(file, "names") != list_quantities()) return std::nullopt;
    RunResult result;
    const auto code = read_array(file, "exit_code");
    if (code.size() != 1) return std::nullopt;
    result.code = static_cast<ExitCode>(static_cast<int>(code[0]));
    result.message = read_array_attribute(file, "message");
    result.measures = {read_array(file, "of_run"), read_array(file, "of_fibers")};
    if (result.code != ExitCode::done) return result;
    const std::size_t n_of_run = result.measures.of_run.size(), n_of_fibers = result.measures.of_fibers.size();
    const bool is_whole = n_of_run == list_run_quantities().size() && n_of_fibers > 0 &&
                          n_of_fibers % list_fiber_quantities().size() == 0;
    return is_whole ? std::optional(result) : std::nullopt;
  } catch (const Error& error) {
    if (error.code() != ExitCode::damaged_data) throw;
    return std::nullopt;
  }
}

}  // namespace skein
