#pragma once

#include <bitset>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "clients/tools/post/grid.hpp"
#include "clients/tools/post/kept_compensation.hpp"
#include "gateway/interpreter/core/setup.hpp"

namespace dripline::post {

struct ProgramHead {
  std::int64_t number = 1;
  interpreter::Units units = interpreter::Units::Millimeter;
  std::map<int, double> radii = {};  ///< mm, of tools whose compensation is kept
};

/// A feed to be written, in counts of the target's decimals.
struct FeedWord {
  bool is_per_revolution = false;
  std::int64_t counts = 0;
  friend bool operator==(const FeedWord&, const FeedWord&) = default;
};

/// The words of a move. Absolute counts of the grid.
struct MoveWords {
  std::array<std::int64_t, interpreter::kAxisCount> from{}, at{};
  std::bitset<interpreter::kAxisCount> named;  ///< axes with a word
  std::optional<FeedWord> feed;                ///< absent: the one in force
  KeptCompensation::State compensation = {};   ///< the coordinates are those of the contour
};

struct ArcWords : MoveWords {
  interpreter::Plane plane = interpreter::Plane::XY;
  interpreter::Turn turn = interpreter::Turn::Clockwise;
  std::array<std::int64_t, 2> center{};           ///< increments from the start, along the plane
  std::array<std::int64_t, 2> absolute_center{};  ///< the same in counts of coordinates
  double sweep = 0;                               ///< degrees, of the arc as it is rounded
  bool is_helix = false;
};

struct ThreadWords : MoveWords {
  std::int64_t lead = 0;              ///< counts of the target's feed per revolution
  std::optional<std::int64_t> start;  ///< of the spindle, thousandths of a degree
};

/// The text of one target: one block or a few for each thing that a program does, appended to
/// `out`. A writer keeps what is modal at its control. Errors: Unsupported, with the reason.
class ProgramWriter {
 public:
  virtual ~ProgramWriter() = default;

  virtual void head(std::string& out, const ProgramHead& head) = 0;
  virtual void rapid(std::string& out, const MoveWords& move) = 0;
  virtual void line(std::string& out, const MoveWords& move) = 0;
  /// False: the end is not exactly that of the words, so the next move names both axes again.
  virtual bool arc(std::string& out, const ArcWords& arc) = 0;
  /// Only of targets that have threads.
  virtual void thread(std::string& /*out*/, const ThreadWords& /*thread*/) {}
  virtual void dwell(std::string& out, std::int64_t counts) = 0;
  virtual Result<void> spindle(std::string& out, const interpreter::Spindle& spindle) = 0;
  virtual Result<void> coolant(std::string& out, bool flood, bool mist) = 0;
  virtual void tool(std::string& out, const interpreter::ToolChange& tool) = 0;
  virtual void machine_function(std::string& out, int code) = 0;
  virtual void stop(std::string& out, interpreter::StopKind kind) = 0;
  /// Only of targets that have comments.
  virtual void comment(std::string& /*out*/, std::string_view /*text*/) {}
  virtual void end(std::string& out) = 0;
  /// The control does not keep the feed over the last block.
  virtual bool has_lost_feed() const { return false; }

  std::uint64_t blocks() const { return blocks_; }

 protected:
  void count_block() { ++blocks_; }

 private:
  std::uint64_t blocks_ = 0;
};

std::unique_ptr<ProgramWriter> make_word_writer(const Target& target);
std::unique_ptr<ProgramWriter> make_plain_language_writer(const Target& target,
                                                          const interpreter::Setup& setup);
std::unique_ptr<ProgramWriter> make_tape_writer(const Target& target);
std::unique_ptr<ProgramWriter> make_event_writer(const Target& target);
/// That of the target's form. `setup`: of the machine that the program is for.
std::unique_ptr<ProgramWriter> make_writer(const Target& target, const interpreter::Setup& setup);

}  // namespace dripline::post
