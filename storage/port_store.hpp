#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

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

/// Promises of every store: storage/store.hpp.
class PortStore {
 public:
  virtual ~PortStore() = default;

  /// Adds or changes one. Errors: Syntax and LimitExceeded (names, settings, rules), Busy (the
  /// address is another port's, named).
  virtual Result<void> save(const Port& port) = 0;
  /// In order of their names.
  virtual Result<std::vector<Port>> list() = 0;
  /// Errors: NotFound.
  virtual Result<void> remove(const std::string& name) = 0;
};

}  // namespace dripline::storage
