#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/wire/discipline.hpp"
#include "protocol/wire/line_settings.hpp"

/// What is received from a control while it punches out, and what follows for the line's settings
/// and its cabling. Pure; any thread.
namespace dripline::wire {

/// Characters received while the line was set to `tried`: as 8 bits without parity, or with parity.
struct LineSample {
  LineSettings tried;
  std::string bytes;  ///< without those that had a fault
  std::size_t parity_faults = 0, framing_faults = 0, breaks = 0, overruns = 0;

  std::size_t faults() const { return parity_faults + framing_faults + breaks; }
  std::size_t size() const { return bytes.size() + faults(); }
};

/// How well a sample reads as NC program text, and as what.
struct SampleReading {
  double score = 0;  ///< 0..1: the share of characters that fit, of enough of them
  unsigned data_bits = 8;
  Parity parity = Parity::None;
  CharacterCode code = CharacterCode::Ascii;
  /// Every second character has a framing error and the rest is text: there is a ninth bit.
  bool has_ninth_bit = false;
};
/// A sample that is worth staying at.
inline constexpr double kGoodScore = 0.9;
SampleReading read_sample(const LineSample& sample);

/// Modem lines as we see them while we set ours.
struct LineWiring {
  InputLines all_on;   ///< with our RTS and DTR on
  InputLines rts_off;  ///< with RTS off
  InputLines dtr_off;  ///< with DTR off
};

struct LineObservation {
  std::vector<LineSample> samples;
  std::optional<LineWiring> wiring;  ///< nullopt: this channel has no modem lines
  /// Characters that came after our XOFF had left; nullopt: not tried.
  std::optional<std::size_t> after_stop;
  bool never_stopped = false;  ///< they did not end
  bool is_echoed = false;      ///< what we send comes back
};

struct LineDiagnosis {
  /// Baud, data bits, parity, code and end of block as heard; nullopt: nothing that reads as text.
  std::optional<LineSettings> settings;
  double confidence = 0;
  std::size_t characters = 0;         ///< of the sample that shows it
  std::vector<std::string> findings;  ///< a sentence each, the most important first
};
LineDiagnosis diagnose(const LineObservation& observation);

}  // namespace dripline::wire
