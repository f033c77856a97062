#include "gateway/machine/linuxcnc/helper_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>

#include "gateway/machine/linuxcnc/helper_text.hpp"

extern char** environ;  // NOLINT(readability-redundant-declaration): unistd.h has it for GNU only

namespace dripline::machine::linuxcnc {
namespace {

/// The system's: LinuxCNC's module is built for it.
constexpr const char* kPython = "/usr/bin/python3";

struct SpawnSettings {
  posix_spawnattr_t attributes{};
  posix_spawn_file_actions_t actions{};
  explicit SpawnSettings(int descriptor) {
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, descriptor, 0);
    posix_spawn_file_actions_adddup2(&actions, descriptor, 1);
    sigset_t none;
    sigset_t usual;
    sigemptyset(&none);
    sigemptyset(&usual);
    sigaddset(&usual, SIGPIPE);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
};

}  // namespace

Result<HelperProcess> HelperProcess::start(const std::string& ini) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends.data()) != 0)
    return fail(Errc::Io, "a socket for the helper: {}", std::generic_category().message(errno));
  Descriptor ours(ends[0]);
  const Descriptor theirs(ends[1]);
  // The helper's side waits.
  (void)::fcntl(theirs.get(), F_SETFL, ::fcntl(theirs.get(), F_GETFL) & ~O_NONBLOCK);
  const SpawnSettings settings(theirs.get());
  std::string python = kPython, option = "-c", text(kHelperText), path = ini;
  std::array<char*, 5> arguments{python.data(), option.data(), text.data(), path.data(), nullptr};
  pid_t pid = -1;
  const int failed = ::posix_spawn(&pid, kPython, &settings.actions, &settings.attributes,
                                   arguments.data(), environ);
  if (failed != 0)
    return fail(Errc::Io, "{}: {}", kPython, std::generic_category().message(failed));
  return HelperProcess(pid, std::move(ours));
}

HelperProcess::~HelperProcess() {
  if (pid_ < 0) return;
  socket_ = Descriptor();
  for (int i = 0; i < 100; ++i) {
    if (::waitpid(pid_, nullptr, WNOHANG) != 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ::kill(pid_, SIGKILL);
  (void)::waitpid(pid_, nullptr, 0);
}

bool HelperProcess::read(std::string& to) {
  std::array<char, 4096> room{};
  for (;;) {
    const ssize_t got = ::recv(socket_.get(), room.data(), room.size(), MSG_DONTWAIT);
    if (got > 0)
      to.append(room.data(), static_cast<std::size_t>(got));
    else if (got == 0)
      return false;
    else
      return errno == EAGAIN || errno == EINTR;
    if (to.size() > 256 * 1024) return true;
  }
}

bool HelperProcess::write(std::string& from) {
  while (!from.empty()) {
    const ssize_t sent =
        ::send(socket_.get(), from.data(), from.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent < 0) return errno == EAGAIN || errno == EINTR;
    from.erase(0, static_cast<std::size_t>(sent));
  }
  return true;
}

}  // namespace dripline::machine::linuxcnc
