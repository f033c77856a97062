#include "clients/cli/text/standard_output.hpp"

#include <unistd.h>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "clients/cli/exit_status.hpp"

namespace dripline::cli {

Result<void> StandardOutput::write(std::string_view text) {
  std::fflush(stdout);  // what was printed before comes first
  while (!text.empty() && !error_) {
    const auto written = ::write(STDOUT_FILENO, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      is_closed_ = errno == EPIPE;
      error_ = Error{Errc::Io,
                     fmt::format("standard output cannot be written: {}", std::strerror(errno))};
      break;
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  if (error_) return fail(*error_);
  return {};
}

int StandardOutput::complain() const {
  return is_closed_ ? kExitClosedPipe : cli::complain(*error_);
}

}  // namespace dripline::cli
