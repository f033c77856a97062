#pragma once

#include <filesystem>

namespace dripline::test_support {

/// A new empty folder below the system's temporary folder, removed with everything in it at the end
/// of scope. DRIPLINE_KEEP=1 keeps it, for looking at what a failed test left after.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace dripline::test_support
