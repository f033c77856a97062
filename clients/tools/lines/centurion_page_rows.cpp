#include <algorithm>

#include "clients/tools/lines/centurion_page.hpp"
#include "protocol/wire/setting_value.hpp"

/// The entries of the Centurion's serial page: one row each.
namespace dripline::wire {
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

template <auto kMember>
constexpr PageRow port(std::string_view key, std::string_view text,
                       Result<void> (*set)(CenturionPage&, std::string_view)) {
  return {key, "none|com1|com2", text, set, [](const CenturionPage& page) {
            return std::string(kPorts[static_cast<std::size_t>(page.*kMember)]);
          }};
}

template <auto kMember>
Result<void> set_port(CenturionPage& page, std::string_view key, std::string_view value) {
  const auto parsed = parse_word(key, lower(value), kPorts);
  if (!parsed) return fail(parsed.error());
  page.*kMember = static_cast<ComPort>(*parsed);
  return {};
}

template <std::size_t kCom>
Result<void> set_baud(CenturionPage& page, std::string_view value) {
  constexpr std::string_view kKey = kCom == 0 ? "com1_baud" : "com2_baud";
  const auto parsed = parse_word(kKey, value, kBauds);
  if (!parsed) return fail(parsed.error());
  const auto number = parse_number(kKey, value, {110, 19200});
  if (!number) return fail(number.error());
  page.com[kCom].baud = static_cast<unsigned>(*number);
  return {};
}

/// "E/7/2": parity, data bits, stop bits.
template <std::size_t kCom>
Result<void> set_format(CenturionPage& page, std::string_view value) {
  const std::string text = lower(value);
  const auto parity = text.size() == 5 ? kParityLetters.find(text[0]) : std::string::npos;
  const bool is_well = parity != std::string::npos && text[1] == '/' && text[3] == '/' &&
                       (text[2] == '7' || text[2] == '8') && (text[4] == '1' || text[4] == '2');
  if (!is_well) {
    return fail(Errc::Syntax, "{} = {}: expected N, E or O / 7 or 8 / 1 or 2, such as E/7/2",
                kCom == 0 ? "com1_format" : "com2_format", value.substr(0, 20));
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

template <unsigned CenturionPage::*kMember>
Result<void> set_number(CenturionPage& page, std::string_view key, std::string_view value,
                        SettingRange range) {
  const auto parsed = parse_number(key, value, range);
  if (!parsed) return fail(parsed.error());
  page.*kMember = static_cast<unsigned>(*parsed);
  return {};
}

template <unsigned CenturionPage::*kMember>
std::string number_text(const CenturionPage& page) {
  return fmt::format("{}", page.*kMember);
}

template <bool CenturionPage::*kMember>
Result<void> set_flag(CenturionPage& page, std::string_view key, std::string_view value) {
  const auto parsed = parse_flag(key, value);
  if (!parsed) return fail(parsed.error());
  page.*kMember = *parsed;
  return {};
}

template <bool CenturionPage::*kMember>
std::string flag_text(const CenturionPage& page) {
  return page.*kMember ? "yes" : "no";
}

using P = CenturionPage;
using V = std::string_view;
constexpr SettingRange kAscii{0, 127};

constexpr std::array kRows{
    port<&P::primary>("primary_port", "Primary Serial Port",
                      [](P& p, V v) { return set_port<&P::primary>(p, "primary_port", v); }),
    port<&P::secondary>("secondary_port", "Secondary Serial Port",
                        [](P& p, V v) { return set_port<&P::secondary>(p, "secondary_port", v); }),
    PageRow{"com1_baud", "110 ... 19200", "COM1 Baud Rate", set_baud<0>, baud_text<0>},
    PageRow{"com1_format", "E/7/2", "COM1 Parity, Data and Stop Bits", set_format<0>,
            format_text<0>},
    PageRow{"com2_baud", "110 ... 19200", "COM2 Baud Rate", set_baud<1>, baud_text<1>},
    PageRow{"com2_format", "E/7/2", "COM2 Parity, Data and Stop Bits", set_format<1>,
            format_text<1>},
    PageRow{"buffer_size", "1 to 256", "RS232 Buffer Size",
            [](P& p, V v) {
              return set_number<&P::buffer_size>(p, "buffer_size", v, {1, 256});
            },
            number_text<&P::buffer_size>},
    PageRow{"lf_to_cr", "yes|no", "LF in change to CR",
            [](P& p, V v) { return set_flag<&P::lf_becomes_cr>(p, "lf_to_cr", v); },
            flag_text<&P::lf_becomes_cr>},
    PageRow{"eob_cr_lf", "yes|no", "End of Block send CR/LF",
            [](P& p, V v) { return set_flag<&P::sends_cr_lf>(p, "eob_cr_lf", v); },
            flag_text<&P::sends_cr_lf>},
    PageRow{"eof_character", "0 to 127", "RS-232 EOF character",
            [](P& p, V v) { return set_number<&P::end_of_file>(p, "eof_character", v, kAscii); },
            number_text<&P::end_of_file>},
    PageRow{"tape_start", "0 to 127", "Tape Start Character",
            [](P& p, V v) { return set_number<&P::tape_start>(p, "tape_start", v, kAscii); },
            number_text<&P::tape_start>},
    PageRow{"tape_stop", "0 to 127", "Tape Stop Character",
            [](P& p, V v) { return set_number<&P::tape_stop>(p, "tape_stop", v, kAscii); },
            number_text<&P::tape_stop>},
};

}  // namespace

std::span<const PageRow> page_rows() {
  return kRows;
}

Result<void> set_page_value(CenturionPage& page, std::string_view key, std::string_view value) {
  const auto row = std::ranges::find(kRows, key, &PageRow::key);
  if (row != kRows.end()) return row->set(page, value);
  return fail(Errc::NotFound, "{} is not an entry of the page", key.substr(0, 40));
}

}  // namespace dripline::wire
