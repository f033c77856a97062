#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <utility>

namespace dripline::api {

/// Wakes a coroutine from other handlers of the same thread. It has one waiter.
class Signal {
 public:
  using Time = std::chrono::steady_clock::time_point;
  explicit Signal(boost::asio::io_context& io) : timer_(io) {}
  void set() {
    is_set_ = true;
    timer_.cancel();
  }
  /// True: the signal was set, and this wait resets it; false: `until` has passed.
  boost::asio::awaitable<bool> wait(Time until = Time::max()) {
    if (!is_set_) {
      timer_.expires_at(until);
      boost::system::error_code ignored;
      co_await timer_.async_wait(boost::asio::redirect_error(boost::asio::use_awaitable, ignored));
    }
    co_return std::exchange(is_set_, false);
  }

 private:
  boost::asio::steady_timer timer_;
  bool is_set_ = false;
};

}  // namespace dripline::api
