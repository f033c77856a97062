#include "protocol/process/stop_signals.hpp"

#include <pthread.h>
#include <algorithm>

#include <sys/resource.h>

namespace dripline::process {

sigset_t block_stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGHUP);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  return signals;
}

Result<void> require_open_files(std::uint64_t least) {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= least) return {};
  if (limit.rlim_max >= least) {
    limit.rlim_cur = least;
    if (::setrlimit(RLIMIT_NOFILE, &limit) == 0) return {};
  }
  return fail(Errc::LimitExceeded,
              "this process may open {} files, it needs at least {}: raise the limit (ulimit -n, "
              "LimitNOFILE)",
              std::min(limit.rlim_cur, limit.rlim_max), least);
}

}  // namespace dripline::process
