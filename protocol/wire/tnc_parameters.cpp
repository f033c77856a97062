#include "protocol/wire/tnc_parameters.hpp"

#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "protocol/wire/discipline.hpp"

namespace dripline::wire {
namespace {

/// MP 222, the data format of a character.
constexpr unsigned kEightBits = 1, kPrintableBcc = 2, kStopByRts = 4, kStopByDc3 = 8, kOdd = 16,
                   kHasParity = 32, kStopBitMask = 192, kTwoStopBits = 64, kOneStopBit = 128;
constexpr unsigned kMaxFormat = 255, kMaxWord = 65'535;

/// A parameter holds two characters or a number; the values are those of a new control.
struct ParameterRow {
  int number;
  unsigned usual, most;
};
constexpr int kEnds = 71, kInputHeading = 218, kOutputHeading = 219, kBlockFrame = 220,
              kAnswers = 221, kFormat = 222, kProtocol = 223, kEndOfTransmission = 224;
constexpr std::array kParameterRows{ParameterRow{kEnds, 515, kMaxWord},
                                    ParameterRow{kInputHeading, 17736, kMaxWord},
                                    ParameterRow{kOutputHeading, 16712, kMaxWord},
                                    ParameterRow{kBlockFrame, 279, kMaxWord},
                                    ParameterRow{kAnswers, 5382, kMaxWord},
                                    ParameterRow{kFormat, 168, kMaxFormat},
                                    ParameterRow{kProtocol, 0, 1},
                                    ParameterRow{kEndOfTransmission, 4, 127}};

constexpr char low(unsigned word) {
  return static_cast<char>(word & 0xffu);
}
constexpr char high(unsigned word) {
  return static_cast<char>(word >> 8 & 0xffu);
}
constexpr unsigned word(char low, char high) {
  return static_cast<unsigned>(static_cast<unsigned char>(high)) << 8 |
         static_cast<unsigned char>(low);
}

/// The interface's parameters, each within its limits.
class ParameterWords {
 public:
  static Result<ParameterWords> read(const TncParameters& parameters) {
    ParameterWords words;
    for (const ParameterRow& row : kParameterRows) {
      const auto found = parameters.find(row.number);
      const double value = found == parameters.end() ? row.usual : found->second;
      if (value < 0 || value > row.most || value != std::floor(value)) {
        return fail(Errc::LimitExceeded, "MP{} = {:g}: expected a whole number from 0 to {}",
                    row.number, value, row.most);
      }
      words.values_[row.number] = static_cast<unsigned>(value);
      if (found != parameters.end()) words.given_.insert(row.number);
    }
    return words;
  }
  unsigned operator[](int number) const { return values_.at(number); }
  bool is_given(int number) const { return given_.contains(number); }

