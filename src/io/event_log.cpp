#include <skein/core/json.hpp>
#include <skein/io/event_log.hpp>

#include <cmath>

namespace skein {

EventLog::EventLog(const std::filesystem::path& path) : file_(path), start_(std::chrono::steady_clock::now()) {}

void EventLog::write(const std::string_view event, const Fields& fields) {
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  JsonWriter json;
  json.begin_object().member("event", event).member("wall", std::round(1e3 * wall) / 1e3);
  for (const auto& [name, value] : fields)
    std::visit([&json, &name = name](const auto& content) { json.member(name, content); }, value);
  file_.write_line(json.end_object().take());
}

}  // namespace skein
