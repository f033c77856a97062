#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "clients/tools/offline/check_summary.hpp"

namespace dripline::interpreter {

/// The source of blocks while the control moves: a tape reader, a serial line.
struct FeedLine {
  double characters_per_second = 300;
  /// Before each block that is asked for by itself: a reader's start.
  double start_seconds = 0;
  /// Characters the control can hold ahead of the block it executes. 0: one block, whatever its
  /// length, as a control that buffers the next block.
  std::uint64_t buffer = 0;
};

/// A block whose successor comes too late: the axes stop and wait.
struct StarvedBlock {
  ProgramIndex program = kMainProgram;  ///< of the block that is over too soon
  std::uint64_t line = 0;               ///< there
  std::int64_t sequence = -1;           ///< its N number
  std::uint64_t characters = 0;         ///< of the block that is waited for
  double wait_seconds = 0;
  Length moved;  ///< by the block
  double move_seconds = 0;
  /// Per minute: at which the block lasts until its successor is there. Zero when it does not feed.
  Length feed_that_would_do;
};

struct ForecastResult {
  std::uint64_t blocks = 0, starved = 0;
  double move_seconds = 0;          ///< without waiting
  double wait_seconds = 0;          ///< after the first block has come
  std::vector<StarvedBlock> worst;  ///< longest waits first, at most kMaxWorst
  static constexpr std::size_t kMaxWorst = 1000;
};

/// Compares how long each block moves with how long the line needs for what comes after it: which
/// blocks starve, and the feed at which they would not (Tektronix 1704, "reader limitation"; the
/// same sum for every line and buffer). Times are CheckSummary's: with acceleration where the setup
/// states it, though the axes that wait for a block brake and speed up again in no time. A block
/// that is executed again has been read already. One thread; memory bounded by `FeedLine::buffer`
/// and kMaxOpen.
class Forecast final : public EventSink {
 public:
  /// `text_size`: bytes of the program.
  Forecast(const FeedLine& line, std::uint64_t text_size, const Position& start = {},
           CheckRates rates = {}, const MachineData& machine = {});

  /// After the last event.
  const ForecastResult& finish();
  const Summary& summary() const { return times_.summary(); }

  void on_program(const ProgramHeader& event) override { times_.on_program(event); }
  void on_rapid(const Rapid& event) override { times_.on_rapid(event); }
  void on_line(const Line& event) override { times_.on_line(event); }
  void on_arc(const Arc& event) override { times_.on_arc(event); }
  void on_thread(const Thread& event) override { times_.on_thread(event); }
  void on_dwell(const Dwell& event) override { times_.on_dwell(event); }
  void on_spindle(const Spindle& event) override { times_.on_spindle(event); }
  void on_tool(const ToolChange& event) override { times_.on_tool(event); }
  void on_miscellaneous(const Miscellaneous& event) override { times_.on_miscellaneous(event); }
  void on_stop(const Stop& event) override { times_.on_stop(event); }
  void on_probe(const Probe& event) override { times_.on_probe(event); }
  void on_warning(const Warning& event) override { times_.on_warning(event); }
  void on_alarm(const Alarm& event) override { times_.on_alarm(event); }
  void on_end(const End& event) override;
  void on_block_end(const Origin& origin) override;

 private:
  struct Block {
    Origin origin;
    double seconds = 0;
    Length fed;
    std::uint64_t characters = 0;
  };
  /// Blocks whose times the clock may still look ahead for; more of them count as a rest.
  static constexpr std::size_t kMaxOpen = 8192;

  Block& block_at(std::uint64_t number);
  void count_characters(Block& block, std::uint64_t next);
  void take_timed(std::uint64_t until);
  void take(const Block& block);
  struct Arrival {
    double there = 0;
    double reading = 0;  ///< for how long the line was busy with it
  };
  Arrival arrival(std::uint64_t characters);
  void note(const Block& before, std::uint64_t characters, double wait, double reading);

  FeedLine line_;
  std::uint64_t text_size_;
  CheckSummary times_;
  ForecastResult result_;
  Length fed_before_;
  std::deque<Block> open_;   ///< executed and not taken: time or length are not known yet
  std::uint64_t first_ = 0;  ///< number of the first of them
  std::uint64_t ended_ = 0;  ///< blocks so far
  bool has_previous_ = false;
  Block previous_;              ///< the block taken last
  double finish_ = 0;           ///< when `previous_` has been executed
  double received_ = 0;         ///< when the line has brought what was taken last
  std::uint64_t furthest_ = 0;  ///< offset up to which the text has been read
  struct Held {
    double leaves = 0;  ///< when its execution begins and its room is free
    std::uint64_t characters = 0;
  };
  std::deque<Held> held_;
  std::uint64_t held_characters_ = 0;
};

}  // namespace dripline::interpreter
