#include "gateway/interpreter/dialects/centurion/codes/m_codes.hpp"

#include <array>

#include "gateway/interpreter/dialects/centurion/codes/machine_functions.hpp"
#include "protocol/base/invariant.hpp"

namespace dripline::interpreter::centurion {
namespace {

using enum MTiming;

constexpr std::array kNamed{
    MRow{0, Flow, "program stop", stop_program},
    MRow{1, Flow, "optional stop", stop_if_switched_on},
    MRow{2, Flow, "end of program"},
    MRow{3, BeforeMove, "spindle on clockwise", start_spindle},
    MRow{4, BeforeMove, "spindle on counterclockwise", start_spindle},
    MRow{5, AfterMove, "spindle off", stop_spindle},
    MRow{6, AfterMove, "tool change", change_tool_or_call},
    MRow{8, BeforeMove, "flood coolant on", start_coolant},
    MRow{9, AfterMove, "coolants off", stop_coolant},
    MRow{30, Flow, "end of program, spindle and coolant off"},
    MRow{32, BeforeMove, "wait channel", wait_for_channel},
    MRow{41, BeforeMove, "spindle range low", strobe},
    MRow{42, BeforeMove, "spindle range medium", strobe},
    MRow{43, BeforeMove, "spindle range high", strobe},
    MRow{98, Flow, "program call"},
    MRow{99, Flow, "end of program"},
};

constexpr std::array<MRow, kHighestM + 1> all_rows() {
  std::array<MRow, kHighestM + 1> rows{};
  for (std::size_t code = 0; code < rows.size(); ++code) {
    rows[code] = {static_cast<std::uint8_t>(code), BeforeMove, "machine function", strobe};
  }
  struct Decade {
    std::size_t first;
    std::string_view name;
    bool (*apply)(Run&, const MRow&);
  };
  // M20 to M29 pulse X output n, with X output 12 on meanwhile, and wait for X input n.
  for (const Decade& decade :
       {Decade{20, "output pulse, wait for input", wait_for_x_input},
        Decade{60, "set output", set_x_output}, Decade{70, "clear output", set_x_output},
        Decade{80, "wait for input", wait_for_x_input}}) {
    for (std::size_t code = decade.first; code < decade.first + 10; ++code) {
      rows[code].name = decade.name;
      rows[code].apply = decade.apply;
    }
  }
  for (const MRow& row : kNamed) rows[row.code] = row;
  return rows;
}
constexpr auto kMRows = all_rows();

}  // namespace

const MRow& m_row(unsigned code) {
  invariant(code <= kHighestM, "M numbers are checked when they are read");
  return kMRows[code];
}

}  // namespace dripline::interpreter::centurion
