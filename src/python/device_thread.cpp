#include "python/device_thread.hpp"

#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>

#include <unistd.h>

#include <condition_variable>
#include <deque>
#include <exception>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace skein {
namespace {

class DeviceThread {
 public:
  explicit DeviceThread(const int host_threads) {
    const auto beginning = std::make_shared<std::promise<void>>();  // of both threads: either may be done with it last
    auto begun = beginning->get_future();
    thread_ = std::thread([this, host_threads, beginning] { serve(host_threads, *beginning); });
    try {
      begun.get();
    } catch (...) {
      thread_.join();
      throw;
    }
  }
  ~DeviceThread() {
    post(nullptr);
    thread_.join();
  }
  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;

  bool is_this_thread() const { return std::this_thread::get_id() == thread_.get_id(); }
  bool is_of_this_process() const { return process_ == ::getpid(); }

  void post(std::function<void()> work) {
    {
      const std::lock_guard lock(mutex_);
      work_.push_back(std::move(work));
    }
    is_asked_.notify_one();
  }

 private:
  void serve(const int host_threads, std::promise<void>& beginning) {
    std::unique_ptr<Runtime> runtime;
    try {
      runtime = std::make_unique<Runtime>(host_threads);
    } catch (...) {
      return beginning.set_exception(std::current_exception());
    }
    beginning.set_value();
    while (const auto work = next()) work();
  }

  std::function<void()> next() {
    std::unique_lock lock(mutex_);
    is_asked_.wait(lock, [this] { return !work_.empty(); });
    auto work = std::move(work_.front());
    work_.pop_front();
    return work;
  }

  pid_t process_ = ::getpid();
  std::mutex mutex_;
  std::condition_variable is_asked_;
  std::deque<std::function<void()>> work_;  ///< an empty one: the end
  std::thread thread_;
};

int wanted_threads = 0;
std::mutex beginning_or_end;
std::unique_ptr<DeviceThread> device_thread;  ///< null before its first use and after its end

DeviceThread& find_device_thread() {
  const std::lock_guard lock(beginning_or_end);
  if (device_thread == nullptr) device_thread = std::make_unique<DeviceThread>(wanted_threads);
  if (!device_thread->is_of_this_process())
    throw Error(ExitCode::usage,
                "this process was forked from one in which skein had begun to compute, and has not its threads; start "
                "processes by multiprocessing's \"spawn\", or fork before anything is computed");
  return *device_thread;
}

}  // namespace

void set_device_threads(const int threads) {
  const std::lock_guard lock(beginning_or_end);
  if (device_thread != nullptr)
    throw Error(ExitCode::usage, "the number of threads is set before anything is computed; it cannot change later");
  wanted_threads = threads;
}

void run_on_device_thread(const std::function<void()>& work) {
  DeviceThread& thread = find_device_thread();
  if (thread.is_this_thread()) return work();
  const auto task = std::make_shared<std::packaged_task<void()>>(work);
  auto end = task->get_future();
  thread.post([task] { (*task)(); });
  end.get();
}

void leave_to_device_thread(std::function<void()> work) {
  const std::lock_guard lock(beginning_or_end);
  if (device_thread != nullptr && device_thread->is_of_this_process())
    device_thread->post(std::move(work));
  else  // the process ends, or was forked: what is held of the device can be given back to nobody
    static_cast<void>(new std::function<void()>(std::move(work)));
}

void end_device_thread() {
  std::unique_ptr<DeviceThread> ending;
  {
    const std::lock_guard lock(beginning_or_end);
    ending = std::move(device_thread);
  }
  if (ending != nullptr && !ending->is_of_this_process())
    static_cast<void>(ending.release());  // it is not there to end
}

}  // namespace skein
