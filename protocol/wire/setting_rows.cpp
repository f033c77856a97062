#include <array>
#include <charconv>

#include "protocol/wire/impl/line_limits.hpp"
#include "protocol/wire/line_settings.hpp"
#include "protocol/wire/setting_value.hpp"

/// The keys of a port's settings: one row each.

namespace dripline::wire {

// "9600e72": baud, parity, data bits, stop bits.

namespace {

constexpr std::string_view kParityLetters = "neoms";  // in the order of Parity

std::string_view stop_bits_text(StopBits bits) {
  constexpr std::string_view kTexts[] = {"1", "1.5", "2"};
  return kTexts[static_cast<std::size_t>(bits)];
}

std::optional<StopBits> stop_bits_of(std::string_view text) {
  for (const StopBits bits : {StopBits::One, StopBits::OneAndHalf, StopBits::Two}) {
    if (stop_bits_text(bits) == text) return bits;
  }
  return std::nullopt;
}

tl::unexpected<Error> not_short_form(std::string_view text) {
  return fail(Errc::Syntax,
              "'{}' is not a line's short form: baud, one of n e o m s, 7 or 8, then 1, 1.5 or 2 "
              "(9600e72)",
              text);
}

}  // namespace

Result<void> apply_short_form(std::string_view text, LineSettings& settings) {
  unsigned baud = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), baud);
  if (error == std::errc::result_out_of_range) baud = kMaximumBaud + 1;
  const std::size_t digits = static_cast<std::size_t>(rest - text.data());
  if (digits == 0 || text.size() < digits + 3) return not_short_form(text);

  const char letter = text[digits];
  const std::size_t parity = kParityLetters.find(
      letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter);
  const char data = text[digits + 1];
  const std::optional<StopBits> stop = stop_bits_of(text.substr(digits + 2));
  if (parity == std::string_view::npos || (data != '7' && data != '8') || !stop) {
    return not_short_form(text);
  }
  if (baud < kMinimumBaud || baud > kMaximumBaud) {
    return fail(Errc::LimitExceeded, "line '{}': the baud rate is outside {} to {}", text,
                kMinimumBaud, kMaximumBaud);
  }
  settings.baud = baud;
  settings.parity = static_cast<Parity>(parity);
  settings.data_bits = static_cast<unsigned>(data - '0');
  settings.stop_bits = *stop;
  return {};
}

std::string short_form(const LineSettings& settings) {
  return fmt::format("{}{}{}{}", settings.baud,
                     kParityLetters[static_cast<std::size_t>(settings.parity)], settings.data_bits,
                     stop_bits_text(settings.stop_bits));
}

