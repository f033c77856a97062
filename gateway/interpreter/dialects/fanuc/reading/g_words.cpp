#include "gateway/interpreter/dialects/fanuc/reading/g_words.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/fanuc/reading/call_arguments.hpp"
#include "gateway/interpreter/dialects/fanuc/tilting/tilting.hpp"

namespace dripline::interpreter::fanuc {
namespace {

/// Of two codes of one group the last one is in force. With a call in the block, what follows are
/// its arguments.
void warn_of_two(Block& block, std::uint32_t column, std::uint8_t first, std::uint8_t last) {
  const bool is_call = first == 65 || last == 65 || first == 66 || last == 66;
  if (!is_call) block.warn(WarningCode::SameGroup, column);
}

/// Codes with a point, and those of three digits that mean the same.
std::uint8_t find_written(double value) {
  const double tenths = std::round(value * 10);
  if (std::fabs(value * 10 - tenths) > 1e-6) return Block::kNoCode;
  const auto* at = std::find_if(kCodesWithPoint.begin(), kCodesWithPoint.end(),
                                [tenths](const WrittenCode& row) { return row.tenths == tenths; });
  return at == kCodesWithPoint.end() ? Block::kNoCode : at->code;
}

bool refuse_g(Run& run, const Word& word) {
  const auto tenths = static_cast<int>(std::clamp(std::round(word.value * 10), 0.0, 1e6));
  const bool is_five_axis =
      std::find(kFiveAxisCodes.begin(), kFiveAxisCodes.end(), tenths) != kFiveAxisCodes.end();
  std::string text = fmt::format("G{}", word.value);
  if (tenths == 842 || tenths == 843)
    text +=
        " is of the 11M and of later controls in Series 15 format (rigid_tap_codes); M29 and G84 "
        "here";
  if (is_five_axis) {
    text += run.options.kinematics.exists()
                ? " is not known here; of tilting machines there are G43.4, G43.5, G53.1 and G68.2"
                : " needs the kinematics of a tilting machine, which this control's setup does "
                  "not have";
  }
  return run.fail(ErrorCode::ImproperG, word.column, text);
}

}  // namespace

bool add_g(Run& run, const Word& word) {
  Block& block = run.block;
  std::uint8_t code = Block::kNoCode;
  if (word.form == WordForm::Point && word.value != std::trunc(word.value)) {
    code = find_written(word.value);
  } else {
    Word whole = word;
    if (whole.form == WordForm::Point) whole.form = WordForm::Whole;
    if (whole.is_negative && whole.form == WordForm::Whole) {
      return run.fail(ErrorCode::NegativeSign, word.column);
    }
    const double value = run.whole(whole);
    if (calls_macro_by_g(run, value)) [[unlikely]]
      return begin_code_call(run, CodeCall::G, value, word.column);
    constexpr double kEnd = 100;
    if (value >= 0 && value < kEnd) [[likely]] {
      code = static_cast<std::uint8_t>(value);
      if (run.options.is_lathe) {
        code = kCodeTables[static_cast<std::size_t>(run.options.code_system)][code];
      }
    } else {
      code = find_written(value);
    }
  }
  const std::uint8_t group = group_of(code);
  const bool is_known = group != kNoGroup &&
                        (!needs_kinematics(code) || run.options.kinematics.exists()) &&
                        (!is_rigid_tap(code) || run.options.has_rigid_tap_codes);
  if (!is_known) [[unlikely]]
    return refuse_g(run, word);
  block.parts.g_column = word.column;
  if (group == kOneShot) {
    if (block.parts.one_shot != Block::kNoCode && block.parts.one_shot != code) [[unlikely]]
      warn_of_two(block, word.column, block.parts.one_shot, code);
    block.parts.one_shot = code;
    return code != 65 || begin_call(run, false, word.column);
  }
  if (block.names(static_cast<Group>(group)) && block.g[group] != code) [[unlikely]]
    warn_of_two(block, word.column, block.g[group], code);
  block.parts.groups |= 1u << group;
  block.g[group] = code;
  if (group == kMotionGroup || group == kCycleGroup) block.parts.last_motion_group = group;
  return code != 66 || begin_call(run, true, word.column);
}

}  // namespace dripline::interpreter::fanuc
