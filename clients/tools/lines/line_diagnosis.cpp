#include "clients/tools/lines/line_diagnosis.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "protocol/wire/tape_code.hpp"

namespace dripline::wire {
namespace {

/// Characters of programs and of what surrounds them.
bool is_program_character(std::uint8_t c) {
  constexpr std::string_view kSigns = " +-.,/()%:;=#*[]'\"$&<>_!?";
  constexpr std::string_view kControls("\0\t\n\r\x02\x03\x04\x11\x12\x13\x14\x7F", 12);
  const char character = static_cast<char>(c);
  const bool is_word = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z');
  return is_word || kSigns.find(character) != kSigns.npos ||
         kControls.find(character) != kControls.npos;
}

/// Small letters occur in comments only.
double weight(std::uint8_t c) {
  if (is_program_character(c)) return 1;
  return c >= 'a' && c <= 'z' ? 0.5 : 0;
}

/// The kind of text the characters look like; blanks are neutral.
struct Census {
  double text = 0, eia_text = 0;  ///< that read as program characters: the low 7 bits, EIA
  std::size_t all = 0, even = 0, odd = 0, high = 0;
};

Census count(std::string_view bytes) {
  Census census;
  for (const char c : bytes) {
    const auto byte = static_cast<std::uint8_t>(c);
    if (byte == 0) continue;
    ++census.all;
    ++(std::popcount(byte) % 2 == 0 ? census.even : census.odd);
    if (byte >= 0x80) ++census.high;
    census.text += weight(byte & 0x7F);
    const auto kind = decode_row(CharacterCode::Eia, byte).kind;
    if (kind != RowKind::WrongParity && kind != RowKind::Unassigned) census.eia_text += 1;
  }
  return census;
}

/// The eighth bit of 8 bits without parity, as parity. Few characters fit by chance, so all must.
SampleReading read_eight_bits(const Census& census) {
  SampleReading reading;
  const auto all = static_cast<double>(census.all);
  const auto share = [all](double part) { return all == 0 ? 0 : part / all; };
  const double text = share(census.text);
  struct Form {
    double score;
    unsigned data_bits;
    Parity parity;
    CharacterCode code;
  };
  const auto low = static_cast<double>(census.all - census.high);
  const std::array forms{
      Form{text * share(low), 8, Parity::None, CharacterCode::Ascii},
      Form{text * share(static_cast<double>(census.even)), 7, Parity::Even, CharacterCode::Ascii},
      Form{share(census.eia_text) * share(static_cast<double>(census.odd)), 8, Parity::None,
           CharacterCode::Eia},
      Form{text * share(static_cast<double>(census.odd)), 7, Parity::Odd, CharacterCode::Ascii},
      Form{text * share(static_cast<double>(census.high)), 7, Parity::Mark, CharacterCode::Ascii},
  };
  const auto best = std::ranges::max_element(forms, {}, &Form::score);
  reading.score = best->score;
  reading.data_bits = best->data_bits;
  reading.parity = best->parity;
  reading.code = best->code;
  return reading;
}

std::string_view parity_word(Parity parity) {
  constexpr std::array<std::string_view, 5> kWords{"no parity", "even parity", "odd parity",
                                                   "mark parity", "space parity"};
  return kWords[static_cast<std::size_t>(parity)];
}

/// How often each form ends a block; the characters between two texts count as one end.
EndOfBlock most_used_end(std::string_view bytes) {
  std::array<std::size_t, 5> used{};
  std::string end;
  const auto note = [&] {
    constexpr std::array<std::string_view, 5> kForms{"\n", "\r", "\r\n", "\n\r", "\n\r\r"};
    const auto form = std::ranges::find(kForms, end);
    if (form != kForms.end()) ++used[static_cast<std::size_t>(form - kForms.begin())];
    end.clear();
  };
  for (const char c : bytes) {
    const char low = static_cast<char>(c & 0x7F);
    if (low == '\r' || low == '\n') {
      end += low;
    } else if (low != 0) {
      note();
    }
  }
  note();
  return static_cast<EndOfBlock>(std::ranges::max_element(used) - used.begin());
}

std::string_view end_word(EndOfBlock end) {
  constexpr std::array<std::string_view, 5> kWords{"LF", "CR", "CR LF", "LF CR", "LF CR CR"};
  return kWords[static_cast<std::size_t>(end)];
}

class Doctor {
 public:
  explicit Doctor(const LineObservation& seen) : seen_(seen) {}

  LineDiagnosis diagnose() {
    const LineSample* best = nullptr;
    double best_score = 0;
    for (const auto& sample : seen_.samples) {
      const double score = read_sample(sample).score;
      if (score > best_score || best == nullptr) best = &sample;
      best_score = std::max(best_score, score);
    }
    const bool is_heard = std::ranges::any_of(
        seen_.samples, [](const LineSample& sample) { return sample.size() > 0; });
    if (!is_heard) {
      say_silence();
    } else if (best_score < 0.5) {
      say_garbage();
    } else {
      judge(*best, read_sample(*best));
    }
    say_stop();
    say_wiring();
    return std::move(result_);
  }

