#include "tests/support/network_namespace.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cstdlib>

namespace dripline::test_support {
namespace {

bool run_quietly(const std::string& command) {
  return ::system(("PATH=$PATH:/usr/sbin:/sbin; " + command + " >/dev/null 2>&1").c_str()) == 0;
}

/// A process in a network of its own; 0: not permitted.
int start_holder() {
  int ready[2];
  if (::pipe2(ready, O_CLOEXEC) != 0) return 0;
  const pid_t child = ::fork();
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const char answer = ::unshare(CLONE_NEWNET) == 0 ? 1 : 0;
    if (::write(ready[1], &answer, 1) != 1 || answer == 0) ::_exit(1);
    for (;;) ::pause();
  }
  char answer = 0;
  const bool has_read = ::read(ready[0], &answer, 1) == 1;
  ::close(ready[0]);
  ::close(ready[1]);
  if (has_read && answer == 1) return child;
  (void)::waitpid(child, nullptr, 0);
  return 0;
}

}  // namespace

NetworkNamespace::NetworkNamespace(int holder)
    : holder_(holder), path_(fmt::format("/proc/{}/ns/net", holder)) {}

std::unique_ptr<NetworkNamespace> NetworkNamespace::make() {
  const int holder = start_holder();
  if (holder == 0) return nullptr;
  std::unique_ptr<NetworkNamespace> made(new NetworkNamespace(holder));
  return made->ip("link set lo up") ? std::move(made) : nullptr;
}

NetworkNamespace::~NetworkNamespace() {
  ::kill(holder_, SIGKILL);
  (void)::waitpid(holder_, nullptr, 0);
}

bool NetworkNamespace::ip(const std::string& arguments) const {
  return run_quietly(fmt::format("nsenter --net={} ip {}", path_, arguments));
}

bool NetworkNamespace::connect(const NetworkNamespace& other, const std::string& own,
                               const std::string& its) const {
  return ip(fmt::format("link add cable type veth peer name cable netns {}", other.holder_)) &&
         ip(fmt::format("addr add {} dev cable", own)) && ip("link set cable up") &&
         other.ip(fmt::format("addr add {} dev cable", its)) && other.ip("link set cable up");
}

InNetwork::InNetwork(const std::string& path) {
  if (path.empty()) return;
  before_ = Descriptor(::open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC));
  const Descriptor there(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!there || ::setns(there.get(), CLONE_NEWNET) != 0) std::abort();
}

InNetwork::~InNetwork() {
  if (before_ && ::setns(before_.get(), CLONE_NEWNET) != 0) std::abort();
}

}  // namespace dripline::test_support
