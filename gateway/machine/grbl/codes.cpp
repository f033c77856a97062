#include "gateway/machine/grbl/codes.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace dripline::machine::grbl {
namespace {

struct CodeRow {
  int code;
  std::string_view text;
};

constexpr std::array kAlarms{
    CodeRow{1, "a limit switch was hit: the position is lost, home the axes"},
    CodeRow{2, "a target is outside the travel: the axes have stopped, the position is kept"},
    CodeRow{3, "the board was reset while it moved: the position is lost, home the axes"},
    CodeRow{4, "the probe was not in its rest state when the probe move began"},
    CodeRow{5, "the probe met nothing on its way"},
    CodeRow{6, "homing failed: it was reset"},
    CodeRow{7, "homing failed: the door was opened"},
    CodeRow{8, "homing failed: the limit switch did not open after the pull-off"},
    CodeRow{9, "homing failed: no limit switch was found"},
    CodeRow{10, "the emergency stop is active"},
    CodeRow{11, "the axes must be homed first"},
    CodeRow{12, "a limit switch is active"},
    CodeRow{13, "the probe protection has tripped"},
    CodeRow{14, "the spindle did not reach its speed in time"},
    CodeRow{15, "homing failed: the second switch of the axis was not found"},
    CodeRow{16, "the self-test at power-up failed"},
    CodeRow{17, "a motor driver reports a fault"},
};

constexpr std::array kErrors{
    CodeRow{1, "a word without its letter"},
    CodeRow{2, "a number is missing or malformed"},
    CodeRow{3, "an unknown $ command"},
    CodeRow{4, "a negative value where only a positive one is possible"},
    CodeRow{5, "homing is not enabled ($22)"},
    CodeRow{6, "the step pulse is too short ($0)"},
    CodeRow{7, "the stored settings could not be read, defaults are in force"},
    CodeRow{8, "the command needs a board at rest (Idle)"},
    CodeRow{9, "the board is locked by an alarm or jogs: no G-code is taken"},
    CodeRow{10, "soft limits need homing ($20, $22)"},
    CodeRow{11, "the line is too long for the board"},
    CodeRow{12, "the step rate is higher than the board can make"},
    CodeRow{13, "the safety door is open"},
    CodeRow{14, "a stored line is too long"},
    CodeRow{15, "the jog target is outside the travel"},
    CodeRow{16, "a jog command is malformed"},
    CodeRow{17, "laser mode needs a PWM output"},
    CodeRow{18, "the emergency stop is active"},
    CodeRow{20, "the firmware does not know a command of the line"},
    CodeRow{21, "two commands of one modal group in a line"},
    CodeRow{22, "no feed is in force"},
    CodeRow{23, "a command needs a whole number"},
    CodeRow{24, "two commands of the line use the axis words"},
    CodeRow{25, "a word occurs twice in a line"},
    CodeRow{26, "the axis words are missing"},
    CodeRow{27, "the line number is out of range"},
    CodeRow{28, "a command lacks a word that it needs"},
    CodeRow{29, "the work offset does not exist on the board"},
    CodeRow{30, "G53 is possible with G0 and G1 only"},
    CodeRow{31, "axis words that no command uses"},
    CodeRow{32, "the arc has no axis word in its plane"},
    CodeRow{33,
            "the target of a move is invalid: an arc that no circle passes, or a probe move "
            "without length"},
    CodeRow{34, "the radius of the arc is impossible"},
    CodeRow{35, "the arc has no center in its plane"},
    CodeRow{36, "words that no command uses"},
    CodeRow{37, "the tool length offset is for another axis"},
    CodeRow{38, "the tool number is too high"},
    CodeRow{39, "a parameter is out of range"},
    CodeRow{45, "soft limits are in force and the axes are not homed"},
    CodeRow{60, "the storage card could not be mounted"},
    CodeRow{79, "the alarm needs a reset or homing: unlocking is not possible"},
};

std::string_view find(std::span<const CodeRow> rows, int code, std::string_view unknown) {
  const auto found = std::ranges::find(rows, code, &CodeRow::code);
  return found == rows.end() ? unknown : found->text;
}

}  // namespace

std::string_view alarm_text(int code) {
  return find(kAlarms, code, "an alarm that only the firmware's manual explains");
}

bool keeps_position(int alarm) {
  constexpr int kOutsideTravel = 2, kProbeNotAtRest = 4, kNoContact = 5;
  return alarm == kOutsideTravel || alarm == kProbeNotAtRest || alarm == kNoContact;
}

std::string_view error_text(int code) {
  return find(kErrors, code, "an error that only the firmware's manual explains");
}

}  // namespace dripline::machine::grbl
