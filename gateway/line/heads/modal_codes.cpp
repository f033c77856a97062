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
    ModalCode{70, Diameter},
    ModalCode{80, Diameter},
    ModalCode{150, Polar},
    ModalCode{160, Polar},
    ModalCode{170, Plane},
    ModalCode{180, Plane},
    ModalCode{190, Plane},
    ModalCode{200, Units},
    ModalCode{210, Units},
    ModalCode{330, Motion},
    ModalCode{400, Compensation},
    ModalCode{410, Compensation, Resend::Never},
    ModalCode{411, Compensation, Resend::Never},
    ModalCode{420, Compensation, Resend::Never},
    ModalCode{421, Compensation, Resend::Never},
    ModalCode{430, Length, Resend::Word, "H"},
    ModalCode{431, Length, Resend::Block},
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
    ModalCode{960, SpeedMode, Resend::Word, "S"},
    ModalCode{970, SpeedMode, Resend::Word, "S"},
    ModalCode{980, ReturnLevel},
    ModalCode{990, ReturnLevel},
};

}  // namespace

const ModalCode* find_modal_code(int code) {
  const auto* found = std::ranges::lower_bound(kRows, code, {}, &ModalCode::code);
  return found == kRows.end() || found->code != code ? nullptr : found;
}

}  // namespace dripline::line
