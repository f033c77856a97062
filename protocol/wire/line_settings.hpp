#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

/// The settings of a serial line on which both ends must agree, in the words of the shop.
namespace dripline::wire {

enum class Parity : std::uint8_t { None, Even, Odd, Mark, Space };
enum class StopBits : std::uint8_t { One, OneAndHalf, Two };

/// How the receiver holds the sender, and how transfers are begun and checked.
enum class Flow : std::uint8_t {
  None,           ///< paced by delays only
  XonXoff,        ///< the receiver sends DC3 to stop, DC1 to resume
  RtsCts,         ///< the receiver drops its RTS, which is our CTS
  DcCodes,        ///< DC1/DC3 start and stop the reader, DC2/DC4 the punch
  Xmodem,         ///< 128-byte blocks, checksum or CRC
  Heidenhain,     ///< TNC standard interface: DC1, lines, ETX, EOT
  HeidenhainBcc,  ///< TNC blockwise transfer: headings, one block at a time, BCC, ACK/NAK
  TapeReader,     ///< the host is the reader of a tape control: character by character, with a stop
                  ///< code
};
/// The code of characters on the line. The UART's parity is `parity`; the codes below have their
/// own in the 8 bits.
enum class CharacterCode : std::uint8_t {
  Ascii,  ///< 7 bits as they are; bit 8 clear when sent, dropped when received
  Iso,    ///< ISO 840 / RS-358: 7 bits and even parity in bit 8
  Eia,    ///< RS-244-A: odd parity in track 5
};
/// The end of a block on the line. Programs are stored with LF.
enum class EndOfBlock : std::uint8_t { Lf, Cr, CrLf, LfCr, LfCrCr };

/// The signal that stops the sender on a TNC's standard interface (MP222, bits 2 and 3). With
/// `Both` the receiver uses RTS, and the sender obeys either.
enum class TncStop : std::uint8_t { Dc3, Rts, Both };

/// The characters and rules of a TNC's interface; each is a machine parameter.
struct HeidenhainSettings {
  char heading = '%';  ///< type letter of headings we send; '%', 'H' and 'D' are taken
  char soh = 1, stx = 2, etx = 3, eot = 4, ack = 6, nak = 21, etb = 23;
  bool line_end_in_block = false;      ///< CR LF between text and ETB; always accepted
  bool bcc_is_printable = false;       ///< a blank before ETB keeps the BCC at or above 0x20
  bool sends_dc1_after_block = false;  ///< as a host; a control always does
  TncStop stop = TncStop::Dc3;         ///< blockwise, a withheld ACK holds the sender
  /// A host repeats a block that is not answered within the answer limit, instead of waiting for a
  /// control that may only be slow. A real control may then accept the block twice.
  bool repeats_unanswered = false;
};

/// A fault of a tape or its reader, for tests of the control. The reader's end damages the row (a
/// chad left in a hole is one hole less); the control's end detects it there.
enum class ReaderFault : std::uint8_t { None, Parity, Chad, MissingSprocket, SprocketSpacing };

/// How the host behaves as a tape reader.
struct ReaderSettings {
  double characters_per_second = 300;
  bool stops_at_end_of_block = false;  ///< the control runs the reader block by block
  ReaderFault fault = ReaderFault::None;
  unsigned fault_row = 0;  ///< since the beginning of each transfer, from 1
};

/// The control whose rules and error texts the control's end of a line has. A host has none.
enum class ControlKind : std::uint8_t {
  Plain,
  Fanuc,      ///< few characters may follow its DC3; alarms 085, 087
  ProtoTrak,  ///< blocks end with ';', a program with '%'; stores nothing of a bad program
  Centurion,  ///< errors 900 to 903, DNC modes, splitting at O lines
};
/// How a Centurion uses the received text: stored as a program, or run while it arrives.
enum class DncMode : std::uint8_t { Off, Fast, Run, Verify, Continue };

/// What a host sends to a control whose request comes while no run waits.
enum class Offer : std::uint8_t {
  None,    ///< nothing: the request waits for the next run, or is refused where the protocol can
  Named,   ///< the named program of the machine's control, as a run
  All,     ///< also, without a name, each numbered program of the machine's control in turn
  Repeat,  ///< the program of the last run again, if that was completed: a tape left in the reader
};

struct ControlSettings {
  ControlKind kind = ControlKind::Plain;
  /// Characters that the control accepts after it stopped the host; more are an overrun.
  unsigned buffer_size = 256;
  /// Sent by a Centurion when it begins and ends to read (tape start and stop); a host that waits
  /// for XON treats the first as one.
  std::optional<char> tape_start, tape_stop;
  bool splits_programs = false;  ///< each O line begins a program of its own
  DncMode dnc = DncMode::Off;
  unsigned dnc_skip = 0;  ///< blocks that a DNC run reads and drops first (SKIP)
};

/// The settings of one line. The defaults are a plain 9600 8N1 line with XON/XOFF.
struct LineSettings {
  unsigned baud = 9600;
  unsigned data_bits = 8;  ///< 7 or 8
  Parity parity = Parity::None;
  StopBits stop_bits = StopBits::One;
  Flow flow = Flow::XonXoff;
  CharacterCode code = CharacterCode::Ascii;
  EndOfBlock end_of_block = EndOfBlock::CrLf;
  unsigned leader = 0;   ///< blank characters (NUL) before a program
  unsigned trailer = 0;  ///< blank characters after it
  std::optional<char>
      start_character;                ///< sent before the text, dropped when received (tape start)
  std::optional<char> end_character;  ///< sent after the text, ends what is received (EOF, ETX)
  bool wait_for_xon = false;          ///< a transfer begins when the control sends DC1
  std::chrono::milliseconds line_delay{0};       ///< pause after each end of block
  std::chrono::microseconds character_delay{0};  ///< pause after each character
  /// Silence that ends a text which a control punches without an end character.
  std::chrono::milliseconds idle_end{2000};
  /// Silence after the line was opened, after which what a control prints is no rest of what it
  /// began to send before.
  std::chrono::milliseconds rest_gap{10000};
  /// As a host: how long a program waits for the control to begin (DC1, the first NAK, a heading,
  /// the reader's start); nullopt: no limit.
  std::optional<std::chrono::milliseconds> start_limit;
  /// The longest wait for the other end's answer (ACK, EOT), and for XON after XOFF; nullopt: no
  /// limit, which a drip feed to a control in feed hold needs.
  std::optional<std::chrono::milliseconds> answer_limit = std::chrono::milliseconds{10000};
  std::optional<std::chrono::milliseconds> hold_limit;
  /// As a host: the longest pause of a received text before it is dropped, where silence does not
  /// end it. Always limited: a port must not stay busy with half a program.
  std::chrono::milliseconds pause_limit{10000};
  Offer offer = Offer::None;  ///< as a host
  unsigned retries = 10;      ///< of one block of a checked protocol; 3 for a TNC
  bool xmodem_crc = true;     ///< as receiver: ask for CRC first, then fall back to the checksum
  /// As a host: each O line in a received text begins a program. The control's own splitting is
  /// `control.splits_programs`.
  bool extracts_programs = false;
  /// As a host: bytes of programs sent without a run that the control's memory holds; 0: not known.
  unsigned program_memory = 0;
  HeidenhainSettings heidenhain;
  ReaderSettings reader;
  ControlSettings control;
};

/// Bit times of one character, its start bit included; 1.5 stop bits count as 1.5.
double bits_per_character(const LineSettings& settings);
/// The line's own rate.
double characters_per_second(const LineSettings& settings);
std::chrono::nanoseconds character_time(const LineSettings& settings);

/// Whether a CTS that is off holds the sender.
bool is_held_by_cts(const LineSettings& settings);

/// The short form "9600e72" or "57600n81": baud, parity (n e o m s), data bits, stop bits
/// (1, 1.5, 2). Changes these four only. Errors: Syntax, LimitExceeded.
Result<void> apply_short_form(std::string_view text, LineSettings& settings);
std::string short_form(const LineSettings& settings);

/// One key of a port's settings: the row drives parser, errors, help and listings.
struct SettingRow {
  std::string_view key;   ///< "baud", "flow", "line_delay_ms" ...
  std::string_view type;  ///< for people: "number", "none|xonxoff|rtscts|..."
  std::string_view text;  ///< what it decides, one line
  /// Errors: Syntax, LimitExceeded, naming key, value and limit.
  Result<void> (*set)(LineSettings& settings, std::string_view value);
  std::string (*get)(const LineSettings& settings);  ///< as `set` reads it
};
std::span<const SettingRow> setting_rows();
/// Errors: NotFound (the key), and those of the row; `settings` is then unchanged.
Result<void> set_value(LineSettings& settings, std::string_view key, std::string_view value);

/// A control's usual line, ready to be used.
struct LineTemplate {
  std::string_view name;     ///< "tnc155", "centurion", "prototrak", "tektronix1704", "fanuc" ...
  std::string_view title;    ///< for people
  std::string_view control;  ///< dialect that the machine speaks, may be empty
  LineSettings settings;
};
std::span<const LineTemplate> line_templates();
/// Errors: NotFound, naming the known ones.
Result<const LineTemplate*> find_template(std::string_view name);

}  // namespace dripline::wire
