#pragma once

#include <string>
#include <vector>

namespace dripline::interpreter {

/// What a program of this control did, one short text an event:
///   `R X40 Y5`               rapid, every axis that has moved
///   `L X40 Y5 F100`          straight at a feed
///   `A X40 Y5 c40,0 ccw90 F100`  arc: end, center, direction and sweep
///   `S cw 1000`, `coolant on`, `T5`, `next T5`, `M7`, `stop`, `dwell 2`, `! TEXT` of an alarm,
///   `out TEXT`, `warning ID`, `end 12` with the blocks, `end 12 rewind`
/// Numbers are rounded to three decimals.
struct PathRun {
  std::vector<std::string> events;
  std::string alarm_id;
  std::uint64_t alarm_line = 0;
};

/// Runs `blocks` (block numbers are put in front) within BEGIN PGM 1 and END PGM 1. `setup` is a
/// setup file; unless it says `program_start`, the first block may be incremental. Programs that
/// are called: texts by name ("7").
struct PathSetup {
  std::string setup;
  std::vector<std::pair<std::string, std::string>> programs;
  std::string units = "MM";
};
PathRun run_blocks(const std::vector<std::string>& blocks, const PathSetup& setup = {});
/// Runs a text as it is.
PathRun run_text(const std::string& text, const PathSetup& setup = {});

/// The moves only, and an alarm in the control's words, without our detail: what most tests look
/// at.
std::vector<std::string> moves_of(const std::vector<std::string>& blocks,
                                  const PathSetup& setup = {});

}  // namespace dripline::interpreter
