#pragma once

#include <map>
#include <string>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/machine/grbl/reply.hpp"
#include "gateway/machine/streamed/text_rules.hpp"
#include "protocol/base/result.hpp"

namespace dripline::machine::grbl {

using streamed::Coordinates;

/// What the board states about itself at connect: `$I`, `$$` and `$#`. Value type.
class BoardInfo {
 public:
  // -- filled by the replies, in any order --------------------------------------------------------
  void take(const Greeting& greeting);
  void take(const BuildReply& build) { build_ = build; }
  void take(const AxesReply& axes) { letters_ = axes.letters; }
  void take(const SettingReply& setting) { settings_[setting.number] = setting.value; }
  void take(const OffsetReply& offset) { offsets_[offset.name] = offset.value; }

  /// Everything that a run needs is known, and the board can run programs. Errors: Unsupported
  /// (what the board lacks or how it is set), Conflict (no work offset is zero).
  Result<void> check() const;

  // -- what they mean -----------------------------------------------------------------------------
  std::string firmware() const;  ///< "Grbl 1.1f"
  std::size_t axes() const;      ///< those with a $100 setting
  // `axis` counts them in the board's order.
  char letter(std::size_t axis) const;  ///< as it states, else X, Y, Z, A, B, C
  double steps(std::size_t axis) const { return setting(100, axis); }     ///< per mm or degree
  double max_rate(std::size_t axis) const { return setting(110, axis); }  ///< per minute
  double acceleration(std::size_t axis) const {
    return setting(120, axis);
  }  ///< per second squared
  bool is_grbl_hal() const { return is_grbl_hal_; }
  /// It has reference points ($22).
  bool homes() const { return (static_cast<unsigned>(setting_or(22, 0)) & 1U) != 0; }
  bool has_line_numbers() const { return has_letter('N'); }
  int planner_blocks() const { return build_ ? build_->blocks : 0; }
  /// N words from 1 to this are enough to tell the lines apart that the board may hold.
  std::uint32_t line_numbers() const;
  /// Bytes that may be unanswered: one less than the receive buffer, which some builds need. What
  /// is in it cannot be taken back, so that of a large buffer only a part is used.
  std::size_t window() const;
  /// How its lines are written.
  streamed::TextRules rules() const;
  /// Millimetres of one unit of the reports ($13).
  double report_scale() const { return setting_or(13, 0) != 0 ? 25.4 : 1; }
  /// The work coordinate system whose zero is the machine's: "G54". Empty: there is none.
  std::string work_system() const;
  /// Of `work_system`, or one that is in force beside it: the first offset that is not zero.
  std::string offset_beside(const std::string& work_system) const;
  /// A report's position in millimetres and degrees.
  Coordinates in_mm(const AxisValues& values) const;

 private:
  Result<void> check_settings() const;
  Result<void> check_axes() const;
  /// Its number among those of programs; nullopt: they have no such axis.
  std::optional<std::size_t> number_of(std::size_t axis) const;
  double seconds_ahead() const;
  streamed::TextRules::AxisRules axis_rules(std::size_t axis) const;
  /// In machine coordinates, where soft limits ($20) make it known.
  std::optional<streamed::TextRules::Range> travel(std::size_t axis) const;
  double setting_or(int number, double otherwise) const;
  double setting(int first, std::size_t axis) const {
    return setting_or(first + static_cast<int>(axis), 0);
  }
  bool has_letter(char letter) const {
    return build_ && build_->letters.find(letter) != std::string::npos;
  }

  std::string version_;
  bool is_grbl_hal_ = false;
  std::optional<BuildReply> build_;
  std::string letters_;  ///< of its axes, where it states them
  std::map<int, double> settings_;
  std::map<std::string, AxisValues> offsets_;
};

}  // namespace dripline::machine::grbl
