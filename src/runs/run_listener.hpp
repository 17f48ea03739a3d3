#pragma once

#include <skein/io/trajectory.hpp>

#include <cstdint>
#include <string>

namespace skein {

/// Who is told how a run goes: a terminal, a test, another program. Calls come from the thread that runs.
class RunListener {
 public:
  virtual ~RunListener() = default;

  /// Before the first step. @param time  at which this process goes on  @param evaluations  made before
  virtual void begin(double /*time*/, double /*end_time*/, std::int64_t /*evaluations*/) {}

  /// A message for people, of one line or several.
  virtual void say(const std::string& /*text*/) {}

  /// After every step.
  virtual void advance(double /*time*/, std::int64_t /*evaluations*/) {}

  /// A frame has been given to the trajectory.
  virtual void receive(const Frame& /*frame*/) {}

  /// The run is over, well or not: what was shown of its progress may be removed.
  virtual void end() {}
};

}  // namespace skein
