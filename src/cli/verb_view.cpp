#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>
#include <skein/io/listed_segments.hpp>
#include <skein/io/run_check.hpp>
#include <skein/io/run_folder.hpp>

#include "cli/check_text.hpp"
#include "cli/common_arguments.hpp"
#include "cli/fresh_tables.hpp"
#include "cli/plot_scripts.hpp"
#include "cli/verbs.hpp"
#include "runs/flow_samples.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

namespace skein {
namespace {

namespace fs = std::filesystem;

struct PageOptions {
  std::string folder, output;
};

/// A folder for what the script reads, gone with the object.
class ScratchFolder {
 public:
  ScratchFolder() : path_((fs::temp_directory_path() / "skein-page-XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr)
      throw Error(ExitCode::cannot_create, fmt::format("no folder can be made in '{}': {}",
                                                       fs::path(path_).parent_path().string(), std::strerror(errno)));
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  fs::path operator/(const char* name) const { return fs::path(path_) / name; }

 private:
  std::string path_;
};

/// The page's path, whose folder is there then. @param name  in the run's folder of pictures, without -o
fs::path prepare_output(const PageOptions& options, const RunFolder& run, const char* name) {
  const fs::path page = fs::absolute(options.output.empty() ? run.plots() / name : fs::path(options.output));
  if (!options.output.empty()) check_output(page, run);
  std::error_code error;
  fs::create_directories(page.parent_path(), error);
  if (error)
    throw Error(ExitCode::cannot_create,
                fmt::format("'{}' cannot be made: {}", page.parent_path().string(), error.message()));
  return page;
}

/// What is wrong with the run, its certificate, and what it did.
void write_report_texts(const PageOptions& options, const std::string& summary, const fs::path& file) {
  const RunCheck check = check_run(options.folder);
  std::ofstream texts(file);
  texts << "# What the fibers did\n" << summary << "\n# Certificate\n";
  for (const std::string& problem : check.problems) texts << problem << '\n';
  texts << describe_check(check);
}

int write_page(const PageOptions& options, const bool is_report) {
  const RunFolder run = RunFolder::open(options.folder);
  check_listed_segments(run);  // the script believes what it reads
  const fs::path page = prepare_output(options, run, is_report ? "report.html" : "view.html");
  const ScratchFolder scratch;
  std::vector<std::string> arguments{fs::absolute(options.folder).string(), "--output=" + page.string()};
  // A run whose page goes elsewhere is only read.
  const fs::path tables = options.output.empty() ? run.analysis() : scratch / "analysis";
  {
    const Runtime runtime;
    if (is_report) {
      write_report_texts(options, write_fresh_tables(options.folder, tables), scratch / "texts");
      arguments.push_back("--report=" + (scratch / "texts").string());
      arguments.push_back("--tables=" + fs::absolute(tables).string());
    } else if (const auto fresh = refresh_tables(options.folder, tables)) {
      arguments.push_back("--tables=" + fs::absolute(*fresh).string());
    }
    if (write_flow_samples(run, scratch / "flow.csv")) arguments.push_back("--flow=" + (scratch / "flow.csv").string());
  }
  return run_plot_script("view_run.py", arguments);
}

}  // namespace

Verb make_view_verb() {
  const auto options = std::make_shared<PageOptions>();
  return {
      "view",
      "Show a run in a browser: fibers in three dimensions, played",
      {make_folder_argument(&options->folder),
       make_argument("-o,--output", &options->output, "FILE", "The page; DIR/plots/view.html without")},
      "Examples:\n"
      "  skein view tumbling\n"
      "  skein view tumbling -o tumbling.html\n"
      "One file, which needs neither a server nor a network: open it from the disk, or send it. The run is analyzed\n"
      "first ('skein analyze') if it has changed since the last time; with -o nothing is written into its folder.",
      [options] { return write_page(*options, false); }};
}

Verb make_report_verb() {
  const auto options = std::make_shared<PageOptions>();
  return {"report",
          "The same page with all pictures, what was measured and the certificate",
          {make_folder_argument(&options->folder),
           make_argument("-o,--output", &options->output, "FILE", "The page; DIR/plots/report.html without")},
          "Examples:\n"
          "  skein report tumbling\n"
          "  skein report tumbling -o for_a_colleague.html\n"
          "It holds what 'skein view', 'skein plot', 'skein analyze' and 'skein verify' show, and the scene.",
          [options] { return write_page(*options, true); }};
}

}  // namespace skein
