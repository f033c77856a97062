#include "protocol/wire/discipline.hpp"

#include "protocol/wire/impl/protocols.hpp"

namespace dripline::wire {
namespace {

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
  // 0x13 is the digit 3 in EIA, 0x11 no character at all: a control could not be told to stop.
  if (is_softly_held && settings.code == CharacterCode::Eia) {
    return fail(Errc::Unsupported, "eia has no DC1 and DC3 (0x13 is its digit 3): use rtscts");
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
    case Flow::Heidenhain:
    case Flow::HeidenhainBcc:
    case Flow::TapeReader:
      break;
  }
  return fail(Errc::Unsupported, "this protocol is not built yet");
}

}  // namespace dripline::wire
