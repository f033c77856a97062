#include <fmt/ranges.h>
#include <array>

#include "protocol/wire/line_settings.hpp"

/// The usual lines of known controls: figures from their manuals; what those leave open is chosen
/// so that a cautious setup works first.
namespace dripline::wire {
namespace {

using std::chrono::milliseconds;

LineSettings line(unsigned baud, unsigned data_bits, Parity parity, StopBits stop_bits) {
  LineSettings settings;
  settings.baud = baud;
  settings.data_bits = data_bits;
  settings.parity = parity;
  settings.stop_bits = stop_bits;
  return settings;
}

/// Nothing holds the sender: the control connects RTS to CTS at its own connector. It converts each
/// block while the next one arrives, hence the pause.
LineSettings prototrak() {
  LineSettings settings = line(4800, 7, Parity::Even, StopBits::One);
  settings.flow = Flow::None;
  settings.end_character = '%';
  settings.line_delay = milliseconds(50);
  settings.control.kind = ControlKind::ProtoTrak;
  settings.control.buffer_size = 255;
  return settings;
}

LineSettings centurion() {
  LineSettings settings = line(9600, 7, Parity::Even, StopBits::Two);
  settings.extracts_programs = true;
  settings.control.kind = ControlKind::Centurion;
  settings.control.buffer_size = 256;
  return settings;
}

/// The secondary port's tape key: the control starts and stops the host like a reader.
LineSettings centurion_tape() {
  LineSettings settings = centurion();
  settings.wait_for_xon = true;
  settings.control.tape_start = '\x11';
  settings.control.tape_stop = '\x13';
  return settings;
}

LineSettings fanuc() {
  LineSettings settings = line(4800, 7, Parity::Even, StopBits::Two);
  settings.flow = Flow::DcCodes;
  settings.end_of_block = EndOfBlock::Lf;
  settings.start_character = '%';
  settings.end_character = '%';
  settings.extracts_programs = true;
  settings.control.kind = ControlKind::Fanuc;
  settings.control.buffer_size = 10;  // more after its DC3 are alarm 087
  return settings;
}

LineSettings tnc155(Flow flow) {
  LineSettings settings = line(2400, 7, Parity::Even, StopBits::One);
  settings.flow = flow;
  settings.retries = 3;
  settings.offer = Offer::All;  // read-in of a selected program, of all, of the offered ones
  if (flow == Flow::Heidenhain) settings.leader = 50;
  return settings;
}

/// MP222 = 164: a receiver without room drops its RTS.
LineSettings tnc155_rts() {
  LineSettings settings = tnc155(Flow::Heidenhain);
  settings.heidenhain.stop = TncStop::Rts;
  return settings;
}

/// The line only has to be faster than the reader that it replaces.
LineSettings tektronix1704(CharacterCode code) {
  LineSettings settings = line(9600, 8, Parity::None, StopBits::One);
  settings.flow = Flow::TapeReader;
  settings.code = code;
  settings.end_of_block = EndOfBlock::Lf;
  settings.leader = 100;
  settings.trailer = 100;
  settings.reader.characters_per_second = 300;
  return settings;
}

LineSettings xmodem() {
  LineSettings settings;
  settings.flow = Flow::Xmodem;
  return settings;
}

LineSettings rtscts() {
  LineSettings settings;
  settings.flow = Flow::RtsCts;
  return settings;
}

const auto& templates() {
  static const std::array kRows{
      LineTemplate{"plain", "any control with XON/XOFF, 9600 8N1", "", LineSettings{}},
      LineTemplate{"rtscts", "any control with RTS/CTS, 9600 8N1", "", rtscts()},
      LineTemplate{"xmodem", "XMODEM, 9600 8N1", "", xmodem()},
      LineTemplate{"fanuc", "Fanuc reader/punch interface, 4800 7E2, DC1 to DC4, %", "fanuc",
                   fanuc()},
      LineTemplate{"centurion", "Milltronics Centurion, 9600 7E2, XON/XOFF", "centurion",
                   centurion()},
      LineTemplate{"centurion-tape", "Milltronics Centurion, secondary port as its tape reader",
                   "centurion", centurion_tape()},
      LineTemplate{"prototrak", "ProtoTRAK Plus, 4800 7E1, paced", "prototrak-plus", prototrak()},
      LineTemplate{"tnc155", "HEIDENHAIN TNC 151/155, 2400 7E1, standard interface", "tnc155",
                   tnc155(Flow::Heidenhain)},
      LineTemplate{"tnc155-rts", "HEIDENHAIN TNC 151/155, 2400 7E1, standard interface, RTS/CTS",
                   "tnc155", tnc155_rts()},
      LineTemplate{"tnc155-bcc", "HEIDENHAIN TNC 151/155, 2400 7E1, blockwise with BCC", "tnc155",
                   tnc155(Flow::HeidenhainBcc)},
      LineTemplate{"tektronix1704", "Tektronix 1704 as its tape reader, EIA, 300 characters/s",
                   "tektronix-1704", tektronix1704(CharacterCode::Eia)},
      LineTemplate{"tektronix1704-iso", "Tektronix 1704 as its tape reader, ISO, 300 characters/s",
                   "tektronix-1704", tektronix1704(CharacterCode::Iso)},
  };
  return kRows;
}

}  // namespace

std::span<const LineTemplate> line_templates() {
  return templates();
}

Result<const LineTemplate*> find_template(std::string_view name) {
  std::vector<std::string_view> known;
  for (const LineTemplate& row : line_templates()) {
    if (row.name == name) return &row;
    known.push_back(row.name);
  }
  return fail(Errc::NotFound, "there is no line template '{}'; known: {}", name,
              fmt::join(known, ", "));
}

}  // namespace dripline::wire
