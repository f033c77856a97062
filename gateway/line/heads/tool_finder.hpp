#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/line/heads/scan_block.hpp"

namespace dripline::line {

/// Finds the first block that changes to a tool: with M6 and its T, or the M6 after its T (on a
/// Fanuc lathe the T itself), the event of a ProtoTRAK or the TOOL CALL of a TNC that names it.
/// Words are read, not interpreted: a block that begins with `/` is none, since the panel decides
/// on it, nor is one after the end of the first program. Pure; one thread.
class ToolFinder {
 public:
  /// `control`: the machine's dialect. Empty: as most controls are.
  ToolFinder(std::string_view control, std::uint64_t tool);
  /// A block of the program, in order, without its line end.
  bool is_change(std::string_view block);

 private:
  bool is_tool_call(std::string_view block) const;
  bool is_event_with_tool(const ScannedBlock& block) const;
  std::optional<std::uint64_t> tool_of(const ScannedBlock& block) const;

  const std::uint64_t tool_;
  const interpreter::TextForm::Kind form_;
  const bool is_turret_;        ///< T changes by itself
  const bool has_offset_in_t_;  ///< T0303
  bool is_next_ = false;        ///< its T has been read, and no M6 yet
  bool is_over_ = false;
};

}  // namespace dripline::line
