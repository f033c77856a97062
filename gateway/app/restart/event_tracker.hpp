#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "gateway/app/restart/delivered_state.hpp"
#include "gateway/interpreter/stages/event_filter.hpp"

namespace dripline::gateway {

/// Between the interpreter and the machine: keeps what the machine was given, with the hash of the
/// path for each block, and holds back everything up to a block while a restart looks through the
/// program. One thread.
class EventTracker final : public interpreter::EventGate {
 public:
  explicit EventTracker(interpreter::EventSink& out)
      : EventGate(out), paths_(std::make_unique<Paths>()) {}

  /// The axes are at `at` + `lengths`, and nothing was given yet.
  void begin(const interpreter::Position& at, const machine::ToolLengths& lengths) {
    state_.heights.begin(at, lengths);
  }
  /// Of a machine that adds the lengths of tools: asked for with every move.
  void use_lengths(std::function<ReachedHeights::Lengths()> lengths) {
    lengths_ = std::move(lengths);
  }

  /// Of a control without a word for rapid traverse: from which feed on, per minute, a straight
  /// move is one.
  void use_rapid_feed(const std::optional<Length>& feed) { rapid_feed_ = feed; }

  const DeliveredState& delivered() const { return state_; }
  /// The hash of the path when `block` ended; 0: not known any more.
  std::uint64_t path_at(std::uint64_t block) const {
    const PathOfBlock& one = (*paths_)[block % kPaths];
    return one.block == block ? one.path : 0;
  }

  /// Length of the path that the machine was given up to the end of `block`, in millimeters;
  /// nothing: not known any more.
  std::optional<double> length_at(std::uint64_t block) const {
    const PathOfBlock& one = (*paths_)[block % kPaths];
    return one.block == block ? std::optional(one.length) : std::nullopt;
  }

  /// What the interpreter has given, in skipped blocks too. A move may be given long after its
  /// block: compensation waits for the next ones.
  struct Moves {
    struct Blocks {
      std::uint64_t first = 0, last = 0;  ///< 0: none
    };
    std::array<Blocks, 3> axes{};  ///< of the moves of X, Y and Z
    bool has_tool = false;         ///< a tool was changed
  };
  /// Since the last call.
  Moves take_moves() { return std::exchange(moves_, {}); }

  /// From `state` on, nothing passes until the block `last` has ended; then `on_open` is called,
  /// with the sink that follows. Without `on_open` nothing passes at all.
  using OnOpen = std::function<void(interpreter::EventSink& out)>;
  void close(DeliveredState state, std::uint64_t last, OnOpen on_open);
  /// At once: nothing was executed before.
  void open_now();
  /// Until it is closed again, what comes goes to `also` too, a sink that must outlive that; the
  /// gate keeps nothing from it.
  void show(interpreter::EventSink& also) { also_ = &also; }
  /// The program relies on that axis being there, though it has not moved it.
  void expect(interpreter::Axis axis, double value);
  bool is_closed() const { return is_closed_; }

  /// What is searched for while the gate is closed: the last block up to `until` that ends with
  /// this line or N number of the main program, or that changes to this tool.
  struct Wanted {
    std::optional<std::uint64_t> line;
    std::optional<std::int64_t> sequence;
    std::optional<int> tool;
    std::uint64_t until = 0;
  };
  void search(const Wanted& wanted) { wanted_ = wanted, found_ = 0; }
  /// 0: none.
  std::uint64_t found() const { return found_; }

  /// The program's end came while the gate was closed: the last block has executed it before its
  /// own end. It passes when the gate opens.
  bool has_ended() const { return end_.has_value(); }
  /// An alarm that came while the gate was closed.
  const std::optional<interpreter::Diagnostic>& alarm() const { return alarm_; }

  /// Of one block, after the gate has opened: its moves' length along the path, and how much of it
  /// is left from `at`; no `left` when `at` is not on it.
  void measure(std::uint64_t block, const interpreter::Position& at);
  struct Measured {
    std::uint64_t block = 0, line = 0;
    std::int64_t sequence = interpreter::Origin::kNone;
    double length = 0;  ///< millimeters
    std::optional<double> left;
    bool has_ended = false;
  };
  const Measured& measured() const { return measured_; }

  void on_rapid(const interpreter::Rapid& event) override;
  void on_line(const interpreter::Line& event) override;
  void on_arc(const interpreter::Arc& event) override;
  void on_thread(const interpreter::Thread& event) override;
  void on_probe(const interpreter::Probe& event) override;
  void on_dwell(const interpreter::Dwell& event) override;
  void on_spindle(const interpreter::Spindle& event) override;
  void on_coolant(const interpreter::Coolant& event) override;
  void on_tool(const interpreter::ToolChange& event) override;
  void on_miscellaneous(const interpreter::Miscellaneous& event) override;
  void on_pin(const interpreter::PinChange& event) override;
  void on_override_inhibit(const interpreter::OverrideInhibit& event) override;
  void on_stop(const interpreter::Stop& event) override;
  void on_alarm(const interpreter::Alarm& event) override;
  void on_end(const interpreter::End& event) override;
  void on_block_end(const interpreter::Origin& origin) override;

 private:
  bool is_open() const override { return !is_closed_; }
  void add(double value);
  void add(std::uint64_t bits);
  struct Shape {
    std::optional<interpreter::PathArc> arc = {};
    ReachedHeights::Kind kind = ReachedHeights::Kind::Feed;
  };
  void move_to(const interpreter::Origin& origin, const interpreter::Position& to,
               const Shape& shape);
  void measure_move(const interpreter::Origin& origin, const interpreter::Position& to,
                    double length);
  ReachedHeights::Kind kind_of(const Feed& feed) const;
  void note_code(int code);
  void note_found(const interpreter::Origin& origin);

  /// As many blocks as a machine queues at most, and more.
  static constexpr std::size_t kPaths = 32'768;
  struct PathOfBlock {
    std::uint64_t block = 0, path = 0;
    double length = 0;
  };
  using Paths = std::array<PathOfBlock, kPaths>;

  DeliveredState state_;
  std::function<ReachedHeights::Lengths()> lengths_;
  std::optional<Length> rapid_feed_;
  std::unique_ptr<Paths> paths_;
  double length_ = 0;
  Moves moves_;
  bool is_closed_ = false;
  interpreter::EventSink* also_ = nullptr;
  std::uint64_t last_ = 0;
  OnOpen on_open_;
  std::optional<Wanted> wanted_;
  std::uint64_t found_ = 0;
  std::optional<interpreter::Diagnostic> alarm_;
  std::optional<interpreter::End> end_;
  std::uint64_t measured_block_ = 0;  ///< 0: none
  interpreter::Position measured_from_;
  Measured measured_;
};

}  // namespace dripline::gateway