 private:
  std::map<int, unsigned> values_;
  std::set<int> given_;
};

/// For the standard interface; blockwise, the ACK holds the sender.
TncStop stop_of(unsigned format) {
  if ((format & kStopByRts) == 0) return TncStop::Dc3;
  return (format & kStopByDc3) != 0 ? TncStop::Both : TncStop::Rts;
}

void read_format(unsigned format, LineSettings& line) {
  if (line.flow == Flow::Heidenhain) line.heidenhain.stop = stop_of(format);
  line.data_bits = (format & kEightBits) != 0 ? 8 : 7;
  line.parity = (format & kHasParity) == 0 ? Parity::None
                : (format & kOdd) != 0     ? Parity::Odd
                                           : Parity::Even;
  const unsigned stop = format & kStopBitMask;
  line.stop_bits = stop == 0              ? StopBits::OneAndHalf
                   : stop == kTwoStopBits ? StopBits::Two
                                          : StopBits::One;
  line.heidenhain.bcc_is_printable = (format & kPrintableBcc) != 0;
}

/// The standard interface uses only the ends of programs and transmissions.
void read_characters(const ParameterWords& words, bool is_blockwise, HeidenhainSettings& tnc) {
  tnc.etx = low(words[kEnds]);
  if (words[kEndOfTransmission] != 0) tnc.eot = low(words[kEndOfTransmission]);
  if (!is_blockwise) return;
  if (high(words[kEnds]) != 0) tnc.stx = high(words[kEnds]);
  tnc.etb = low(words[kBlockFrame]);
  tnc.soh = high(words[kBlockFrame]);
  tnc.ack = low(words[kAnswers]);
  tnc.nak = high(words[kAnswers]);
}

Result<void> read_heading(const ParameterWords& words, std::optional<char> heading,
                          HeidenhainSettings& tnc) {
  const unsigned input = words[kInputHeading], output = words[kOutputHeading];
  if (high(input) != 'E' || high(output) != 'A') {
    const bool is_input = high(input) != 'E';
    return fail(Errc::Unsupported, "MP{} = {}: the high byte is {}; headings end with {}",
                is_input ? kInputHeading : kOutputHeading, is_input ? input : output,
                static_cast<unsigned>((is_input ? input : output) >> 8),
                is_input ? "E, 69" : "A, 65");
  }
  if (low(input) != low(output)) {
    return fail(Errc::Unsupported,
                "MP218 = {} and MP219 = {}: a line has one letter for headings of both directions",
                input, output);
  }
  if (heading) {
    tnc.heading = *heading;
  } else if (words.is_given(kInputHeading) || words.is_given(kOutputHeading)) {
    tnc.heading = low(input);
  }
  const bool is_known = std::string_view("%HD").find(tnc.heading) != std::string_view::npos;
  if (is_known) return {};
  return fail(Errc::Unsupported, "MP218 = {}: the low byte is {}; headings begin with %, H or D",
              input, static_cast<unsigned>(input & 0xffu));
}

}  // namespace

Result<void> check_tnc_baud(unsigned baud) {
  if (std::ranges::find(kTncBaudRates, baud) != kTncBaudRates.end()) return {};
  return fail(Errc::LimitExceeded, "baud {}: a TNC 151/155 has {}", baud,
              fmt::join(kTncBaudRates, ", "));
}

Result<LineSettings> line_of_tnc(const TncInterface& interface) {
  if (auto checked = check_tnc_baud(interface.baud); !checked) return fail(checked.error());
  const auto words = ParameterWords::read(interface.parameters);
  if (!words) return fail(words.error());
  const auto usual = find_template((*words)[kProtocol] == 1 ? "tnc155-bcc" : "tnc155");
  if (!usual) return fail(usual.error());
  LineSettings line = (*usual)->settings;
  line.baud = interface.baud;
  read_format((*words)[kFormat], line);
  const bool is_blockwise = line.flow == Flow::HeidenhainBcc;
  read_characters(*words, is_blockwise, line.heidenhain);
  if (is_blockwise) {
    auto read = read_heading(*words, interface.heading, line.heidenhain);
    if (!read) return fail(read.error());
  }
  // The protocol itself reports an impossible line: equal characters, or one outside 1 to 47.
  if (auto made = make_discipline(line, Role::Host); !made) {
    return fail(made.error().code, "MP71, MP220, MP221 and MP224: {}", made.error().what);
  }
  return line;
}

Result<TncParameters> tnc_parameters_of_line(const LineSettings& line) {
  const bool is_blockwise = line.flow == Flow::HeidenhainBcc;
  if (!is_blockwise && line.flow != Flow::Heidenhain) {
    return fail(Errc::Unsupported, "a TNC 151/155 has the flow heidenhain or heidenhain_bcc");
  }
  if (auto checked = check_tnc_baud(line.baud); !checked) return fail(checked.error());
  if (line.parity == Parity::Mark || line.parity == Parity::Space) {
    return fail(Errc::Unsupported, "parity: a TNC 151/155 has none, even and odd");
  }
  if (auto made = make_discipline(line, Role::Host); !made) return fail(made.error());
  const auto& tnc = line.heidenhain;
  unsigned format = tnc.stop == TncStop::Rts ? 0 : kStopByDc3;
  if (tnc.stop != TncStop::Dc3) format |= kStopByRts;
  if (line.data_bits == 8) format |= kEightBits;
  if (tnc.bcc_is_printable) format |= kPrintableBcc;
  if (line.parity != Parity::None) format |= kHasParity;
  if (line.parity == Parity::Odd) format |= kOdd;
  if (line.stop_bits == StopBits::One) format |= kOneStopBit;
  if (line.stop_bits == StopBits::Two) format |= kTwoStopBits;
  return TncParameters{{kEnds, word(tnc.etx, tnc.stx)},
                       {kInputHeading, word(tnc.heading, 'E')},
                       {kOutputHeading, word(tnc.heading, 'A')},
                       {kBlockFrame, word(tnc.etb, tnc.soh)},
                       {kAnswers, word(tnc.ack, tnc.nak)},
                       {kFormat, format},
                       {kProtocol, is_blockwise ? 1 : 0},
                       {kEndOfTransmission, static_cast<unsigned char>(tnc.eot)}};
}

}  // namespace dripline::wire
