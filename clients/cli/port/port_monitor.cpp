#include "clients/cli/port/port_monitor.hpp"

#include <unistd.h>
#include <chrono>

#include "clients/cli/context.hpp"
#include "clients/cli/port/port_text.hpp"
#include "clients/cli/port/traffic_text.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/terminal.hpp"
#include "clients/cli/text/value_text.hpp"
#include "clients/lib/event_stream.hpp"
#include "protocol/base/clock.hpp"

namespace dripline::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kIdle = 200ms;         ///< silence after which a begun line is shown
constexpr auto kStateEvery = 1000ms;  ///< how often the server is asked for the state of the line

class PortMonitor {
 public:
  PortMonitor(Context& context, client::Client& client, const MonitorCommand& command)
      : context_(context),
        client_(client),
        name_(command.name),
        text_({command.is_hex, context.has_color()}) {}

  int run() {
    auto port = client_.port(name_);
    if (!port) return complain(port.error());
    greet(*port);
    take_state(*port);
    auto stream = client::EventStream::of_port(client_.servers(), name_);
    while (!is_interrupted() && !is_denied_) {
      const auto item = stream.next(kIdle);
      if (item) std::visit([this](const auto& one) { take(one); }, *item);
      if (!item) print(text_.flush());
      if (clock_.steady_now() >= next_state_) ask_state();
    }
    print(text_.flush());
    area_.clear();
    return is_denied_ ? kExitDenied : kExitInterrupted;
  }

 private:
  void greet(const client::Port& port) {
    if (context_.wants_json) return;
    print_error("{} of {} at {}, {}.  → to the control, ← from it, Ctrl-C ends.\n", port.name,
                port.machine, port.address, line_text(port.effective));
  }

  void take(const client::StreamOpened&) { said_.clear(); }
  void take(const client::StreamLost& lost) {
    if (lost.failure.kind == client::Failure::Kind::Denied) {
      complain(lost.failure);
      is_denied_ = true;
      return;
    }
    say_once(lost.failure.what + "; trying again");
  }
  void take(const client::Machine&) {}
  void take(const client::Run&) {}
  void take(const client::Record&) {}
  void take(const client::Port& port) { take_state(port); }
  void take(const client::Traffic& traffic) {
    print(context_.wants_json ? json_line(client::to_json_value(traffic)) : text_.add(traffic));
  }
  void take(const client::TrafficLost& lost) {
    if (context_.wants_json) return print(json_line({{"lost", lost.count}}));
    note("lost", fmt::format("{} entries are missing here: the line was faster than this terminal",
                             lost.count));
  }

  void ask_state() {
    auto port = client_.port(name_);
    if (port) {
      take_state(*port);
    } else {
      say_once(port.error().what);
    }
    next_state_ = clock_.steady_now() + kStateEvery;
  }

  /// Prints the state of the line when it changes, and on a terminal the counters below.
  void take_state(const client::Port& port) {
    if (context_.wants_json) return;
    std::string state = state_text(port);
    if (port.request) state += "; " + request_text(port.request);
    if (!port.fault.empty()) state += "; " + port.fault;
    if (state != state_) note("state", state);
    state_ = state;
    live_ = fmt::format("{}  {}  → {}  ← {}", name_, state, bytes_text(port.sent),
                        bytes_text(port.received));
    area_.show({live_});
  }

  void note(const std::string& what, const std::string& text) {
    print(text_.add({name_, to_iso8601(clock_.now()), what, "", text}));
  }

  void print(const std::string& text) {
    if (text.empty()) return;
    area_.clear();
    context_.print(text);
    std::fflush(stdout);
    if (!live_.empty()) area_.show({live_});
  }

  void say_once(const std::string& text) {
    if (said_ == text) return;
    said_ = text;
    area_.clear();
    print_error("dnc: {}\n", text);
  }

  Context& context_;
  client::Client& client_;
  const std::string name_;
  TrafficText text_;
  SystemClock clock_;
  LiveArea area_ = LiveArea::on_stderr();
  SteadyTime next_state_{};
  std::string state_, live_, said_;
  bool is_denied_ = false;
};

/// Cuts what comes in pieces into lines.
class Lines {
 public:
  template <class Take>
  bool feed(std::string_view bytes, const Take& take) {
    rest_ += bytes;
    std::size_t begin = 0;
    for (std::size_t end; (end = rest_.find('\n', begin)) != std::string::npos; begin = end + 1) {
      if (!take(std::string_view(rest_).substr(begin, end - begin))) return false;
    }
    rest_.erase(0, begin);
    return true;
  }

 private:
  std::string rest_;
};

int print_recording(Context& context, client::Client& client, const RecordingCommand& command) {
  const bool is_raw = context.wants_json || command.output == "-";
  StandardOutput output(is_raw ? Content::Data : Content::Text);
  TrafficText text({command.is_hex, context.has_color()});
  Lines lines;
  const auto show = [&](std::string_view line) {
    const auto json = client::parse_json(line);
    const auto traffic = json ? client::from_json<client::Traffic>(*json)
                              : Result<client::Traffic>(fail(json.error()));
    const std::string shown = traffic ? text.add(*traffic) : printable(line) + "\n";
    return shown.empty() || output.write(shown).has_value();
  };
  auto got = client.recording(command.name, [&](std::string_view bytes) {
    return is_raw ? output.write(bytes).has_value() : lines.feed(bytes, show);
  });
  if (got && !output.error()) (void)output.write(text.flush());
  if (output.error()) return output.complain();
  return got ? kExitOk : complain(got.error());
}

int save_recording(client::Client& client, const RecordingCommand& command) {
  const int status = save_content(command.output, [&](const ContentSink& sink) {
    return client.recording(command.name, sink);
  });
  if (status == kExitOk) {
    print_error("Wrote the recording of {} to {}\n", command.name, command.output);
  }
  return status;
}

}  // namespace

int monitor_port(Context& context, client::Client& client, const MonitorCommand& command) {
  catch_interrupts();
  return PortMonitor(context, client, command).run();
}

int show_recording(Context& context, client::Client& client, const RecordingCommand& command) {
  if (!command.output.empty() && command.output != "-") return save_recording(client, command);
  return print_recording(context, client, command);
}

}  // namespace dripline::cli
