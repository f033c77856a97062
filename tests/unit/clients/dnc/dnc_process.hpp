#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::test_support {

/// What one call of the real `dnc` gave.
struct DncResult {
  int status = 0;
  std::string out, err;
};

/// Calls `dnc` in a folder of its own, with nothing of this process's environment.
class Dnc {
 public:
  explicit Dnc(std::string program) : program_(std::move(program)) {}

  std::map<std::string, std::string> environment;
  DncResult operator()(const std::vector<std::string>& arguments) const;
  /// The same with standard output on a terminal, which passes everything on as it is.
  DncResult on_terminal(const std::vector<std::string>& arguments) const;
  /// Starts it and returns; standard output and error go to the process's output.
  ChildProcess start(const std::vector<std::string>& arguments) const;

  std::filesystem::path folder() const { return folder_.path(); }
  std::string write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;

 private:
  Finished run_into(const std::string& out, const std::vector<std::string>& arguments) const;
  std::vector<std::string> command(const std::vector<std::string>& arguments) const;
  std::string program_;
  TemporaryFolder folder_;
};

}  // namespace dripline::test_support
