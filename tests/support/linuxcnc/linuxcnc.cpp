#include "tests/support/linuxcnc/linuxcnc.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

namespace dripline::test_support {
namespace {

namespace fs = std::filesystem;

void write_file(const fs::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

std::string read_file(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

void replace(std::string& text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
}

}  // namespace

std::string LinuxCnc::missing() {
  if (!fs::exists("/usr/bin/linuxcnc")) return "linuxcnc-uspace is not installed";
  const char* reason = std::getenv("DRIPLINE_NAMESPACES");
  if (reason == nullptr) return "this test program has no namespaces of its own";
  return reason;
}

LinuxCnc::LinuxCnc() {
  // A gateway has another home than LinuxCNC, as a service has, and no file in it.
  ::setenv("HOME", "/nonexistent", 1);
  const fs::path example = "deploy/examples/linuxcnc";
  for (const char* name : {"mill.ini", "mill.hal", "tool.tbl", "no_display", "start"})
    fs::copy_file(example / name, folder_.path() / name);
  std::string ini = read_file(folder_.path() / "mill.ini");
  replace(ini, "HALFILE = mill.hal", "HALFILE = mill.hal\nHALFILE = witness.hal");
  write_file(folder_.path() / "mill.ini", ini);
  write_file(folder_.path() / "witness.hal",
             "loadrt sampler depth=8192 cfg=sfff\n"
             "addf sampler.0 servo-thread\n"
             "net line motion.program-line => sampler.0.pin.0\n"
             "net x => sampler.0.pin.1\n"
             "net y => sampler.0.pin.2\n"
             "net z => sampler.0.pin.3\n"
             "net loop motion.digital-out-01 => motion.digital-in-02\n"
             "net level motion.analog-out-01 => motion.analog-in-02\n"
             "loadusr ./witness\n");
  write_file(folder_.path() / "witness", "#!/bin/sh\nexec stdbuf -oL halsampler >witness.txt\n");
  fs::permissions(folder_.path() / "witness", fs::perms::owner_all | fs::perms::others_exec);
  fs::permissions(folder_.path(), fs::perms::group_exec | fs::perms::others_exec,
                  fs::perm_options::add);
}

LinuxCnc::~LinuxCnc() {
  stop();
}

void LinuxCnc::set_tools(const std::string& table) const {
  write_file(folder_.path() / "tool.tbl", table);
}

void LinuxCnc::add_to_ini(const std::string& section, const std::string& lines) const {
  std::string ini = read_file(this->ini());
  replace(ini, "[" + section + "]\n", "[" + section + "]\n" + lines + "\n");
  write_file(this->ini(), ini);
}

void LinuxCnc::count_in_inches() const {
  std::string ini = read_file(this->ini());
  replace(ini, "LINEAR_UNITS = mm", "LINEAR_UNITS = inch");
  write_file(this->ini(), ini);
}

void LinuxCnc::add_function(int code) const {
  const fs::path path = folder_.path() / fmt::format("M{}", code);
  write_file(path, fmt::format("#!/bin/sh\necho \"$@\" >{}.arguments\n", path.string()));
  fs::permissions(path, fs::perms::owner_all | fs::perms::others_exec | fs::perms::others_read);
}

std::string LinuxCnc::arguments_of(int code) const {
  std::string text = read_file(folder_.path() / fmt::format("M{}.arguments", code));
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

void LinuxCnc::stop() {
  if (!process_) return;
  const std::string pid = read_file(folder_.path() / "display.pid");
  if (!pid.empty()) ::kill(std::atoi(pid.c_str()), SIGTERM);
  (void)process_->wait();
  process_.reset();
  fs::remove(folder_.path() / "display.pid");
}

void LinuxCnc::start() {
  begin_ = 0;
  fs::remove(folder_.path() / "witness.txt");
  // Each has a home of its own: the part with the motors listens there.
  process_.emplace(std::vector<std::string>{"/usr/bin/env", "HOME=" + folder_.path().string(),
                                            "TMPDIR=" + folder_.path().string(),
                                            folder_.path() / "start", ini()},
                   folder_.path() / "linuxcnc.log");
  ASSERT_TRUE(eventually([&] { return fs::exists(folder_.path() / "display.pid"); },
                         std::chrono::seconds(30)))
      << log();
}

void LinuxCnc::kill(const std::string& process, const std::string& signal) const {
  (void)run_to_end({"/usr/bin/killall", signal, process}, folder_.path() / "killall.log");
}

std::string LinuxCnc::log() const {
  return read_file(folder_.path() / "linuxcnc.log");
}

std::vector<LinuxCnc::Sample> LinuxCnc::samples() const {
  std::vector<Sample> samples;
  std::ifstream file(folder_.path() / "witness.txt");
  file.seekg(static_cast<std::streamoff>(begin_));
  for (std::string line; std::getline(file, line) && !file.eof();) {
    std::istringstream words(line);
    Sample sample;
    if (!(words >> sample.line >> sample.at[0] >> sample.at[1] >> sample.at[2])) continue;
    if (samples.empty() || samples.back().line != sample.line || samples.back().at != sample.at)
      samples.push_back(sample);
  }
  return samples;
}

std::vector<std::array<double, 3>> LinuxCnc::ends() const {
  std::vector<std::array<double, 3>> ends;
  const auto all = samples();
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i].line != all[i - 1].line) ends.push_back(all[i - 1].at);
  if (!all.empty()) ends.push_back(all.back().at);
  return ends;
}

/// From a whole line on.
void LinuxCnc::reset() {
  constexpr std::uintmax_t kLine = 200;
  const auto path = folder_.path() / "witness.txt";
  const auto size = fs::exists(path) ? fs::file_size(path) : 0;
  begin_ = size > kLine ? size - kLine : 0;
  std::ifstream file(path);
  file.seekg(static_cast<std::streamoff>(begin_));
  std::string part;
  if (begin_ > 0 && std::getline(file, part)) begin_ += part.size() + 1;
}

std::array<double, 3> LinuxCnc::position() const {
  LinuxCnc::Sample last;
  constexpr std::streamoff kTail = 400;
  std::ifstream file(folder_.path() / "witness.txt", std::ios::ate);
  const std::streamoff size = file.tellg();
  file.seekg(std::max<std::streamoff>(0, size - kTail));
  std::string line;
  if (size > kTail) std::getline(file, line);
  while (std::getline(file, line) && !file.eof()) {
    std::istringstream words(line);
    Sample sample;
    if (words >> sample.line >> sample.at[0] >> sample.at[1] >> sample.at[2]) last = sample;
  }
  return last.at;
}

bool LinuxCnc::rests(std::chrono::milliseconds time) const {
  constexpr std::chrono::seconds kDead{2};
  const auto path = folder_.path() / "witness.txt";
  const auto written = [&] { return fs::exists(path) ? fs::file_size(path) : 0; };
  const auto before = position();
  const std::uintmax_t begin = written();
  const std::uintmax_t enough = static_cast<std::uintmax_t>(time.count()) * line_bytes();
  auto grown = begin;
  auto last = std::chrono::steady_clock::now();
  while (written() < begin + enough) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const auto now = std::chrono::steady_clock::now();
    if (written() != grown) {
      grown = written();
      last = now;
    }
    if (now - last > kDead) break;
  }
  return position() == before;
}

/// Of a line of the witness, as they are now.
std::uintmax_t LinuxCnc::line_bytes() const {
  std::ifstream file(folder_.path() / "witness.txt");
  std::string line;
  return std::getline(file, line) ? line.size() + 1 : 1;
}

}  // namespace dripline::test_support
