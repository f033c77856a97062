#include "gateway/interpreter/dialects/centurion/codes/g_codes.hpp"

namespace dripline::interpreter::centurion {
namespace {

using enum Address;
using Group = ModalGroup;
using Act = GAction;

constexpr AddressSet kNone = 0;
constexpr AddressSet kAllWords = (AddressSet{1} << kAddressCount) - 1;
constexpr AddressSet kHoleWords = set_of(R, Z);
constexpr AddressSet kGrooveWords = set_of(R, Z, X, V, Q, E, U, D, A, C);
constexpr AddressSet kRoughingWords = set_of(P, Q, U, W, I, K, V, D, R);
constexpr AddressSet kMultipleThreadWords = set_of(X, Z, U, W, I, Q, D, A, P, K);

constexpr std::array kRows{
    GRow{0, Group::Motion, Act::Motion, kLineWords, "positioning"},
    GRow{1, Group::Motion, Act::Motion, kLineWords, "linear interpolation"},
    GRow{2, Group::Motion, Act::Motion, kLineWords, "circular interpolation clockwise"},
    GRow{3, Group::Motion, Act::Motion, kLineWords, "circular interpolation counterclockwise"},
    GRow{4, Group::OneShot, Act::Dwell, kNone, "dwell"},
    GRow{9, Group::OneShot, Act::ExactStop, kNone, "exact stop"},
    GRow{10, Group::Data, Act::DataOn, kNone, "set data on"},
    GRow{11, Group::Data, Act::DataOff, kNone, "set data off"},
    GRow{12, Group::OneShot, Act::ClearFloatingZero, kNone, "clear floating zero"},
    GRow{18, Group::OneShot, Act::None, kNone, "ZX plane"},
    GRow{20, Group::Units, Act::Inch, kNone, "inch"},
    GRow{21, Group::Units, Act::Metric, kNone, "metric"},
    GRow{22, Group::SafeZone, Act::SafeZone, kNone, "safe zone check on"},
    GRow{23, Group::SafeZone, Act::SafeZone, kNone, "safe zone check off"},
    GRow{28, Group::OneShot, Act::FirstReference, kEndWords, "reference return"},
    GRow{29, Group::OneShot, Act::ReturnFromReference, kEndWords, "return from reference"},
    GRow{30, Group::OneShot, Act::OtherReference, kEndWords | set_of(P),
         "return to 2nd-4th reference"},
    GRow{32, Group::OneShot, Act::ThreadLine, set_of(E, Q), "thread line"},
    GRow{34, Group::OneShot, Act::ThreadLine, set_of(E, Q), "thread line of variable lead"},
    GRow{35, Group::OneShot, Act::ThreadLine, set_of(E, Q), "thread line"},
    GRow{36, Group::OneShot, Act::ThreadLine, set_of(E, Q), "thread line"},
    GRow{38, Group::ReturnLevel, Act::InitialLevel, kNone, "return to initial level"},
    GRow{39, Group::ReturnLevel, Act::ClearanceLevel, kNone, "return to R level"},
    GRow{40, Group::Compensation, Act::Compensation, kNone, "nose compensation off"},
    GRow{41, Group::Compensation, Act::Compensation, kNone, "nose compensation left"},
    GRow{42, Group::Compensation, Act::Compensation, kNone, "nose compensation right"},
    GRow{45, Group::OneShot, Act::Retract, kNone, "Z to clearance"},
    GRow{46, Group::OneShot, Act::Retract, kNone, "X to clearance"},
    GRow{47, Group::OneShot, Act::Retract, kNone, "Z to tool change position"},
    GRow{48, Group::OneShot, Act::Retract, kNone, "X to tool change position"},
    GRow{49, Group::OneShot, Act::CancelToolLength, kNone, "cancel tool length offsets"},
    GRow{50, Group::OneShot, Act::FloatingZero, set_of(X, Z), "set floating zero"},
    GRow{52, Group::OneShot, Act::LocalZero, set_of(X, Z), "local coordinates"},
    GRow{53, Group::OneShot, Act::MachineCoordinates, set_of(X, Z), "machine coordinates"},
    GRow{54, Group::WorkSystem, Act::WorkSystem, kNone, "work system 1"},
    GRow{55, Group::WorkSystem, Act::WorkSystem, kNone, "work system 2"},
    GRow{56, Group::WorkSystem, Act::WorkSystem, kNone, "work system 3"},
    GRow{57, Group::WorkSystem, Act::WorkSystem, kNone, "work system 4"},
    GRow{58, Group::WorkSystem, Act::WorkSystem, kNone, "work system 5"},
    GRow{59, Group::WorkSystem, Act::WorkSystem, kNone, "work system 6"},
    GRow{60, Group::OneShot, Act::SingleDirection, kLineWords, "single direction rapid"},
    GRow{61, Group::PathMode, Act::PathMode, kNone, "exact stop mode"},
    GRow{63, Group::PathMode, Act::PathMode, kNone, "tapping mode"},
    GRow{64, Group::PathMode, Act::PathMode, kNone, "cutting mode"},
    GRow{65, Group::OneShot, Act::MacroCall, kAllWords, "macro call or non-movement block"},
    GRow{70, Group::OneShot, Act::PatternCycle, set_of(P, Q), "finish cycle"},
    GRow{71, Group::OneShot, Act::PatternCycle, kRoughingWords, "rough turning"},
    GRow{72, Group::OneShot, Act::PatternCycle, kRoughingWords, "rough facing"},
    GRow{73, Group::OneShot, Act::PatternCycle, set_of(P, Q, U, W, I, K, D), "pattern repeat"},
    GRow{74, Group::OneShot, Act::FaceGroove, kGrooveWords | set_of(I), "face grooving"},
    GRow{75, Group::OneShot, Act::DiameterGroove, kGrooveWords | set_of(K), "diameter grooving"},
    GRow{76, Group::OneShot, Act::MultipleThread, kMultipleThreadWords, "multiple thread cycle"},
    GRow{80, Group::Cycle, Act::None, kNone, "cancel canned cycle"},
    GRow{81, Group::OneShot, Act::DrillingCycle, kHoleWords, "drill"},
    GRow{82, Group::OneShot, Act::DrillingCycle, kHoleWords | set_of(P), "drill with dwell"},
    GRow{83, Group::OneShot, Act::DrillingCycle, kHoleWords | set_of(V, Q, E), "peck drill"},
    GRow{84, Group::OneShot, Act::DrillingCycle, kHoleWords, "tap"},
    GRow{85, Group::OneShot, Act::DrillingCycle, kHoleWords, "bore"},
    GRow{86, Group::OneShot, Act::DrillingCycle, kHoleWords, "bore with spindle stop"},
    GRow{89, Group::OneShot, Act::DrillingCycle, kHoleWords | set_of(P), "bore with dwell"},
    GRow{90, Group::OneShot, Act::TurningBox, set_of(X, Z, U, W, I), "turning cycle"},
    GRow{91, Group::Distance, Act::Incremental, kNone, "incremental"},
    GRow{92, Group::OneShot, Act::SingleThread, set_of(X, Z, U, W, I, Q), "thread cycle"},
    GRow{93, Group::Distance, Act::Absolute, kNone, "absolute"},
    GRow{94, Group::OneShot, Act::FacingBox, set_of(X, Z, U, W, K), "facing cycle"},
    GRow{96, Group::SpindleUnit, Act::SurfaceSpeed, kNone, "constant surface speed"},
    GRow{97, Group::SpindleUnit, Act::Revolutions, kNone, "revolutions per minute"},
    GRow{98, Group::FeedUnit, Act::FeedPerMinute, kNone, "feed per minute"},
    GRow{99, Group::FeedUnit, Act::FeedPerRevolution, kNone, "feed per revolution"},
    GRow{501, Group::Mirror, Act::MirrorOff, kNone, "mirror off"},
    GRow{511, Group::Mirror, Act::Mirror, set_of(X, Z), "mirror on"},
    GRow{550, Group::Scaling, Act::ScalingOff, kNone, "scaling off"},
    GRow{551, Group::Scaling, Act::Scaling, set_of(I, K, X, Z, P), "scaling on"},
    GRow{568, Group::Rotation, Act::Rotation, set_of(AA, I, K, X, Z, R), "rotation on"},
    GRow{569, Group::Rotation, Act::RotationOff, kNone, "rotation off"},
    GRow{990, Group::OneShot, Act::SaveParameters, set_of(P, L, Q), "store parameters in a file"},
    GRow{991, Group::OneShot, Act::LoadParameters, set_of(P, L, Q),
         "restore parameters from a file"},
    GRow{995, Group::OneShot, Act::ReadByte, kNone, "read byte parameter"},
    GRow{996, Group::OneShot, Act::WriteByte, kNone, "write byte parameter"},
    GRow{997, Group::OneShot, Act::ForceError, kNone, "force error"},
    GRow{998, Group::OneShot, Act::Beep, kNone, "beep"},
    GRow{999, Group::OneShot, Act::FatalError, kNone, "force fatal error"},
};
static_assert(kRows.size() < kNoRow);

constexpr std::array<std::uint8_t, 1000> index_by_code() {
  std::array<std::uint8_t, 1000> index{};
  for (auto& entry : index) entry = kNoRow;
  for (std::size_t row = 0; row < kRows.size(); ++row) {
    index[kRows[row].code] = static_cast<std::uint8_t>(row);
  }
  return index;
}
constexpr auto kIndex = index_by_code();

}  // namespace

std::uint8_t g_row_index(unsigned code) {
  return code < kIndex.size() ? kIndex[code] : kNoRow;
}
const GRow& g_row(std::uint8_t index) {
  return kRows[index];
}

}  // namespace dripline::interpreter::centurion
