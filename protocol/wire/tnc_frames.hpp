#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/wire/line_settings.hpp"

/// The blocks and single characters of a TNC's blockwise transfer.
///
///     heading = SOH text ETB BCC        block = STX text ETB BCC
///
/// BCC: exclusive or of all 7-bit characters from SOH or STX to ETB, both included.

namespace dripline::wire {

inline constexpr std::size_t kMaxTncLine = 255;      ///< characters of a program line
inline constexpr std::size_t kMaxTncErrorText = 32;  ///< characters that a control shows

/// One block as it is on the line.
std::string make_tnc_block(char begin, std::string_view text, const HeidenhainSettings& tnc);

struct TncFrame {
  enum class Kind : std::uint8_t { Heading, Block, Broken, Ack, Nak, Etx, Eot, Noise };
  Kind kind = Kind::Noise;
  std::string text;  ///< of Heading and Block, without line end; of Broken: the error
};

/// Converts characters to frames, one at a time. A character outside a frame is Noise; DC1, DC3 and
/// NUL between frames are ignored.
class TncFrameReader {
 public:
  explicit TncFrameReader(const HeidenhainSettings& tnc) : tnc_(tnc) {}

  std::optional<TncFrame> read(std::uint8_t character);
  /// The UART reports a fault: breaks the frame that the character is in.
  std::optional<TncFrame> fault();
  /// The line was silent for longer than a sender pauses inside a frame.
  std::optional<TncFrame> silence();
  bool is_inside() const { return stage_ != Stage::Between; }

 private:
  enum class Stage : std::uint8_t { Between, Text, Check };
  std::optional<TncFrame> read_between(char c);
  std::optional<TncFrame> finish(char check);
  void begin(char c);
  HeidenhainSettings tnc_;
  Stage stage_ = Stage::Between;
  bool is_heading_ = false;
  std::string_view broken_;  ///< the reason; empty: not broken
  std::string text_;
  char check_ = 0;
};

// The meaning of a line for its TNC program. Plain language:
// "0 BEGIN PGM 7 MM" ... "12 END PGM 7 MM"; ISO: "%7 G71" ... "N9999 %7 G71". Pure; any thread.

enum class TncLineKind { Begin, End, Other };

struct TncLine {
  TncLineKind kind = TncLineKind::Other;
  std::string program;  ///< its number, of Begin and End
  /// The block number of plain language.
  std::optional<unsigned> number;
};

/// `line` without its line end.
TncLine read_tnc_line(std::string_view line);

/// Whether the line has a number (plain language, or N): no two equal ones follow each other.
bool is_numbered(std::string_view line);

}  // namespace dripline::wire
