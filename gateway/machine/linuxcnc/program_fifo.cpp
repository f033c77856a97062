#include "gateway/machine/linuxcnc/program_fifo.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace dripline::machine::linuxcnc {
namespace {

/// The smallest there is: what the pipe has is ahead of the motion.
constexpr int kPipeBytes = 4096;

}  // namespace

ProgramFifo::ProgramFifo(std::filesystem::path folder)
    : folder_(std::move(folder)), path_(folder_ / "program.ngc") {}

ProgramFifo& ProgramFifo::operator=(ProgramFifo&& other) noexcept {
  std::swap(folder_, other.folder_);
  std::swap(path_, other.path_);
  std::swap(pending_, other.pending_);
  pipe_ = std::move(other.pipe_);
  return *this;
}

ProgramFifo::~ProgramFifo() {
  remove_name();
}

void ProgramFifo::remove_name() {
  if (folder_.empty()) return;
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
  std::filesystem::remove(folder_, ignored);
  folder_.clear();
}

Result<ProgramFifo> ProgramFifo::create() {
  std::error_code no_folder;
  std::string name = std::filesystem::temp_directory_path(no_folder) / "dripline-linuxcnc-XXXXXX";
  if (no_folder || ::mkdtemp(name.data()) == nullptr)
    return fail(Errc::Io, "a folder for LinuxCNC's program: {}",
                std::generic_category().message(errno));
  ProgramFifo fifo{std::filesystem::path(name)};
  if (::mkfifo(fifo.path_.c_str(), 0600) != 0)
    return fail(Errc::Io, "{}: {}", fifo.path_, std::generic_category().message(errno));
  fifo.pipe_ = Descriptor(::open(fifo.path_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
  if (!fifo.pipe_)
    return fail(Errc::Io, "{}: {}", fifo.path_, std::generic_category().message(errno));
  (void)::fcntl(fifo.pipe_.get(), F_SETPIPE_SZ, kPipeBytes);
  return fifo;
}

bool ProgramFifo::is_dry() const {
  int waiting = 0;
  return pending_.empty() && ::ioctl(pipe_.get(), FIONREAD, &waiting) == 0 && waiting == 0;
}

/// A write of at most PIPE_BUF bytes is done whole or not at all.
void ProgramFifo::write(std::string_view text) {
  pending_ += text;
  constexpr std::size_t kPiece = PIPE_BUF / 8;
  while (!pending_.empty()) {
    const std::size_t end =
        pending_.size() <= kPiece ? pending_.size() - 1 : pending_.rfind('\n', kPiece - 1);
    const ssize_t written = ::write(pipe_.get(), pending_.data(), end + 1);
    if (written <= 0) return;
    pending_.erase(0, static_cast<std::size_t>(written));
  }
}

}  // namespace dripline::machine::linuxcnc
