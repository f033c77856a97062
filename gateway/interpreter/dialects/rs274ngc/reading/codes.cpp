#include "gateway/interpreter/dialects/rs274ngc/reading/codes.hpp"

#include <array>

namespace dripline::interpreter::rs274ngc {
namespace {

using enum GGroup;
using M = MGroup;
constexpr auto kBoth = Profile::Nist;
constexpr auto kLater = Profile::LinuxCnc;

constexpr GRow g(int code, GGroup group, Profile since, const char* words, bool axes = false) {
  return {static_cast<std::int16_t>(code), group, since, set_of(words), axes};
}
constexpr MRow m(int code, MGroup group, Profile since, const char* words) {
  return {static_cast<std::int16_t>(code), group, since, set_of(words)};
}

constexpr std::array kG{
    g(0, Motion, kBoth, ""),
    g(10, Motion, kBoth, ""),
    g(20, Motion, kBoth, "IJKRP"),
    g(30, Motion, kBoth, "IJKRP"),
    g(40, OneShot, kBoth, "P"),
    g(50, Motion, kLater, "IJPQ"),
    g(51, Motion, kLater, "IJ"),
    g(52, Motion, kLater, "LP"),
    g(53, Motion, kLater, ""),
    g(70, Lathe, kLater, ""),
    g(80, Lathe, kLater, ""),
    g(100, OneShot, kBoth, "LPRIJQ", true),
    g(170, Plane, kBoth, ""),
    g(171, Plane, kLater, ""),
    g(180, Plane, kBoth, ""),
    g(181, Plane, kLater, ""),
    g(190, Plane, kBoth, ""),
    g(191, Plane, kLater, ""),
    g(200, Units, kBoth, ""),
    g(210, Units, kBoth, ""),
    g(280, OneShot, kBoth, "", true),
    g(281, OneShot, kLater, "", true),
    g(300, OneShot, kBoth, "", true),
    g(301, OneShot, kLater, "", true),
    g(330, Motion, kLater, "K"),
    g(331, Motion, kLater, "KI"),
    g(382, Motion, kBoth, ""),
    g(383, Motion, kLater, ""),
    g(384, Motion, kLater, ""),
    g(385, Motion, kLater, ""),
    g(400, Radius, kBoth, ""),
    g(410, Radius, kBoth, "D"),
    g(411, Radius, kLater, "DL"),
    g(420, Radius, kBoth, "D"),
    g(421, Radius, kLater, "DL"),
    g(430, GGroup::Length, kBoth, "H"),
    g(431, GGroup::Length, kLater, "", true),
    g(432, GGroup::Length, kLater, "H"),
    g(490, GGroup::Length, kBoth, ""),
    g(520, OneShot, kLater, "", true),
    g(530, OneShot, kBoth, ""),
    g(540, System, kBoth, ""),
    g(550, System, kBoth, ""),
    g(560, System, kBoth, ""),
    g(570, System, kBoth, ""),
    g(580, System, kBoth, ""),
    g(590, System, kBoth, ""),
    g(591, System, kBoth, ""),
    g(592, System, kBoth, ""),
    g(593, System, kBoth, ""),
    g(610, Path, kBoth, ""),
    g(611, Path, kBoth, ""),
    g(640, Path, kBoth, "PQ"),
    g(730, Motion, kLater, "RLQD"),
    g(740, Motion, kLater, "RLPF"),
    g(760, Motion, kLater, "PIJKRQHEL"),
    g(800, Motion, kBoth, ""),
    g(810, Motion, kBoth, "RL"),
    g(820, Motion, kBoth, "RLP"),
    g(830, Motion, kBoth, "RLQD"),
    g(840, Motion, kBoth, "RLP"),
    g(850, Motion, kBoth, "RL"),
    g(860, Motion, kBoth, "RLP"),
    g(870, Motion, kBoth, "RLIJK"),
    g(880, Motion, kBoth, "RLP"),
    g(890, Motion, kBoth, "RLP"),
    g(900, Distance, kBoth, ""),
    g(901, ArcDistance, kLater, ""),
    g(910, Distance, kBoth, ""),
    g(911, ArcDistance, kLater, ""),
    g(920, OneShot, kBoth, "", true),
    g(921, OneShot, kBoth, ""),
    g(922, OneShot, kBoth, ""),
    g(923, OneShot, kBoth, ""),
    g(930, FeedMode, kBoth, ""),
    g(940, FeedMode, kBoth, ""),
    g(950, FeedMode, kLater, ""),
    g(960, SpindleMode, kLater, "D"),
    g(970, SpindleMode, kLater, ""),
    g(980, Retract, kBoth, ""),
    g(990, Retract, kBoth, ""),
};

constexpr std::array kM{
    m(0, M::Stop, kBoth, ""),
    m(1, M::Stop, kBoth, ""),
    m(2, M::Stop, kBoth, ""),
    m(3, M::Spindle, kBoth, ""),
    m(4, M::Spindle, kBoth, ""),
    m(5, M::Spindle, kBoth, ""),
    m(6, M::Tool, kBoth, ""),
    m(7, M::Coolant, kBoth, ""),
    m(8, M::Coolant, kBoth, ""),
    m(9, M::Coolant, kBoth, ""),
    m(19, M::Spindle, kLater, "RPQ"),
    m(30, M::Stop, kBoth, ""),
    m(48, M::Override, kBoth, ""),
    m(49, M::Override, kBoth, ""),
    m(50, M::Override, kLater, "P"),
    m(51, M::Override, kLater, "P"),
    m(52, M::Override, kLater, "P"),
    m(53, M::Override, kLater, "P"),
    m(60, M::Stop, kBoth, ""),
    m(61, M::Tool, kLater, "Q"),
    m(62, M::InputOutput, kLater, "P"),
    m(63, M::InputOutput, kLater, "P"),
    m(64, M::InputOutput, kLater, "P"),
    m(65, M::InputOutput, kLater, "P"),
    m(66, M::InputOutput, kLater, "PELQ"),
    m(67, M::InputOutput, kLater, "EQ"),
    m(68, M::InputOutput, kLater, "EQ"),
    m(70, M::State, kLater, ""),
    m(71, M::State, kLater, ""),
    m(72, M::State, kLater, ""),
    m(73, M::State, kLater, ""),
    m(98, M::Stop, kLater, "PL"),
    m(99, M::Stop, kLater, ""),
};
/// M100 to M199: programs of the shop.
constexpr int kFirstUser = 100;
constexpr int kLastUser = 199;
constexpr MRow kUser = m(kFirstUser, M::User, kLater, "PQ");

constexpr std::uint8_t kNoRow = 255;

template <class Rows, std::size_t... kSize>
constexpr auto index_of(const Rows& rows) {
  std::array<std::uint8_t, 1000> index{};
  for (auto& each : index) each = kNoRow;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    index[static_cast<std::size_t>(rows[i].code)] = static_cast<std::uint8_t>(i);
  }
  return index;
}
constexpr auto kGIndex = index_of(kG);
constexpr auto kMIndex = index_of(kM);

}  // namespace

const GRow* g_row(int tenths, Profile profile) {
  if (tenths < 0 || tenths > 999) return nullptr;
  const std::uint8_t index = kGIndex[static_cast<std::size_t>(tenths)];
  if (index == kNoRow || kG[index].since > profile) return nullptr;
  return &kG[index];
}

AddressSet words_of(const GRow& row, Profile profile) {
  if (profile == Profile::LinuxCnc) return row.words;
  switch (row.code) {
    case 20:
    case 30:
    case 840:
      return row.words & ~set_of("P");
    case 100:
      return set_of("LP");
    case 640:
      return 0;
    case 830:
      return row.words & ~set_of("D");
    default:
      return row.words;
  }
}

const MRow* m_row(int code, Profile profile) {
  if (code < 0 || code > kLastUser) return nullptr;
  if (code >= kFirstUser) return profile == Profile::LinuxCnc ? &kUser : nullptr;
  const std::uint8_t index = kMIndex[static_cast<std::size_t>(code)];
  if (index == kNoRow || kM[index].since > profile) return nullptr;
  return &kM[index];
}

}  // namespace dripline::interpreter::rs274ngc