 private:
  template <class... Args>
  void say(fmt::format_string<Args...> format, Args&&... args) {
    result_.findings.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  void judge(const LineSample& sample, const SampleReading& reading) {
    LineSettings settings = sample.tried;
    settings.data_bits = reading.data_bits;
    settings.parity = reading.parity;
    settings.code = reading.code;
    result_.confidence = reading.score;
    result_.characters = sample.bytes.size();
    say("{} baud, {} data bits, {}: {} characters came, {} of them with errors.", settings.baud,
        settings.data_bits, parity_word(settings.parity), sample.size(), sample.faults());
    if (reading.score < kGoodScore) {
      say("That is not certain: {:.0f} of 100 characters read as a program. Let the control punch "
          "again, for longer.",
          reading.score * 100);
    }
    say_code(sample, reading);
    if (reading.code != CharacterCode::Eia) {
      settings.end_of_block = most_used_end(sample.bytes);
      say("Blocks end with {}.", end_word(settings.end_of_block));
    }
    say("Stop bits cannot be heard; two, when in doubt, are taken by every control.");
    if (sample.overruns > 0) {
      say("{} characters were lost on this computer (overrun): slow the line down.",
          sample.overruns);
    }
    result_.settings = settings;
  }

  void say_code(const LineSample& sample, const SampleReading& reading) {
    if (reading.code == CharacterCode::Eia) {
      say("The code is EIA (RS-244): every character has an odd number of ones, blocks end with "
          "0x80. Set code=eia.");
    } else if (reading.parity == Parity::Even && sample.tried.parity == Parity::None) {
      say("The eighth bit makes the number of ones even: 7 data bits with even parity, or 8 bits "
          "with code=iso for a control that means tape.");
    } else if (reading.parity == Parity::Mark) {
      say("The eighth bit is always one: 7 data bits with mark parity, or with two stop bits.");
    }
  }

  void say_garbage() {
    std::size_t breaks = 0, framing = 0, all = 0;
    bool has_ninth_bit = false;
    for (const auto& sample : seen_.samples) {
      breaks += sample.breaks;
      framing += sample.framing_faults;
      all += sample.size();
      has_ninth_bit = has_ninth_bit || read_sample(sample).has_ninth_bit;
    }
    say("{} characters came, and at no rate did they read as a program.", all);
    if (has_ninth_bit) {
      say("Every second one has a framing error although the rest is text: the control sends 8 "
          "data bits and a parity bit. Try 8e1 and 8o1.");
    } else if (breaks * 2 > all) {
      say("Most are breaks: the line is at the wrong level. Look for an open or missing ground "
          "(pin 7 of 25, pin 5 of 9) and for pins 2 and 3 that are swapped.");
    } else if (framing * 2 > all) {
      say("Most have framing errors: the rate is one that was not tried, or the ground (pin 7 of "
          "25, pin 5 of 9) is missing.");
    } else {
      say("They have few framing errors: this may be a code of its own, a listing in binary, or a "
          "protocol that is not text.");
    }
  }

  void say_silence() {
    say("Nothing came.");
    if (seen_.is_echoed) {
      say("What we send comes back: our data pins (2 and 3) are connected somewhere, so the cable "
          "ends before the control.");
      return;
    }
    if (!seen_.wiring) {
      say("This connection has no modem lines to look at. Was the control punching, and to this "
          "connector?");
      return;
    }
    const auto& on = seen_.wiring->all_on;
    if (!on.cts && !on.dsr && !on.dcd) {
      say("CTS, DSR and DCD are off: nothing is at the other end, or the cable has three wires "
          "only. Is the control on and the cable in its connector?");
    } else {
      say("Modem lines are on, so a cable is there. Either the control was not punching, or data "
          "does not cross: both ends send on the same pin, and a null modem (2 and 3 crossed) is "
          "missing.");
    }
  }

  void say_stop() {
    if (!seen_.after_stop) return;
    if (seen_.never_stopped) {
      say("The control continues to send after XOFF ({} characters and more): it does not listen "
          "to "
          "XOFF. Use RTS/CTS, or take everything at the line's rate.",
          *seen_.after_stop);
    } else {
      say("After XOFF {} more characters came.", *seen_.after_stop);
    }
  }

  void say_wiring() {
    if (!seen_.wiring) return;
    const auto& wiring = *seen_.wiring;
    if (wiring.all_on.cts && !wiring.rts_off.cts) {
      say("CTS follows our RTS: the two are joined at the other end or in the cable. RTS/CTS can "
          "hold nothing here; use XON/XOFF or pauses.");
    } else if (!wiring.all_on.cts) {
      say("CTS is off: with flow=rtscts, or tnc_stop=rts, nothing would ever be sent.");
    }
    if (wiring.all_on.dsr && !wiring.dtr_off.dsr) {
      say("DSR follows our DTR: the two are joined at the other end or in the cable, so DSR does "
          "not tell whether the control is on.");
    }
  }

  const LineObservation& seen_;
  LineDiagnosis result_;
};

}  // namespace

SampleReading read_sample(const LineSample& sample) {
  const Census census = count(sample.bytes);
  SampleReading reading;
  if (sample.tried.data_bits == 8 && sample.tried.parity == Parity::None) {
    reading = read_eight_bits(census);
  } else {
    reading.data_bits = sample.tried.data_bits;
    reading.parity = sample.tried.parity;
    reading.score = census.all == 0 ? 0 : census.text / static_cast<double>(census.all);
  }
  const auto size = static_cast<double>(sample.size());
  const double clean = size == 0 ? 0 : 1 - static_cast<double>(sample.faults()) / size;
  reading.has_ninth_bit = reading.score > kGoodScore && census.all >= 8 && clean > 0.2 &&
                          clean < 0.8 && sample.framing_faults > sample.parity_faults;
  // A handful of characters fits by chance.
  const double enough = 1 - std::pow(0.5, static_cast<double>(census.all) / 4);
  reading.score *= clean * enough;
  return reading;
}

LineDiagnosis diagnose(const LineObservation& observation) {
  return Doctor(observation).diagnose();
}

}  // namespace dripline::wire
