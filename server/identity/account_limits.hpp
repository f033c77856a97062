#pragma once

#include <chrono>
#include <cstddef>

namespace dripline::identity {

struct AccountLimits {
  static constexpr std::size_t kMinPassword = 10;    ///< bytes
  static constexpr std::size_t kMaxPassword = 1024;  ///< bytes
  static constexpr std::size_t kMaxName = 64;
  static constexpr std::size_t kMaxUsers = 10'000;
  static constexpr std::size_t kMaxCredentials = 100;  ///< of a user
  static constexpr std::size_t kMaxSessions = 20;      ///< of a user; the oldest one makes room
  static constexpr std::size_t kMaxGroups = 1000;
  static constexpr std::size_t kMaxMachines = 10'000;  ///< of a group
  static constexpr std::chrono::days kMaxTokenLife{730};
  static constexpr std::chrono::hours kMaxSessionLife{720};
};

}  // namespace dripline::identity
