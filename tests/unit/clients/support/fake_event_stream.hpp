#pragma once

#include <httplib.h>
#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

namespace dripline::test_support {

/// What was published, sent to every listener from its beginning. Any thread.
class FakeEventStream {
 public:
  void publish(const std::string& text);
  /// Ends the connection of one listener.
  void cut();
  /// Lets all listeners go; nothing is sent any more.
  void stop();

  /// Waits for the listener's next event and sends it; `next` counts what it has. False: the
  /// connection ends.
  bool send(httplib::DataSink& sink, std::size_t& next);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> events_;
  bool is_stopped_ = false, cuts_ = false;
};

}  // namespace dripline::test_support
