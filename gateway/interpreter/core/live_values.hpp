#pragma once

#include <string>
#include <vector>

namespace dripline::interpreter {

/// An interpreter whose control shows values while a program runs and forgets them afterwards, as a
/// TNC's Q parameters; found by dynamic_cast, because some have none.
class LiveValues {
 public:
  virtual ~LiveValues() = default;
  /// The control's own names. While a program runs the list may grow at its end, and changes in no
  /// other place.
  virtual std::vector<std::string> live_names() const = 0;
  /// Their numbers in that order, as the block finished last has left them. False, and `values` as
  /// they are: nothing has been set since the call before. More numbers than before: there are more
  /// names.
  virtual bool read_live(std::vector<double>& values) = 0;
};

}  // namespace dripline::interpreter
