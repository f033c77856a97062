#include "tests/support/child_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>
#include <utility>

#include "protocol/base/invariant.hpp"

namespace dripline::test_support {
namespace {

[[noreturn]] void become(const std::vector<std::string>& command,
                         const std::filesystem::path& output) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int file = ::open(output.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  ::dup2(file, STDOUT_FILENO);
  ::dup2(file, STDERR_FILENO);
  std::vector<char*> argv;
  argv.reserve(command.size() + 1);
  for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

int exit_status(int wait_status) {
  return WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : 128 + WTERMSIG(wait_status);
}

std::string read_all(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, std::filesystem::path output)
    : output_(std::move(output)) {
  pid_ = ::fork();
  invariant(pid_ >= 0, "a process can be started");
  if (pid_ == 0) become(command, output_);
}

ChildProcess::~ChildProcess() {
  if (pid_ > 0) kill();
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      status_(other.status_),
      output_(std::move(other.output_)) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  if (this == &other) return *this;
  if (pid_ > 0) kill();
  pid_ = std::exchange(other.pid_, -1);
  status_ = other.status_;
  output_ = std::move(other.output_);
  return *this;
}

void ChildProcess::signal(int number) const {
  if (!status_ && pid_ > 0) ::kill(pid_, number);
}

void ChildProcess::kill() {
  if (status_ || pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  int status = 0;
  if (::waitpid(pid_, &status, 0) == pid_) status_ = exit_status(status);
}

std::optional<int> ChildProcess::wait(std::chrono::milliseconds limit) {
  eventually([this] { return !is_running(); }, limit);
  return status_;
}

bool ChildProcess::is_running() {
  if (status_ || pid_ <= 0) return false;
  int status = 0;
  if (::waitpid(pid_, &status, WNOHANG) == pid_) status_ = exit_status(status);
  return !status_;
}

std::string ChildProcess::output() const {
  return read_all(output_);
}

std::uint64_t ChildProcess::peak_memory() const {
  std::istringstream status(read_all("/proc/" + std::to_string(pid_) + "/status"));
  for (std::string word; status >> word;) {
    std::uint64_t kilobytes = 0;
    if (word == "VmHWM:" && status >> kilobytes) return kilobytes * 1024;
  }
  return 0;
}

Finished run_to_end(const std::vector<std::string>& command, const std::filesystem::path& output,
                    std::chrono::milliseconds limit) {
  std::filesystem::remove(output);
  ChildProcess process(command, output);
  if (const auto status = process.wait(limit)) return {*status, process.output()};
  process.kill();
  return {137, process.output()};
}

void wait_a_little() {
  std::this_thread::sleep_for(std::chrono::milliseconds(3));
}

}  // namespace dripline::test_support
