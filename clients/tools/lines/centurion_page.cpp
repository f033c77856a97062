#include "clients/tools/lines/centurion_page.hpp"

#include <algorithm>

namespace dripline::wire {
namespace {

constexpr std::array kBaudRates{110u, 150u, 300u, 600u, 1200u, 2400u, 4800u, 9600u, 19200u};

const ComFormat* connector(const CenturionPage& page, ComPort port) {
  if (port == ComPort::None) return nullptr;
  return &page.com[port == ComPort::Com1 ? 0 : 1];
}

std::optional<char> character_of(unsigned value) {
  return value == 0 ? std::nullopt : std::optional(static_cast<char>(value));
}
unsigned value_of(std::optional<char> character) {
  return character ? static_cast<unsigned char>(*character) : 0;
}

Result<void> check_format(const LineSettings& line) {
  if (std::ranges::count(kBaudRates, line.baud) == 0) {
    return fail(Errc::Unsupported, "baud {}: the page has 110, 150, 300, 600 ... 19200", line.baud);
  }
  if (line.parity > Parity::Odd) {
    return fail(Errc::Unsupported, "line {}: the page has parity N, E and O", short_form(line));
  }
  if (line.stop_bits == StopBits::OneAndHalf) {
    return fail(Errc::Unsupported, "stop_bits 1.5: the page has 1 and 2");
  }
  return {};
}

Result<void> check_text(const LineSettings& line) {
  if (line.code != CharacterCode::Ascii) {
    return fail(Errc::Unsupported, "code: the control sends and takes ASCII only");
  }
  if (line.flow != Flow::XonXoff && line.flow != Flow::RtsCts) {
    return fail(Errc::Unsupported, "flow: the control does xonxoff and rtscts");
  }
  if (line.start_character) {
    return fail(Errc::Unsupported, "start_char: the control begins no file with a character");
  }
  return {};
}

}  // namespace

Result<LineSettings> line_of_page(const CenturionPage& page, PagePort port) {
  const bool is_primary = port == PagePort::Primary;
  const auto* format = connector(page, is_primary ? page.primary : page.secondary);
  if (format == nullptr) {
    return fail(Errc::Unsupported, "{} is none", is_primary ? "primary_port" : "secondary_port");
  }
  if (page.primary == page.secondary) {
    return fail(Errc::Unsupported, "primary_port and secondary_port are the same connector");
  }
  const bool is_tape = !is_primary && page.tape_start != 0;
  const auto usual = find_template(is_tape ? "centurion-tape" : "centurion");
  if (!usual) return fail(usual.error());
  LineSettings line = (*usual)->settings;
  line.baud = format->baud;
  line.parity = format->parity;
  line.data_bits = format->data_bits;
  line.stop_bits = format->stop_bits;
  line.end_of_block = page.sends_cr_lf ? EndOfBlock::CrLf : EndOfBlock::Cr;
  line.end_character = character_of(page.end_of_file);
  line.control.buffer_size = page.buffer_size;
  line.control.tape_start = is_tape ? character_of(page.tape_start) : std::nullopt;
  line.control.tape_stop = is_tape ? character_of(page.tape_stop) : std::nullopt;
  return line;
}

Result<CenturionPage> page_of_line(const LineSettings& line, PagePort port) {
  if (auto checked = check_format(line); !checked) return fail(checked.error());
  if (auto checked = check_text(line); !checked) return fail(checked.error());
  CenturionPage page;
  const bool is_primary = port == PagePort::Primary;
  if (!is_primary) page.secondary = ComPort::Com2;
  page.com[is_primary ? 0 : 1] = {line.baud, line.parity, line.data_bits, line.stop_bits};
  page.buffer_size = std::clamp(line.control.buffer_size, 1u, 256u);
  page.lf_becomes_cr = line.end_of_block == EndOfBlock::Lf;
  page.sends_cr_lf = line.end_of_block != EndOfBlock::Cr;
  page.end_of_file = value_of(line.end_character);
  page.tape_start = value_of(line.control.tape_start);
  page.tape_stop = value_of(line.control.tape_stop);
  return page;
}

}  // namespace dripline::wire
