#pragma once

#include <skein/io/event_log.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/io/run_log.hpp>

#include "runs/run_listener.hpp"

#include <string>

namespace skein {

/// What a run says: to people in run.log and to its listener, to programs in events.jsonl.
class RunMessages {
 public:
  RunMessages(const RunFolder& folder, RunListener& listener)
      : log_(folder.run_log()), events_(folder.events()), listener_(listener) {}

  void say(const std::string& text) {
    log_.write(text);
    listener_.say(text);
  }
  /// In run.log alone.
  void note(const std::string& text) { log_.write(text); }
  EventLog& events() { return events_; }
  RunListener& listener() { return listener_; }

 private:
  RunLog log_;
  EventLog events_;
  RunListener& listener_;
};

}  // namespace skein
