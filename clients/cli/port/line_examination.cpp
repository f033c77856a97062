#include "clients/cli/port/line_examination.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>

namespace dripline::cli {
namespace {

using std::chrono::milliseconds;
using wire::LineSample;
using wire::LineTime;

constexpr char kXon = 0x11, kXoff = 0x13;
/// Most controls first.
constexpr std::array kRates{9600U,  4800U, 2400U,   19200U, 1200U, 38400U,
                            57600U, 600U,  115200U, 300U,   150U,  110U};
constexpr std::size_t kSlice = 32;     ///< characters that tell whether a rate is right
constexpr std::size_t kEnough = 2000;  ///< of the right rate
constexpr milliseconds kSliceTime{2000}, kQuiet{400}, kSettle{60}, kStayTime{3000};
constexpr std::size_t kNeverStopped = 4096;

class Examination {
 public:
  explicit Examination(const LineExamination& parts) : parts_(parts) {}

  Result<wire::LineObservation> run() {
    if (auto looked = look_at_lines(); !looked) return fail(looked.error());
    if (auto heard = listen(); !heard) return fail(heard.error());
    const bool is_silent = std::ranges::all_of(
        seen_.samples, [](const LineSample& sample) { return sample.size() == 0; });
    if (is_silent) {
      if (auto tried = try_echo(); !tried) return fail(tried.error());
    }
    return std::move(seen_);
  }

 private:
  Result<void> look_at_lines() {
    auto& channel = parts_.channel;
    const auto look = [&](wire::OutputLines lines) -> Result<std::optional<wire::InputLines>> {
      if (auto set = channel.set_output_lines(lines); !set) return fail(set.error());
      pause(kSettle);
      return channel.input_lines();
    };
    const auto on = look({true, true});
    if (!on) return on.error().code == Errc::Unsupported ? Result<void>() : fail(on.error());
    if (!*on) return {};
    const auto rts = look({false, true}), dtr = look({true, false});
    if (!rts || !dtr) return fail(rts ? dtr.error() : rts.error());
    seen_.wiring = wire::LineWiring{**on, rts->value_or(**on), dtr->value_or(**on)};
    return channel.set_output_lines({true, true});
  }

  /// One rate after the other; each as 8 bits without parity, which shows all others.
  Result<void> listen() {
    const LineTime end = parts_.now() + parts_.listen;
    std::size_t next = 0;
    std::vector<wire::LineSettings> tries;
    while (parts_.now() < end && !parts_.is_ended()) {
      if (tries.empty()) tries.push_back(eight_bits(kRates[next++ % kRates.size()]));
      const auto tried = tries.back();
      tries.pop_back();
      auto sample = take_slice(tried, end);
      if (!sample) return fail(sample.error());
      const auto reading = wire::read_sample(*sample);
      if (reading.score >= wire::kGoodScore) return stay(std::move(*sample), reading, end);
      if (reading.has_ninth_bit) {
        for (const auto parity : {wire::Parity::Odd, wire::Parity::Even}) {
          tries.push_back(tried);
          tries.back().parity = parity;
        }
      }
      keep(std::move(*sample));
    }
    return {};
  }

  static wire::LineSettings eight_bits(unsigned rate) {
    wire::LineSettings settings;
    settings.baud = rate;
    return settings;
  }

  /// The best sample of each setting is kept.
  void keep(LineSample sample) {
    for (auto& known : seen_.samples) {
      if (known.tried.baud != sample.tried.baud || known.tried.parity != sample.tried.parity)
        continue;
      if (sample.size() > known.size()) known = std::move(sample);
      return;
    }
    seen_.samples.push_back(std::move(sample));
  }

  Result<LineSample> take_slice(const wire::LineSettings& settings, LineTime end) {
    LineSample sample;
    sample.tried = settings;
    auto applied = parts_.channel.apply(settings);
    is_fixed_ = !applied && applied.error().code == Errc::Unsupported;
    if (!applied && !is_fixed_) return fail(applied.error());
    parts_.say(fmt::format("listening at {}", wire::short_form(settings)));
    LineSample dropped;  // characters in transit while the rate changed
    if (auto read = drain(dropped); !read) return fail(read.error());
    // No rate can be distinguished from another before a character arrives.
    while (sample.size() == 0 && parts_.now() < end && !parts_.is_ended()) {
      parts_.wait(milliseconds(100));
      if (auto read = drain(sample); !read) return fail(read.error());
    }
    if (auto read = collect(sample, kSlice, kSliceTime); !read) return fail(read.error());
    return sample;
  }

