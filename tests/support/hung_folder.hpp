#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/preload.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::test_support {

/// A hot folder `cam`, and its share, which does not answer when a server that is started meanwhile
/// moves a file there, until `answer`. One at a time.
class HungFolder {
 public:
  explicit HungFolder(const char* preloaded) {
    std::filesystem::create_directories(path());
    std::ofstream(folder_.path() / "dncd.toml")
        << "[[folder]]\nname = \"cam\"\npath = \"" << path().string()
        << "\"\ncontrol = \"fanuc\"\nunchanged_seconds = 0\npoll_seconds = 1\n";
    std::ofstream(hang()).flush();
    ::setenv("DRIPLINE_TEST_HANG", hang().c_str(), 1);
    ::setenv("LD_PRELOAD", preloaded, 1);
  }
  ~HungFolder() {
    ::unsetenv("LD_PRELOAD");
    ::unsetenv("DRIPLINE_TEST_HANG");
  }
  std::filesystem::path path() const { return folder_.path() / "cam"; }
  std::string argument() const { return "--config=" + (folder_.path() / "dncd.toml").string(); }
  void post(const std::string& name) const {
    const auto whole = path() / name;
    std::ofstream(whole.string() + ".part") << "O1\nG21 G90\nG1 X1. F100.\nM30\n";
    std::filesystem::rename(whole.string() + ".part", whole);
  }
  void answer() const { std::filesystem::remove(hang()); }

 private:
  std::filesystem::path hang() const { return folder_.path() / "hang"; }
  TemporaryFolder folder_;
};

}  // namespace dripline::test_support
