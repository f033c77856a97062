#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "protocol/base/name_lookup.hpp"

namespace dripline::test_support {

/// Of a name server that is silent. It ends with the test, which it outlives otherwise.
class SilentLookup {
 public:
  ~SilentLookup() { state_->give_up(); }
  NameLookup lookup() const {
    return [state = state_](const std::string&) {
      state->wait();
      return Result<HostAddresses>(fail(Errc::NotFound, "no answer"));
    };
  }
  bool is_asked() const { return state_->is_asked; }

 private:
  struct State {
    std::atomic<bool> is_asked = false, is_over = false;
    void give_up() {
      is_over = true;
      is_over.notify_all();
    }
    void wait() {
      is_asked = true;
      is_over.wait(false);
    }
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

}  // namespace dripline::test_support