  /// Until there are `count` characters, nothing comes any more, or the time is over.
  Result<void> collect(LineSample& sample, std::size_t count, milliseconds time) {
    const LineTime end = parts_.now() + time;
    while (sample.size() < count && parts_.now() < end && !parts_.is_ended() && !is_quiet()) {
      parts_.wait(milliseconds(50));
      if (auto read = drain(sample); !read) return read;
    }
    return {};
  }

  bool is_quiet() const { return parts_.now() - heard_ > kQuiet; }

  Result<void> drain(LineSample& sample) {
    std::array<std::byte, 512> room{};
    for (;;) {
      const auto got = parts_.channel.read(room);
      if (!got) return fail(got.error());
      if (got->bytes == 0 && !got->fault) return {};
      heard_ = parts_.now();
      if (sample.size() > kEnough * 4) continue;
      sample.bytes.append(reinterpret_cast<const char*>(room.data()), got->bytes);
      if (got->fault) note(sample, *got->fault);
    }
  }

  static void note(LineSample& sample, wire::LineFault fault) {
    using enum wire::LineFault;
    if (fault == Parity) ++sample.parity_faults;
    if (fault == Framing) ++sample.framing_faults;
    if (fault == Break) ++sample.breaks;
    if (fault == Overrun) ++sample.overruns;
  }

  Result<void> stay(LineSample sample, const wire::SampleReading& reading, LineTime) {
    parts_.say(fmt::format("this reads as a program; listening on at {} baud", sample.tried.baud));
    if (auto heard = collect(sample, kEnough, kStayTime); !heard) return heard;
    const auto tried = sample.tried;
    keep(std::move(sample));
    const bool knows_stop = reading.code == wire::CharacterCode::Ascii;
    if (!parts_.tries_stop || !knows_stop || is_quiet() || parts_.is_ended()) return {};
    return try_stop(tried, reading);
  }

  Result<void> try_stop(wire::LineSettings settings, const wire::SampleReading& reading) {
    settings.data_bits = reading.data_bits;
    settings.parity = reading.parity;
    if (auto applied = parts_.channel.apply(settings); !applied && !is_fixed_) return applied;
    parts_.say("sending XOFF and counting");
    LineSample before, after, again;
    if (auto read = drain(before); !read) return read;
    if (auto sent = send(kXoff); !sent) return sent;
    pause(std::chrono::ceil<milliseconds>(wire::character_time(settings)));
    heard_ = parts_.now();
    if (auto read = collect(after, kNeverStopped, kStayTime); !read) return read;
    const bool is_stopped = is_quiet();
    if (auto sent = send(kXon); !sent) return sent;
    if (is_stopped) {
      heard_ = parts_.now() + kStayTime;  // the control may take its time
      if (auto read = collect(again, 1, kStayTime); !read) return read;
      if (again.size() == 0) return {};  // it had nothing more to say: XOFF was not why it ended
    }
    seen_.after_stop = after.size();
    seen_.never_stopped = !is_stopped;
    return {};
  }

  Result<void> send(char character) {
    const auto byte = static_cast<std::byte>(character);
    const auto sent = parts_.channel.write({&byte, 1});
    return sent ? Result<void>() : fail(sent.error());
  }

  /// Blanks hurt no control.
  Result<void> try_echo() {
    constexpr std::size_t kBlanks = 3;
    if (auto applied = parts_.channel.apply(eight_bits(9600)); !applied && !is_fixed_)
      return applied;
    for (std::size_t i = 0; i < kBlanks; ++i) {
      if (auto sent = send('\0'); !sent) return sent;
    }
    LineSample heard;
    heard_ = parts_.now();
    if (auto read = collect(heard, kBlanks, kQuiet); !read) return read;
    seen_.is_echoed = heard.bytes == std::string(kBlanks, '\0');
    return {};
  }

  void pause(milliseconds time) {
    const LineTime end = parts_.now() + time;
    while (parts_.now() < end) {
      parts_.wait(std::chrono::ceil<milliseconds>(end - parts_.now()));
    }
  }

  const LineExamination& parts_;
  wire::LineObservation seen_;
  LineTime heard_{};       ///< when something came last
  bool is_fixed_ = false;  ///< this channel's settings cannot be changed from here
};

}  // namespace

Result<wire::LineObservation> examine_line(const LineExamination& parts) {
  return Examination(parts).run();
}

}  // namespace dripline::cli
