#include "clients/tools/lines/centurion_page.hpp"

#include <algorithm>

#include "protocol/wire/setting_value.hpp"

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

// The entries of the Centurion's serial page: one row each.

namespace {

constexpr std::array<std::string_view, 3> kPorts{"none", "com1", "com2"};
constexpr std::array<std::string_view, 9> kBauds{"110",  "150",  "300",  "600",  "1200",
                                                 "2400", "4800", "9600", "19200"};
constexpr std::string_view kParityLetters = "neo";  // in the order of Parity

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

Result<void> set_port(ComPort& port, std::string_view key, std::string_view value) {
  return store(parse_word(key, lower(value), kPorts), port);
}

template <std::size_t kCom>
Result<void> set_baud(CenturionPage& page, std::string_view key, std::string_view value) {
  const auto parsed = parse_word(key, value, kBauds);
  if (!parsed) return fail(parsed.error());
  return store(parse_number(key, value, {110, 19200}), page.com[kCom].baud);
}

/// "E/7/2": parity, data bits, stop bits.
template <std::size_t kCom>
Result<void> set_format(CenturionPage& page, std::string_view key, std::string_view value) {
  const std::string text = lower(value);
  const auto parity = text.size() == 5 ? kParityLetters.find(text[0]) : std::string::npos;
  const bool is_well = parity != std::string::npos && text[1] == '/' && text[3] == '/' &&
                       (text[2] == '7' || text[2] == '8') && (text[4] == '1' || text[4] == '2');
  if (!is_well) {
    return fail(Errc::Syntax, "{} = {}: expected N, E or O / 7 or 8 / 1 or 2, such as E/7/2", key,
                value.substr(0, 20));
  }
  ComFormat& format = page.com[kCom];
  format.parity = static_cast<Parity>(parity);
  format.data_bits = text[2] == '7' ? 7 : 8;
  format.stop_bits = text[4] == '1' ? StopBits::One : StopBits::Two;
  return {};
}

template <std::size_t kCom>
std::string format_text(const CenturionPage& page) {
  const ComFormat& format = page.com[kCom];
  return fmt::format("{}/{}/{}", "NEO"[static_cast<std::size_t>(format.parity)], format.data_bits,
                     format.stop_bits == StopBits::One ? 1 : 2);
}

template <std::size_t kCom>
std::string baud_text(const CenturionPage& page) {
  return fmt::format("{}", page.com[kCom].baud);
}

template <ComPort CenturionPage::*kMember>
constexpr PageRow port(std::string_view key, std::string_view text) {
  return {key, "none|com1|com2", text,
          [](CenturionPage& page, std::string_view entry, std::string_view value) {
            return set_port(page.*kMember, entry, value);
          },
          [](const CenturionPage& page) {
            return std::string(kPorts[static_cast<std::size_t>(page.*kMember)]);
          }};
}

template <unsigned CenturionPage::*kMember, unsigned kMin, unsigned kMax>
constexpr PageRow number(std::string_view key, std::string_view type, std::string_view text) {
  return {key, type, text,
          [](CenturionPage& page, std::string_view entry, std::string_view value) {
            return store(parse_number(entry, value, {kMin, kMax}), page.*kMember);
          },
          [](const CenturionPage& page) { return fmt::format("{}", page.*kMember); }};
}

template <unsigned CenturionPage::*kMember>
constexpr PageRow character(std::string_view key, std::string_view text) {
  return number<kMember, 0, 127>(key, "0 to 127", text);
}

template <bool CenturionPage::*kMember>
constexpr PageRow flag(std::string_view key, std::string_view text) {
  return {key, "yes|no", text,
          [](CenturionPage& page, std::string_view entry, std::string_view value) {
            return store(parse_flag(entry, value), page.*kMember);
          },
          [](const CenturionPage& page) -> std::string { return page.*kMember ? "yes" : "no"; }};
}

using P = CenturionPage;

constexpr std::array kRows{
    port<&P::primary>("primary_port", "Primary Serial Port"),
    port<&P::secondary>("secondary_port", "Secondary Serial Port"),
    PageRow{"com1_baud", "110 ... 19200", "COM1 Baud Rate", set_baud<0>, baud_text<0>},
    PageRow{"com1_format", "E/7/2", "COM1 Parity, Data and Stop Bits", set_format<0>,
            format_text<0>},
    PageRow{"com2_baud", "110 ... 19200", "COM2 Baud Rate", set_baud<1>, baud_text<1>},
    PageRow{"com2_format", "E/7/2", "COM2 Parity, Data and Stop Bits", set_format<1>,
            format_text<1>},
    number<&P::buffer_size, 1, 256>("buffer_size", "1 to 256", "RS232 Buffer Size"),
    flag<&P::lf_becomes_cr>("lf_to_cr", "LF in change to CR"),
    flag<&P::sends_cr_lf>("eob_cr_lf", "End of Block send CR/LF"),
    character<&P::end_of_file>("eof_character", "RS-232 EOF character"),
    character<&P::tape_start>("tape_start", "Tape Start Character"),
    character<&P::tape_stop>("tape_stop", "Tape Stop Character"),
};

}  // namespace

std::span<const PageRow> page_rows() {
  return kRows;
}

Result<void> set_page_value(CenturionPage& page, std::string_view key, std::string_view value) {
  const auto row = std::ranges::find(kRows, key, &PageRow::key);
  if (row != kRows.end()) return row->set(page, key, value);
  return fail(Errc::NotFound, "{} is not an entry of the page", key.substr(0, 40));
}

}  // namespace dripline::wire
