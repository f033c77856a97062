#include "tests/unit/clients/dnc/dnc_process.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

#include "protocol/base/invariant.hpp"

namespace dripline::test_support {
namespace {

/// A terminal whose other end collects what is written to it.
class PseudoTerminal {
 public:
  PseudoTerminal() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    const bool is_ready = ::grantpt(master_) == 0 && ::unlockpt(master_) == 0;
    invariant(is_ready, "there are pseudo terminals");
    path_ = ::ptsname(master_);
    slave_ = ::open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios as_it_is{};
    ::tcgetattr(slave_, &as_it_is);
    ::cfmakeraw(&as_it_is);
    ::tcsetattr(slave_, TCSANOW, &as_it_is);
    reader_ = std::thread([this] { read_to_end(); });
  }
  ~PseudoTerminal() {
    take_all();
    ::close(master_);
  }
  const std::string& path() const { return path_; }
  /// When no one else writes any more.
  const std::string& take_all() {
    if (!reader_.joinable()) return text_;
    ::close(slave_);
    reader_.join();
    return text_;
  }

 private:
  void read_to_end() {
    char piece[4096];
    for (ssize_t size = 0; (size = ::read(master_, piece, sizeof piece)) > 0;)
      text_.append(piece, static_cast<std::size_t>(size));
  }
  int master_, slave_ = -1;
  std::string path_, text_;
  std::thread reader_;
};

}  // namespace

std::vector<std::string> Dnc::command(const std::vector<std::string>& arguments) const {
  std::vector<std::string> all{
      "/usr/bin/env",       "-i", "-C", folder_.path().string(), "HOME=" + folder_.path().string(),
      "DRIPLINE_STATE=none"};
  for (const auto& [name, value] : environment) all.push_back(fmt::format("{}={}", name, value));
  all.push_back(program_);
  all.insert(all.end(), arguments.begin(), arguments.end());
  return all;
}

Finished Dnc::run_into(const std::string& out, const std::vector<std::string>& arguments) const {
  std::vector<std::string> all{"/bin/sh", "-c", "out=$1; shift; exec \"$@\" >\"$out\"", "sh", out};
  for (auto& word : command(arguments)) all.push_back(std::move(word));
  return run_to_end(all, folder_.path() / "stderr.txt");
}

DncResult Dnc::operator()(const std::vector<std::string>& arguments) const {
  const auto finished = run_into((folder_.path() / "stdout.txt").string(), arguments);
  return {finished.status, read("stdout.txt"), finished.output};
}

DncResult Dnc::on_terminal(const std::vector<std::string>& arguments) const {
  PseudoTerminal terminal;
  const auto finished = run_into(terminal.path(), arguments);
  return {finished.status, terminal.take_all(), finished.output};
}

ChildProcess Dnc::start(const std::vector<std::string>& arguments) const {
  return ChildProcess(command(arguments), folder_.path() / "started.txt");
}

std::string Dnc::write(const std::string& name, const std::string& text) const {
  const auto path = folder_.path() / name;
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
  return path.string();
}

std::string Dnc::read(const std::string& name) const {
  std::ifstream file(folder_.path() / name, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace dripline::test_support
