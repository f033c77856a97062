#pragma once

#include <sys/stat.h>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "server/folders/hot_folder.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::folders {

namespace fs = std::filesystem;

inline constexpr const char* kGood = "O1\nG21 G90\nG0 X10.\nG1 Y5. F100.\nM30\n";
inline constexpr const char* kAlarm = "O1\nG21 G90\nG1 X10. F100.\nG999\nM30\n";

/// One hot folder, `cam`, of a control fanuc, looked at by hand.
class HotFolderTest : public server_test::ServerTest {
 protected:
  HotFolderTest() {
    catalog_.known.push_back("fanuc");
    add_machine("mill-1", "fanuc");
    fs::create_directories(path());
    settings_.name = "cam";
    settings_.path = path();
    settings_.machine = "mill-1";
    make();
  }
  fs::path path() const { return folder_.path() / "cam"; }

  void make() {
    hot_ = std::make_unique<HotFolder>(
        HotFolder::Parts{
            .programs = *programs_,
            .catalog = catalog_,
            .sources = {.store = *store_, .releases = *releases_, .clock = clock_},
            .spool = folder_.path(),
            .own_folders = own_folders_,
            .on_fault = [this](const std::string&, const std::string& fault) { fault_ = fault; },
            .on_file = [this](const storage::FolderFile& file) { files_.push_back(file); }},
        settings_);
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(path() / name, std::ios::binary) << text;
  }
  void look(const Arrivals& arrivals = {}) { hot_->look(arrivals, {}); }
  /// Looks, waits the time in which a file must not change, and looks again.
  void look_twice() {
    look();
    clock_.advance(settings_.unchanged_time);
    look();
  }
  std::string reason(const std::string& name) {
    std::stringstream text;
    text << std::ifstream(path() / "failed" / (name + ".reason.txt")).rdbuf();
    return text.str();
  }
  std::size_t revisions(const std::string& program) {
    const auto found = store_->programs.revisions(program);
    return found ? found->size() : 0;
  }
  std::string refused(const std::string& name) {
    look_twice();
    EXPECT_TRUE(fs::exists(fs::symlink_status(path() / "failed" / name))) << name;
    EXPECT_FALSE(fs::exists(fs::symlink_status(path() / name))) << name;
    return reason(name);
  }

  FolderSettings settings_;
  std::vector<fs::path> own_folders_;
  std::unique_ptr<HotFolder> hot_;
  std::string fault_;
  std::vector<storage::FolderFile> files_;
};

}  // namespace dripline::folders
