#include "gateway/interpreter/dialects/centurion/codes/m_codes.hpp"

#include <array>

#include "protocol/base/invariant.hpp"

namespace dripline::interpreter::centurion {
namespace {

using Act = MAction;
using enum MTiming;

constexpr std::array kNamed{
    MRow{0, Act::ProgramStop, Flow, "program stop"},
    MRow{1, Act::OptionalStop, Flow, "optional stop"},
    MRow{2, Act::End, Flow, "end of program"},
    MRow{3, Act::SpindleClockwise, BeforeMove, "spindle on clockwise"},
    MRow{4, Act::SpindleCounterclockwise, BeforeMove, "spindle on counterclockwise"},
    MRow{5, Act::SpindleOff, AfterMove, "spindle off"},
    MRow{6, Act::ToolChange, AfterMove, "tool change"},
    MRow{8, Act::FloodOn, BeforeMove, "flood coolant on"},
    MRow{9, Act::CoolantOff, AfterMove, "coolants off"},
    MRow{30, Act::EndAllOff, Flow, "end of program, spindle and coolant off"},
    MRow{32, Act::WaitChannel, BeforeMove, "wait channel"},
    MRow{41, Act::SpindleRange, BeforeMove, "spindle range low"},
    MRow{42, Act::SpindleRange, BeforeMove, "spindle range medium"},
    MRow{43, Act::SpindleRange, BeforeMove, "spindle range high"},
    MRow{98, Act::Call, Flow, "program call"},
    MRow{99, Act::End, Flow, "end of program"},
};

constexpr std::array<MRow, kHighestM + 1> all_rows() {
  std::array<MRow, kHighestM + 1> rows{};
  for (std::size_t code = 0; code < rows.size(); ++code) {
    rows[code] = {static_cast<std::uint8_t>(code), Act::Strobe, BeforeMove, "machine function"};
  }
  struct Decade {
    std::size_t first;
    Act action;
    std::string_view name;
  };
  for (const Decade& decade :
       {Decade{20, Act::PulseAndWait, "output pulse, wait for input"},
        Decade{60, Act::SetOutput, "set output"}, Decade{70, Act::ClearOutput, "clear output"},
        Decade{80, Act::WaitInput, "wait for input"}}) {
    for (std::size_t code = decade.first; code < decade.first + 10; ++code) {
      rows[code].action = decade.action;
      rows[code].name = decade.name;
    }
  }
  for (const MRow& row : kNamed) rows[row.code] = row;
  return rows;
}
constexpr auto kRows = all_rows();

}  // namespace

const MRow& m_row(unsigned code) {
  invariant(code <= kHighestM, "M numbers are checked when they are read");
  return kRows[code];
}

}  // namespace dripline::interpreter::centurion
