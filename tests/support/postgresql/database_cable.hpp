#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace dripline::test {

/// The cable between one server and its database, which a test may pull: nothing passes then in
/// either direction, and nothing is closed. Or it is slow: all connections share its rate, packet
/// by packet. Thread-safe.
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
  /// Bytes a second in each direction; 0: as many as there are.
  void set_rate(std::uint64_t bytes_per_second);

 private:
  struct Pump;
  std::unique_ptr<Pump> pump_;
  std::string url_;
};

}  // namespace dripline::test
