#pragma once

#include <memory>
#include <string>

namespace dripline::test {

/// A PostgreSQL server of one test's own, whose end, return and silence are the test's. Failures
/// are reported through gtest assertions.
class TestCluster {
 public:
  /// Null where PostgreSQL is not installed.
  static std::unique_ptr<TestCluster> make();
  TestCluster(const TestCluster&) = delete;
  TestCluster& operator=(const TestCluster&) = delete;
  ~TestCluster();

  /// Of an empty database.
  std::string url() const;
  /// It ends at once, and whatever is in progress is undone.
  void stop() { control("stop"); }
  void start() { control("start"); }
  /// It answers nothing, and closes nothing.
  void freeze();
  void thaw();

 private:
  explicit TestCluster(std::string folder) : folder_(std::move(folder)) {}
  void control(const std::string& what) const;
  std::string folder_;
  bool is_frozen_ = false;
};

}  // namespace dripline::test
