#include "gateway/line/heads/modal_codes.hpp"

#include <algorithm>
#include <array>

namespace dripline::line {
namespace {

using enum ModalGroup;

/// In order of the codes.
constexpr std::array kRows{
    ModalCode{0, Motion},
    ModalCode{10, Motion},
    ModalCode{20, Motion},
    ModalCode{30, Motion},
    ModalCode{50, LookAhead, Resend::Block},
    ModalCode{51, LookAhead, Resend::Block},
    ModalCode{70, Diameter},
    ModalCode{71, Interpolation, Resend::Never},
    ModalCode{80, Diameter},
    ModalCode{121, Interpolation, Resend::Never},
    ModalCode{131, Interpolation},
    ModalCode{150, Polar},
    ModalCode{160, Polar, Resend::Never},
    ModalCode{170, Plane},
    ModalCode{180, Plane},
    ModalCode{190, Plane},
    ModalCode{200, Units},
    ModalCode{210, Units},
    ModalCode{220, StrokeZone, Resend::Never},
    ModalCode{230, StrokeZone},
    ModalCode{330, Motion},
    ModalCode{400, Compensation},
    ModalCode{410, Compensation, Resend::Never},
    ModalCode{411, Compensation, Resend::Never},
    ModalCode{420, Compensation, Resend::Never},
    ModalCode{421, Compensation, Resend::Never},
    ModalCode{430, Length, Resend::Word, "H"},
    ModalCode{431, Length, Resend::Block},
    ModalCode{432, Length, Resend::Never},
    ModalCode{434, Length, Resend::Never},
    ModalCode{435, Length, Resend::Never},
    ModalCode{440, Length, Resend::Word, "H"},
    ModalCode{490, Length},
    ModalCode{500, Scale, Resend::Block},
    ModalCode{501, Mirror, Resend::Block},
    ModalCode{510, Scale, Resend::Block},
    ModalCode{511, Mirror, Resend::Block},
    ModalCode{520, LocalSystem, Resend::Block},
    ModalCode{540, WorkOffset, Resend::Word, "P"},
    ModalCode{541, WorkOffset, Resend::Word, "P"},
    ModalCode{550, WorkOffset},
    ModalCode{560, WorkOffset},
    ModalCode{570, WorkOffset},
    ModalCode{580, WorkOffset},
    ModalCode{590, WorkOffset},
    ModalCode{591, WorkOffset},
    ModalCode{592, WorkOffset},
    ModalCode{593, WorkOffset},
    ModalCode{610, PathMode},
    ModalCode{611, PathMode},
    ModalCode{620, PathMode},
    ModalCode{630, PathMode},
    ModalCode{640, PathMode, Resend::Word, "PQ"},
    ModalCode{660, ModalCall, Resend::Never},
    ModalCode{661, ModalCall, Resend::Never},
    ModalCode{670, ModalCall},
    ModalCode{680, Rotation, Resend::Block},
    ModalCode{682, Rotation, Resend::Never},
    ModalCode{683, Rotation, Resend::Never},
    ModalCode{684, Rotation, Resend::Never},
    ModalCode{690, Rotation},
    ModalCode{730, Cycle, Resend::Never},
    ModalCode{740, Cycle, Resend::Never},
    ModalCode{760, Cycle, Resend::Never},
    ModalCode{800, Cycle},
    ModalCode{810, Cycle, Resend::Never},
    ModalCode{820, Cycle, Resend::Never},
    ModalCode{830, Cycle, Resend::Never},
    ModalCode{840, Cycle, Resend::Never},
    ModalCode{850, Cycle, Resend::Never},
    ModalCode{860, Cycle, Resend::Never},
    ModalCode{870, Cycle, Resend::Never},
    ModalCode{880, Cycle, Resend::Never},
    ModalCode{890, Cycle, Resend::Never},
    ModalCode{900, Distance},
    ModalCode{901, ArcDistance},
    ModalCode{910, Distance},
    ModalCode{911, ArcDistance},
    ModalCode{920, Shift, Resend::Never},
    ModalCode{921, Shift},
    ModalCode{922, Shift},
    ModalCode{923, Shift, Resend::Never},
    ModalCode{930, FeedMode},
    ModalCode{940, FeedMode},
    ModalCode{950, FeedMode},
    ModalCode{960, SpeedMode, Resend::Word, "SD"},
    ModalCode{970, SpeedMode, Resend::Word, "S"},
    ModalCode{980, ReturnLevel},
    ModalCode{990, ReturnLevel},
    ModalCode{1070, Interpolation, Resend::Never},
    ModalCode{1120, Interpolation, Resend::Never},
    ModalCode{1130, Interpolation},
};

/// In order, too. Dwells, exact stops, reference points, probing, threads of one block, increased
/// moves, machine coordinates, calls, the cycles of lathes.
constexpr std::array kOneShots{40,  90,  100, 110, 270, 280, 281, 290, 300, 301, 310,
                               331, 370, 382, 383, 384, 385, 390, 450, 460, 470, 480,
                               530, 531, 600, 650, 700, 710, 720, 730, 740, 750, 760};

}  // namespace

const ModalCode* find_modal_code(int code) {
  const auto* found = std::ranges::lower_bound(kRows, code, {}, &ModalCode::code);
  return found == kRows.end() || found->code != code ? nullptr : found;
}

bool is_one_shot_code(int code) {
  return std::ranges::binary_search(kOneShots, code);
}

}  // namespace dripline::line
