#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "protocol/base/result.hpp"

namespace dripline::gateway {

enum class EmergencyStop : std::uint8_t { Released, PressedFromNetwork, PressedAtPanel };

/// The emergency stop of a gateway, in a file: pressed, it outlives the process, however that ends.
/// The file is made at the first start and written in place, so that a full disk does not keep it
/// from being written. What cannot be understood is a stop that was pressed at the panel.
/// One thread.
class KeptEmergencyStop {
 public:
  /// An empty path: it lives as long as the process.
  explicit KeptEmergencyStop(std::filesystem::path file);

  bool is_pressed() const { return state_ != EmergencyStop::Released; }
  bool is_pressed_at_panel() const { return state_ == EmergencyStop::PressedAtPanel; }
  /// One that was pressed at the panel stays so until it is released. In force in any case; without
  /// an error it is on disk. Errors: Io.
  Result<void> press(bool is_at_panel);
  Result<void> release() { return keep(EmergencyStop::Released); }

 private:
  Result<void> keep(EmergencyStop state);
  Result<void> write() const;

  std::filesystem::path file_;
  EmergencyStop state_ = EmergencyStop::Released;
  bool is_on_disk_ = false;
};

/// What its switch is answered with.
std::string answer_of_press(const Result<void>& kept);
std::string answer_of_release(const Result<void>& kept);

}  // namespace dripline::gateway
