#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

namespace dripline::storage {

/// A serial line to a machine's control, as configured.
struct Port {
  std::string name;
  std::string machine;        ///< the machine at its end
  std::string address;        ///< /dev/ttyUSB0, tcp://host:port, rfc2217://host:port
  std::string line_template;  ///< a control's usual line, may be empty
  std::vector<std::pair<std::string, std::string>> settings;  ///< key, value; over the template's
  std::string rules;  ///< what a text from the control means (TOML), may be empty
  bool is_enabled = true;
  std::string host = {};  ///< the computer that has the device; empty: not known, or none has
};
inline constexpr std::size_t kMaxPortSettings = 64;
inline constexpr std::size_t kMaxPortRules = 32 * 1024;

enum class TransferDirection : std::uint8_t { Send, Receive };  ///< seen from the server
enum class TransferState : std::uint8_t { Active, Completed, Aborted, Interrupted };
std::string_view to_string(TransferDirection direction);
std::string_view to_string(TransferState state);

/// Programs that go to a control, or come from it, without a run.
struct PortTransfer {
  std::string port;
  TransferDirection direction = TransferDirection::Send;
  std::string id;
  std::vector<std::string> programs;  ///< as people read them; none of what has no name yet
  std::uint64_t size = 0;             ///< bytes; 0: not known
  std::uint64_t passed = 0;           ///< bytes that have passed the line for certain
  std::uint64_t at_most = 0;          ///< bytes that may have passed it
  TransferState state = TransferState::Active;
  std::string reason = {};  ///< why it was not completed, for people
  UtcTime began;
  std::optional<UtcTime> ended = {};  ///< when it is not Active any more
  /// The newest run of the machine when it began, empty: there was none; stored by save_transfer.
  /// Absent: not known (before version 24).
  std::optional<std::string> after_run = {};

  friend bool operator==(const PortTransfer&, const PortTransfer&) = default;
};

/// Promises of every store: storage/store.hpp.
class PortStore {
 public:
  virtual ~PortStore() = default;

  /// Adds or changes one. Errors: Syntax and LimitExceeded (names, settings, rules), Busy (the
  /// address is another port's, named).
  virtual Result<void> save(const Port& port) = 0;
  /// In order of their names.
  virtual Result<std::vector<Port>> list() = 0;
  /// With its transfers. Errors: NotFound.
  virtual Result<void> remove(const std::string& name) = 0;
  /// Adds it, or replaces the port's one of that direction. Errors: NotFound (port), Syntax (the
  /// end of one that is active, or none of one that is over).
  virtual Result<void> save_transfer(const PortTransfer& transfer) = 0;
  /// Of an active one: a later save_transfer is never overtaken, another id changes nothing.
  virtual Result<void> note_progress(const PortTransfer& transfer) = 0;
  /// Drops it, if it is still the port's latest of that direction.
  virtual Result<void> drop_transfer(const PortTransfer& transfer) = 0;
  /// The latest of each direction.
  virtual Result<std::vector<PortTransfer>> transfers(const std::string& port) = 0;
};

}  // namespace dripline::storage
