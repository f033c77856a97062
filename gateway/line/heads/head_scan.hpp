#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "gateway/line/heads/modal_scan.hpp"
#include "gateway/line/heads/place_finder.hpp"
#include "protocol/base/result.hpp"

namespace dripline::line {

/// What becomes of the words before a run's beginning that the rest relies on.
enum class HeadChoice : std::uint8_t {
  Ask,   ///< the run is refused, and they are named
  Send,  ///< they are sent first
  Set,   ///< the operator confirms that they are in force at the control
};

/// The blocks of a head, to be shown in one line.
std::string head_in_one_line(std::string head);

/// Reads a program from its first byte, in pieces, and determines what must be sent before its rest
/// from `place` on. Bounded memory; pure.
class HeadScan {
 public:
  HeadScan(std::string_view control, const ProgramPlace& place) : scan_(control), place_(place) {}

  /// False: no more is needed.
  bool take(std::string_view piece);
  /// After the last piece, or when no more was needed.
  void end();
  /// The blocks to be sent first; empty: none. Errors: Conflict (the rest relies on words before
  /// it: they are named, and what can be done; or some of them cannot be sent again).
  Result<std::string> head(HeadChoice choice) const;

 private:
  bool take(char c);
  bool end_block();

  ModalScan scan_;
  const ProgramPlace place_;
  std::uint64_t at_ = 0;
  std::string block_;
  bool is_decided_ = false;
};

}  // namespace dripline::line