namespace {

/// A key as a template argument, so that a row's functions know its name.
template <std::size_t kSize>
struct Key {
  char text[kSize]{};
  constexpr Key(const char (&from)[kSize]) {  // implicit, because rows are written with literals
    for (std::size_t i = 0; i < kSize; ++i) text[i] = from[i];
  }
  constexpr std::string_view view() const { return {text, kSize - 1}; }
};

template <auto... kPath>
auto& at(LineSettings& settings) {
  return (settings.*....*kPath);
}
template <auto... kPath>
const auto& at(const LineSettings& settings) {
  return (settings.*....*kPath);
}

template <Key kKey, std::uint64_t kLeast, std::uint64_t kMax, auto... kPath>
constexpr SettingRow number(std::string_view text) {
  return {kKey.view(), "number", text,
          [](LineSettings& settings, std::string_view value) -> Result<void> {
            return store(parse_number(kKey.view(), value, {kLeast, kMax}), at<kPath...>(settings));
          },
          [](const LineSettings& settings) { return fmt::format("{}", at<kPath...>(settings)); }};
}

template <Key kKey, auto kMember, std::uint64_t kLeast = 0>
constexpr SettingRow duration(std::string_view text) {
  return {
      kKey.view(), "number", text,
      [](LineSettings& settings, std::string_view value) -> Result<void> {
        return store(parse_number(kKey.view(), value, {kLeast, kMaximumWait}), settings.*kMember);
      },
      [](const LineSettings& settings) { return fmt::format("{}", (settings.*kMember).count()); }};
}

template <Key kKey, auto kMember>
constexpr SettingRow limit(std::string_view text) {
  return {kKey.view(), "number|none", text,
          [](LineSettings& settings, std::string_view value) -> Result<void> {
            if (value == "none") {
              (settings.*kMember).reset();
              return {};
            }
            return store(parse_number(kKey.view(), value, {1, kMaximumWait}), settings.*kMember);
          },
          [](const LineSettings& settings) -> std::string {
            const auto& value = settings.*kMember;
            return value ? fmt::format("{}", value->count()) : "none";
          }};
}

template <Key kKey, auto... kPath>
constexpr SettingRow flag(std::string_view text) {
  return {kKey.view(), "yes|no", text,
          [](LineSettings& settings, std::string_view value) -> Result<void> {
            return store(parse_flag(kKey.view(), value), at<kPath...>(settings));
          },
          [](const LineSettings& settings) -> std::string {
            return at<kPath...>(settings) ? "yes" : "no";
          }};
}

template <Key kKey, auto... kPath>
constexpr SettingRow character(std::string_view text) {
  return {kKey.view(), "character", text,
          [](LineSettings& settings, std::string_view value) -> Result<void> {
            return store(parse_character(kKey.view(), value), at<kPath...>(settings));
          },
          [](const LineSettings& settings) { return character_text(at<kPath...>(settings)); }};
}

template <Key kKey, auto... kPath>
constexpr SettingRow optional_character(std::string_view text) {
  return {kKey.view(), "character|none", text,
          [](LineSettings& settings, std::string_view value) -> Result<void> {
            if (value == "none") {
              at<kPath...>(settings).reset();
              return {};
            }
            return store(parse_character(kKey.view(), value), at<kPath...>(settings));
          },
          [](const LineSettings& settings) -> std::string {
            const auto& value = at<kPath...>(settings);
            return value ? character_text(*value) : "none";
          }};
}

/// `kWords`: the words in the order of the enumerators, and the type that people see.
template <std::size_t kCount>
struct WordSet {
  std::string_view type;
  std::array<std::string_view, kCount> words;
};
constexpr WordSet<5> kParities{"none|even|odd|mark|space",
                               {"none", "even", "odd", "mark", "space"}};
constexpr WordSet<3> kStopBitWords{"1|1.5|2", {"1", "1.5", "2"}};
constexpr WordSet<8> kFlows{
    "none|xonxoff|rtscts|dc_codes|xmodem|heidenhain|heidenhain_bcc|tape_reader",
    {"none", "xonxoff", "rtscts", "dc_codes", "xmodem", "heidenhain", "heidenhain_bcc",
     "tape_reader"}};
constexpr WordSet<3> kCodes{"ascii|iso|eia", {"ascii", "iso", "eia"}};
constexpr WordSet<5> kEndsOfBlock{"lf|cr|crlf|lfcr|lfcrcr", {"lf", "cr", "crlf", "lfcr", "lfcrcr"}};
constexpr WordSet<4> kControls{"plain|fanuc|prototrak|centurion",
                               {"plain", "fanuc", "prototrak", "centurion"}};
constexpr WordSet<4> kOffers{"none|named|all|repeat", {"none", "named", "all", "repeat"}};
constexpr WordSet<3> kTncStops{"dc3|rts|both", {"dc3", "rts", "both"}};
constexpr WordSet<5> kReaderFaults{
    "none|parity|chad|missing_sprocket|sprocket_spacing",
    {"none", "parity", "chad", "missing_sprocket", "sprocket_spacing"}};
constexpr WordSet<5> kDncModes{"off|fast|run|verify|continue",
                               {"off", "fast", "run", "verify", "continue"}};

template <Key kKey, const auto& kWords, auto... kPath>
constexpr SettingRow choice(std::string_view text) {
  return {kKey.view(), kWords.type, text,
          [](LineSettings& settings, std::string_view value) -> Result<void> {
            return store(parse_word(kKey.view(), value, kWords.words), at<kPath...>(settings));
          },
          [](const LineSettings& settings) {
            return std::string(kWords.words[static_cast<std::size_t>(at<kPath...>(settings))]);
          }};
}

constexpr std::uint64_t kLeastReaderRate = 1, kMaxReaderRate = 100'000;

Result<void> set_reader_rate(LineSettings& settings, std::string_view value) {
  return store(parse_rate("reader_cps", value, {kLeastReaderRate, kMaxReaderRate}),
               settings.reader.characters_per_second);
}

Result<void> set_short_form(LineSettings& settings, std::string_view value) {
  return apply_short_form(value, settings);
}

using S = LineSettings;
using H = HeidenhainSettings;
using C = ControlSettings;

constexpr std::array kSettingRows{
    SettingRow{"line", "9600e72", "baud, parity, data and stop bits in one word", set_short_form,
               short_form},
    number<"baud", kMinimumBaud, kMaximumBaud, &S::baud>("bits per second"),
    number<"data_bits", 7, 8, &S::data_bits>("bits of a character, without parity"),
    choice<"parity", kParities, &S::parity>("parity bit that the UART makes and checks"),
    choice<"stop_bits", kStopBitWords, &S::stop_bits>("stop bits"),
    choice<"flow", kFlows, &S::flow>("flow control, or the whole protocol"),
    choice<"code", kCodes, &S::code>("code of the characters on the line"),
    choice<"eob", kEndsOfBlock, &S::end_of_block>("end of block that is sent"),
    number<"leader", 0, kMaximumBlank, &S::leader>("blank characters (NUL) before a program"),
    number<"trailer", 0, kMaximumBlank, &S::trailer>("blank characters (NUL) after a program"),
    optional_character<"start_char", &S::start_character>(
        "sent before a program, removed from a received one"),
    optional_character<"end_char", &S::end_character>("sent after a program, ends a received one"),
    flag<"wait_for_xon", &S::wait_for_xon>("wait for the control's DC1 before sending a program"),
    duration<"line_delay_ms", &S::line_delay>("pause after each end of block"),
    duration<"char_delay_us", &S::character_delay>("pause after each character"),
    duration<"idle_end_ms", &S::idle_end>(
        "silence that ends a received program without an end_char"),
    duration<"rest_gap_ms", &S::rest_gap>(
        "silence after the line was opened (server started, taken over): what the control prints "
        "sooner is marked, as it may be the rest of an earlier transmission"),
    limit<"start_limit_ms", &S::start_limit>("longest wait for the control to begin a program"),
    limit<"answer_limit_ms", &S::answer_limit>("longest wait for the other end's answer"),
    limit<"hold_limit_ms", &S::hold_limit>("longest wait for XON or CTS while held"),
    duration<"pause_limit_ms", &S::pause_limit, 100>(
        "longest pause of a received program before it is dropped"),
    choice<"offer", kOffers, &S::offer>(
        "send to a control that asks while no run waits: nothing, the named program, all, or the "
        "program of the last run once more, as a tape that stays in the reader"),
    number<"retries", 0, kMaximumRetries, &S::retries>("repeats of one block, checked protocols"),
    flag<"xmodem_crc", &S::xmodem_crc>("XMODEM: ask for CRC before the checksum"),
    flag<"extract_programs", &S::extracts_programs>(
        "split received text at its O lines, a program each"),
    number<"program_memory", 0, 1'000'000'000, &S::program_memory>(
        "bytes of sent programs that the control's memory holds; 0: not known"),
    character<"tnc_heading", &S::heidenhain, &H::heading>(
        "TNC blockwise: type of the headings that are sent"),
    character<"tnc_soh", &S::heidenhain, &H::soh>("TNC blockwise: start of a heading"),
    character<"tnc_stx", &S::heidenhain, &H::stx>("TNC blockwise: start of a block"),
    character<"tnc_etx", &S::heidenhain, &H::etx>("TNC: end of a program"),
    character<"tnc_eot", &S::heidenhain, &H::eot>("TNC: end of a transmission"),
    character<"tnc_ack", &S::heidenhain, &H::ack>("TNC blockwise: block accepted"),
    character<"tnc_nak", &S::heidenhain, &H::nak>("TNC blockwise: block refused"),
    character<"tnc_etb", &S::heidenhain, &H::etb>("TNC blockwise: end of a block"),
    choice<"tnc_stop", kTncStops, &S::heidenhain, &H::stop>(
        "TNC standard interface: signal that stops the sender (MP222, bits 2 and 3)"),
    flag<"tnc_line_end", &S::heidenhain, &H::line_end_in_block>(
        "TNC blockwise: CR LF inside each block"),
    flag<"tnc_printable_bcc", &S::heidenhain, &H::bcc_is_printable>(
        "TNC blockwise: a blank keeps the check character printable"),
    flag<"tnc_dc1", &S::heidenhain, &H::sends_dc1_after_block>("TNC blockwise: DC1 after a block"),
    flag<"tnc_repeat", &S::heidenhain, &H::repeats_unanswered>(
        "TNC blockwise: repeat an unanswered block instead of waiting"),
    SettingRow{"reader_cps", "number", "tape reader: characters per second", set_reader_rate,
               [](const LineSettings& settings) {
                 return fmt::format("{}", settings.reader.characters_per_second);
               }},
    flag<"reader_block_stop", &S::reader, &ReaderSettings::stops_at_end_of_block>(
        "tape reader: stop at each end of block"),
    choice<"reader_fault", kReaderFaults, &S::reader, &ReaderSettings::fault>(
        "tape reader: fault of one row, for tests"),
    number<"reader_fault_row", 0, 1'000'000'000, &S::reader, &ReaderSettings::fault_row>(
        "tape reader: number of that row, from 1"),
    choice<"control", kControls, &S::control, &C::kind>("rules that our end follows as a control"),
    number<"buffer_size", 1, kMaximumBufferSize, &S::control, &C::buffer_size>(
        "characters that a control accepts after it sent stop"),
    optional_character<"tape_start", &S::control, &C::tape_start>(
        "Centurion: sent when it begins to read a tape"),
    optional_character<"tape_stop", &S::control, &C::tape_stop>(
        "Centurion: sent when it has read a tape"),
    flag<"split_programs", &S::control, &C::splits_programs>(
        "Centurion: begin a program at each O line"),
    choice<"dnc_mode", kDncModes, &S::control, &C::dnc>("Centurion: run the received program"),
    number<"dnc_skip", 0, 1'000'000'000, &S::control, &C::dnc_skip>(
        "Centurion: blocks dropped before a DNC run"),
};

}  // namespace

std::span<const SettingRow> setting_rows() {
  return kSettingRows;
}

}  // namespace dripline::wire
