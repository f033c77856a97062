#include "gateway/interpreter/dialects/rs274ngc/reading/codes.hpp"

#include <array>

namespace dripline::interpreter::rs274ngc {
namespace {

using enum GGroup;
constexpr auto kBoth = Profile::Nist;
constexpr auto kLater = Profile::LinuxCnc;

template <class Row>
struct Table {
  static constexpr std::uint8_t kNoRow = 255;

  constexpr Table() { index.fill(kNoRow); }
  constexpr void add(const Row& row) {
    index[static_cast<std::size_t>(row.code)] = size;
    rows[size++] = row;
  }
  const Row* find(int code, Profile profile) const {
    const std::uint8_t at = index[static_cast<std::size_t>(code)];
    return at == kNoRow || rows[at].since > profile ? nullptr : &rows[at];
  }

  std::array<std::uint8_t, 1000> index{};
  std::array<Row, 100> rows{};
  std::uint8_t size = 0;
};

/// Codes of one group that take the same words are one line.
constexpr Table<GRow> kG = [] {
  Table<GRow> table;
  const auto add_row = [&](GGroup group, Profile since, const char* words, bool axes, int code) {
    table.add({static_cast<std::int16_t>(code), group, since, set_of(words), axes});
  };
  const auto add = [&](GGroup group, Profile since, const char* words, auto... codes) {
    (add_row(group, since, words, false, codes), ...);
  };
  const auto add_with_axes = [&](GGroup group, Profile since, const char* words, auto... codes) {
    (add_row(group, since, words, true, codes), ...);
  };
  add(Motion, kBoth, "", 0, 10, 382, 800);
  add(Motion, kBoth, "IJKRP", 20, 30);
  add(Motion, kBoth, "RL", 810, 850);
  add(Motion, kBoth, "RLP", 820, 840, 860, 880, 890);
  add(Motion, kBoth, "RLQD", 830);
  add(Motion, kBoth, "RLIJK", 870);
  add(Motion, kLater, "", 53, 383, 384, 385);
  add(Motion, kLater, "IJPQ", 50);
  add(Motion, kLater, "IJ", 51);
  add(Motion, kLater, "LP", 52);
  add(Motion, kLater, "K", 330);
  add(Motion, kLater, "KI", 331);
  add(Motion, kLater, "RLQD", 730);
  add(Motion, kLater, "RLPF", 740);
  add(Motion, kLater, "QDEP", 700);
  add(Motion, kLater, "QDIR", 710, 711, 712, 720, 721, 722);
  add(Motion, kLater, "PIJKRQHEL", 760);
  add(OneShot, kBoth, "P", 40);
  add(OneShot, kBoth, "", 530, 921, 922, 923);
  add_with_axes(OneShot, kBoth, "LPRIJQ", 100);
  add_with_axes(OneShot, kBoth, "", 280, 300, 920);
  add(OneShot, kLater, "", 281, 301);  // axis words beside them are a move
  add_with_axes(OneShot, kLater, "", 520);
  add(Lathe, kLater, "", 70, 80);
  add(Plane, kBoth, "", 170, 180, 190);
  add(Plane, kLater, "", 171, 181, 191);
  add(Units, kBoth, "", 200, 210);
  add(Radius, kBoth, "", 400);
  add(Radius, kBoth, "D", 410, 420);
  add(Radius, kLater, "DL", 411, 421);
  add(GGroup::Length, kBoth, "", 490);
  add(GGroup::Length, kBoth, "H", 430);
  add(GGroup::Length, kLater, "H", 432);
  add_with_axes(GGroup::Length, kLater, "", 431);
  add(System, kBoth, "", 540, 550, 560, 570, 580, 590, 591, 592, 593);
  add(Path, kBoth, "", 610, 611);
  add(Path, kBoth, "PQ", 640);
  add(Distance, kBoth, "", 900, 910);
  add(ArcDistance, kLater, "", 901, 911);
  add(FeedMode, kBoth, "", 930, 940);
  add(FeedMode, kLater, "", 950);
  add(SpindleMode, kLater, "D", 960);
  add(SpindleMode, kLater, "", 970);
  add(Retract, kBoth, "", 980, 990);
  return table;
}();

constexpr Table<MRow> kM = [] {
  Table<MRow> table;
  const auto add = [&](MGroup group, Profile since, const char* words, auto... codes) {
    (table.add({static_cast<std::int16_t>(codes), group, since, set_of(words)}), ...);
  };
  add(MGroup::Stop, kBoth, "", 0, 1, 2, 30, 60);
  add(MGroup::Stop, kLater, "PL", 98);
  add(MGroup::Stop, kLater, "", 99);
  add(MGroup::Spindle, kBoth, "", 3, 4, 5);
  add(MGroup::Spindle, kLater, "RPQ", 19);
  add(MGroup::Spindle, kLater, "", 70, 71, 72, 73);  // of the spindle's group in LinuxCNC
  add(MGroup::Tool, kBoth, "", 6);
  add(MGroup::Tool, kLater, "Q", 61);
  add(MGroup::Coolant, kBoth, "", 7, 8, 9);
  add(MGroup::Override, kBoth, "", 48, 49);
  add(MGroup::Override, kLater, "P", 50, 51, 52, 53);
  add(MGroup::InputOutput, kLater, "P", 62, 63, 64, 65);
  add(MGroup::InputOutput, kLater, "PELQ", 66);
  add(MGroup::InputOutput, kLater, "EQ", 67, 68);
  return table;
}();
/// M100 to M199: programs of the shop.
constexpr int kFirstUser = 100;
constexpr int kLastUser = 199;
constexpr MRow kUser{kFirstUser, MGroup::User, kLater, set_of("PQ")};

}  // namespace

const GRow* g_row(int tenths, Profile profile) {
  return tenths < 0 || tenths > 999 ? nullptr : kG.find(tenths, profile);
}

AddressSet words_of(const GRow& row, Profile profile) {
  if (profile == Profile::LinuxCnc) return row.words;
  if (row.code == 20 || row.code == 30 || row.code == 840) return row.words & ~set_of("P");
  if (row.code == 100) return set_of("LP");
  if (row.code == 640) return 0;
  return row.code == 830 ? row.words & ~set_of("D") : row.words;
}

const MRow* m_row(int code, Profile profile) {
  if (code < 0 || code > kLastUser) return nullptr;
  if (code >= kFirstUser) return profile == Profile::LinuxCnc ? &kUser : nullptr;
  return kM.find(code, profile);
}

}  // namespace dripline::interpreter::rs274ngc
