#include "protocol/wire/discipline.hpp"

#include <algorithm>
#include <array>

#include "protocol/wire/impl/discipline_base.hpp"
#include "protocol/wire/setting_value.hpp"
#include "protocol/wire/tape_code.hpp"

namespace dripline::wire {
namespace {

/// A TNC's control characters are 1 to 47, all different, and not DC1 and DC3, which are fixed.
Result<void> check_tnc(const LineSettings& settings) {
  if (settings.code != CharacterCode::Ascii) {
    return fail(Errc::Unsupported, "a TNC's interface carries the code ascii only");
  }
  const auto& tnc = settings.heidenhain;
  if (settings.flow == Flow::HeidenhainBcc && tnc.stop != TncStop::Dc3) {
    return fail(Errc::Unsupported,
                "tnc_stop is for the flow heidenhain: blockwise the ACK holds the sender, and "
                "neither DC3 nor RTS");
  }
  const std::array characters{tnc.soh, tnc.stx, tnc.etx, tnc.eot, tnc.ack, tnc.nak, tnc.etb};
  constexpr std::string_view kFixed = "\x11\x13\r\n";
  for (std::size_t i = 0; i < characters.size(); ++i) {
    const char c = characters[i];
    const bool is_twice = std::count(characters.begin(), characters.end(), c) > 1;
    if (c >= 1 && c <= 47 && c != ' ' && !is_twice && kFixed.find(c) == kFixed.npos) continue;
    return fail(Errc::Unsupported,
                "TNC control character {}: they must be 1 to 47, all different, and not blank, CR, "
                "LF, DC1 or DC3",
                static_cast<int>(c));
  }
  return {};
}

/// The characters around a program: the code must have them, and they must not control the line.
Result<void> check_mark(std::string_view key, std::optional<char> mark,
                        const LineSettings& settings) {
  if (!mark) return {};
  if (!to_line(settings.code, *mark)) {
    return fail(Errc::Unsupported, "{} {}: the code {} does not have it", key,
                character_text(*mark), code_name(settings.code));
  }
  const bool is_softly_held = settings.flow == Flow::XonXoff || settings.flow == Flow::DcCodes;
  const bool steers = *mark == kDc1 || *mark == kDc3 ||
                      (settings.flow == Flow::DcCodes && (*mark == kDc2 || *mark == kDc4));
  if (is_softly_held && steers) {
    return fail(Errc::Unsupported, "{} {}: it steers this line", key, character_text(*mark));
  }
  return {};
}

/// Settings that exclude each other.
Result<void> check(const LineSettings& settings) {
  if (settings.code != CharacterCode::Ascii && settings.data_bits != 8) {
    return fail(Errc::Unsupported, "the codes eia and iso fill 8 bits; data_bits is {}",
                settings.data_bits);
  }
  if (settings.code != CharacterCode::Ascii && settings.parity != Parity::None) {
    return fail(Errc::Unsupported, "the codes eia and iso bring their parity; parity must be none");
  }
  if (settings.flow == Flow::Xmodem && settings.data_bits != 8) {
    return fail(Errc::Unsupported, "xmodem needs 8 bits a character; data_bits is {}",
                settings.data_bits);
  }
  if (settings.flow == Flow::Xmodem && settings.code != CharacterCode::Ascii) {
    return fail(Errc::Unsupported, "xmodem carries the code ascii only");
  }
  const bool is_softly_held = settings.flow == Flow::XonXoff || settings.flow == Flow::DcCodes;
  // 0x13 is the digit 3 in EIA, and 0x11 is no character: no character could stop a control.
  if (is_softly_held && settings.code == CharacterCode::Eia) {
    return fail(Errc::Unsupported, "eia has no DC1 and DC3 (0x13 is its digit 3): use rtscts");
  }
  for (const auto& [key, mark] : {std::pair{"start_char", settings.start_character},
                                  std::pair{"end_char", settings.end_character}}) {
    if (const auto checked = check_mark(key, mark, settings); !checked) return checked;
  }
  if (settings.flow == Flow::Heidenhain || settings.flow == Flow::HeidenhainBcc) {
    return check_tnc(settings);
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<Discipline>> make_discipline(const LineSettings& settings, Role role) {
  if (const auto checked = check(settings); !checked) return fail(checked.error());
  switch (settings.flow) {
    case Flow::None:
    case Flow::XonXoff:
    case Flow::RtsCts:
    case Flow::DcCodes:
      return make_plain(settings, role);
    case Flow::Xmodem:
      return make_xmodem(settings, role);
    case Flow::TapeReader:
      return role == Role::Host ? make_tape_reader_host(settings)
                                : make_tape_reader_control(settings);
    case Flow::Heidenhain:
      return make_tnc_standard(settings, role);
    case Flow::HeidenhainBcc:
      return role == Role::Host ? make_tnc_blockwise_host(settings)
                                : make_tnc_blockwise_control(settings);
  }
  return fail(Errc::Unsupported, "this build has no such protocol");
}

}  // namespace dripline::wire
