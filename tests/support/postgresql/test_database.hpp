#pragma once

#include <memory>
#include <string>

namespace dripline::test {

/// A PostgreSQL database for one test, gone afterwards. The server is the one in the folder
/// that DRIPLINE_POSTGRESQL names (ctest starts it once for all tests), or one that lives as long
/// as this process.
class TestDatabase {
 public:
  /// Null where PostgreSQL is not installed.
  static std::unique_ptr<TestDatabase> make_empty();
  /// With the newest schema, as after the first start of a server; quicker.
  static std::unique_ptr<TestDatabase> make();
  TestDatabase(const TestDatabase&) = delete;
  TestDatabase& operator=(const TestDatabase&) = delete;
  ~TestDatabase();

  const std::string& url() const { return url_; }

 private:
  TestDatabase(std::string folder, std::string name);
  std::string folder_, name_, url_;
};

}  // namespace dripline::test
