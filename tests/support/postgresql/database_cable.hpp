#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace dripline::test {

/// The cable between one server and its database, which a test may pull: nothing passes then in
/// either direction, and nothing is closed. Thread-safe.
class DatabaseCable {
 public:
  /// `url`: of a TestDatabase.
  explicit DatabaseCable(const std::string& url);
  ~DatabaseCable();
  DatabaseCable(const DatabaseCable&) = delete;
  DatabaseCable& operator=(const DatabaseCable&) = delete;

  /// Of the same database, through the cable.
  const std::string& url() const { return url_; }
  void pull();
  void plug();

 private:
  struct Pump;
  std::unique_ptr<Pump> pump_;
  std::string url_;
};

}  // namespace dripline::test
