#pragma once

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/wire/discipline.hpp"

/// Two disciplines joined by a line in virtual time: as slow as the line, as fast as the machine
/// that runs the test. One thread.
namespace dripline::test_support {

/// What a bad line does to characters. Each character meets a fault with the probability `rate`;
/// which one is drawn from `kinds`.
struct LineFaults {
  enum class Kind : std::uint8_t {
    Drop,       ///< the character is lost
    Double,     ///< it comes twice
    Flip,       ///< one bit is wrong; a line with parity makes it a parity error
    Delay,      ///< it and all after it come later
    Break,      ///< a break comes in its place
    Parity,     ///< the UART reports a parity error in its place
    StuckXoff,  ///< a false DC3 comes before it; on RTS/CTS the line drops permanently
  };
  double rate = 0;
  std::vector<Kind> kinds = {Kind::Drop,  Kind::Double, Kind::Flip,     Kind::Delay,
                             Kind::Break, Kind::Parity, Kind::StuckXoff};
  wire::LineTime longest_delay = std::chrono::milliseconds(500);
};

/// A cheap seeded generator: a run needs one draw a character.
class FaultDice {
 public:
  explicit FaultDice(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15U + 1) {}
  std::uint64_t next();
  double fraction() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t limit) { return static_cast<std::size_t>(next() % limit); }

 private:
  std::uint64_t state_;
};

/// One end: the discipline and an owner that sends given programs and stores the received text.
struct LineEnd {
  std::unique_ptr<wire::Discipline> line;

  std::string to_send;      ///< what the owner offers while the line is sending
  std::size_t offered = 0;  ///< of to_send
  bool is_all_offered = false;
  std::size_t offer_at_most = 100;  ///< characters at once

  std::string received;                   ///< text since the last TransferBegan of a reception
  std::size_t receptions = 0, sends = 0;  ///< that ended well
  std::uint64_t accepted = 0;             ///< the last TextAccepted
  std::vector<Error> failures, faults;
  std::vector<wire::TransferRequest> requests;
  /// Called for each event after the owner's own work; may command the line.
  std::function<void(LineEnd&, const wire::Event&, wire::LineTime)> on_event;

  /// The owner has no room now and then: with this probability after a character received, for
  /// that long.
  double hold_rate = 0;
  wire::LineTime hold_time = std::chrono::milliseconds(50);

  /// begin_send with this text. Errors: those of begin_send.
  Result<void> send(std::string text, wire::LineTime now, std::string_view name = "");
};

class LineSimulator {
 public:
  struct Parts {
    wire::LineSettings settings;  ///< for the line's rate and its parity
    std::unique_ptr<wire::Discipline> host;
    std::unique_ptr<wire::Discipline> control;
    LineFaults faults = {};
    std::uint64_t seed = 1;
  };
  enum class Outcome : std::uint8_t {
    Idle,     ///< both ends are idle, no character is on the line
    Waiting,  ///< no character is on the line and no deadline is set, but an end is not idle
    Limit,    ///< the limit came first
    Busy,     ///< time does not advance: an end repeats a deadline that has passed
  };

  explicit LineSimulator(Parts parts);
  LineEnd& host() { return ends_[0]; }
  LineEnd& control() { return ends_[1]; }
  wire::LineTime now() const { return now_; }

  /// Until both ends are idle or nothing more can happen, at most up to the virtual time `limit`.
  Outcome run(wire::LineTime limit);
  /// Exactly up to `time`, whatever happens.
  void run_until(wire::LineTime time);
  /// An end was commanded from outside: moves on what it wants to say at once.
  void poke();

  struct Direction {
    std::uint64_t characters = 0;  ///< that left the driver
    std::uint64_t faults = 0;
    std::uint64_t reported = 0;  ///< of them reported by the UART
    std::uint64_t silent = 0;    ///< of them: characters lost, doubled or changed without a word
    /// Most characters, control characters not counted, that left the driver after the sending end
    /// was stopped; and those that were given to the driver then.
    std::uint64_t left_after_stop = 0, given_after_stop = 0;
    std::string seen;  ///< characters as they arrived; kept when keep_traffic(true)
  };
  const Direction& from_host() const { return wires_[0].counts; }
  const Direction& from_control() const { return wires_[1].counts; }
  void keep_traffic(bool is_kept) { keeps_traffic_ = is_kept; }

 private:
  struct Arrival {
    wire::LineTime time;
    std::byte character;
    std::optional<wire::LineFault> fault;
  };
  /// From end i to the other one.
  struct Wire {
    std::array<std::byte, 2> driver{};  ///< at most two characters are ever handed over
    std::size_t held = 0;
    wire::LineTime leaves_at{};  ///< the first of them
    wire::LineTime delayed_until{};
    std::deque<Arrival> arrivals;
    bool is_cts_stuck = false;
    std::uint64_t left_since_stop = 0, given_since_stop = 0;
    Direction counts;
  };

  std::optional<wire::LineTime> next_time() const;
  bool is_quiet() const;
  void step(wire::LineTime time);
  void leave(std::size_t from);
  /// What becomes of the character: how often it arrives, and as which fault.
  struct Fate {
    std::byte character;
    std::optional<wire::LineFault> fault;
    std::size_t copies = 1;
  };
  void meet_fault(Wire& wire, Fate& fate);
  void arrive(std::size_t from);
  void deliver(std::size_t to, const Arrival& arrival);
  std::byte stop_character() const;
  void note_stop(std::size_t end, std::byte character);
  void join_lines();
  void pump();
  void transmit(std::size_t from);
  void serve(std::size_t end);
  bool offer(LineEnd& end);  ///< whether anything was taken
  void handle(LineEnd& end, const wire::Event& event);
  void hold_now_and_then(std::size_t end);

  wire::LineSettings settings_;
  wire::LineTime character_time_;
  LineFaults faults_;
  FaultDice dice_;
  wire::LineTime now_{};
  std::array<LineEnd, 2> ends_;
  std::array<Wire, 2> wires_;
  std::array<wire::InputLines, 2> inputs_{};
  std::array<bool, 2> is_stopped_{};
  std::array<std::optional<wire::LineTime>, 2> held_until_{};
  bool keeps_traffic_ = false;
};

}  // namespace dripline::test_support
