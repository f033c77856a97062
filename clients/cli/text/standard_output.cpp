#include "clients/cli/text/standard_output.hpp"

#include <unistd.h>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "clients/cli/exit_status.hpp"
#include "clients/lib/output_file.hpp"

namespace dripline::cli {

StandardOutput::StandardOutput(Content content) {
  const bool is_terminal = terminal_of(STDOUT_FILENO).is_terminal;
  if (content == Content::Text || (content == Content::Data && is_terminal)) visible_.emplace();
}

Result<void> StandardOutput::write(std::string_view text) {
  write_bytes(visible_ ? visible_->take(text) : text);
  if (error_) return fail(*error_);
  return {};
}

void StandardOutput::write_bytes(std::string_view bytes) {
  std::fflush(stdout);  // what was printed before comes first
  while (!bytes.empty() && !error_) {
    const auto written = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      is_closed_ = errno == EPIPE;
      error_ = Error{Errc::Io, fmt::format("standard output cannot be written: {}",
                                           std::generic_category().message(errno))};
      break;
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

int StandardOutput::complain() const {
  return is_closed_ ? kExitClosedPipe : cli::complain(*error_);
}

Result<void> write_file(const std::string& path, std::string_view bytes) {
  auto file = client::OutputFile::create(path);
  if (!file) return fail(file.error());
  if (auto written = file->write(bytes); !written) return written;
  return file->commit();
}

int write_to(const std::string& path, std::string_view text, Content content) {
  if (path.empty() || path == "-") {
    StandardOutput output(content);
    return output.write(text) ? kExitOk : output.complain();
  }
  const auto written = write_file(path, text);
  return written ? kExitOk : complain(written.error());
}

int save_content(const std::string& path,
                 const std::function<client::Reply<void>(const ContentSink&)>& fetch) {
  if (path.empty() || path == "-") {
    StandardOutput output;
    const auto fetched =
        fetch([&](std::string_view bytes) { return output.write(bytes).has_value(); });
    if (output.error()) return output.complain();
    return fetched ? kExitOk : cli::complain(fetched.error());
  }
  auto file = client::OutputFile::create(path);
  if (!file) return complain(file.error());
  Result<void> written;
  const auto fetched = fetch([&](std::string_view bytes) {
    written = file->write(bytes);
    return written.has_value();
  });
  if (!written) return complain(written.error());
  if (!fetched) return complain(fetched.error());
  const auto kept = file->commit();
  return kept ? kExitOk : complain(kept.error());
}

}  // namespace dripline::cli
