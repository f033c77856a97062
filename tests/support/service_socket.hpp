#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "protocol/base/descriptor.hpp"
#include "tests/support/patience.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::test_support {

/// The socket of a service manager, which a daemon finds in NOTIFY_SOCKET.
class ServiceSocket {
 public:
  ServiceSocket();

  std::string path() const { return folder_.path() / "notify"; }
  /// The next message; nullopt when none comes in time.
  std::optional<std::string> receive(std::chrono::milliseconds limit = kPatience);

 private:
  TemporaryFolder folder_;
  Descriptor socket_;
};

}  // namespace dripline::test_support
