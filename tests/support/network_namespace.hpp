#pragma once

#include <memory>
#include <string>
#include <vector>

#include "protocol/base/descriptor.hpp"
#include "tests/support/child_process.hpp"

namespace dripline::test_support {

/// A network of a test's own, with nothing but loopback in it. It ends with this object.
class NetworkNamespace {
 public:
  /// Null where such a thing is not permitted, or `ip` and `nsenter` are not there.
  static std::unique_ptr<NetworkNamespace> make();
  NetworkNamespace(const NetworkNamespace&) = delete;
  NetworkNamespace& operator=(const NetworkNamespace&) = delete;
  ~NetworkNamespace();

  const std::string& path() const { return path_; }
  /// `ip ARGUMENTS` in it; whether that was done.
  bool ip(const std::string& arguments) const;
  /// A cable from `own` here to `its` there, with these addresses; whether it could be made.
  bool connect(const NetworkNamespace& other, const std::string& own, const std::string& its) const;

 private:
  explicit NetworkNamespace(int holder);
  const int holder_;  ///< a process that keeps it
  const std::string path_;
};

/// The calling thread, and what it starts, is in this network while the object lives. An empty path
/// changes nothing.
class InNetwork {
 public:
  explicit InNetwork(const std::string& path);
  InNetwork(const InNetwork&) = delete;
  InNetwork& operator=(const InNetwork&) = delete;
  ~InNetwork();

 private:
  Descriptor before_;  ///< none: nothing was changed
};

}  // namespace dripline::test_support
