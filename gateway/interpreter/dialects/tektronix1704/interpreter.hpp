#pragma once

#include "gateway/interpreter/core/block_interpreter.hpp"
#include "gateway/interpreter/core/language/line_reader.hpp"
#include "gateway/interpreter/core/moved_axes.hpp"
#include "gateway/interpreter/dialects/tektronix1704/run.hpp"

namespace dripline::interpreter::tektronix1704 {

/// The Tektronix 1704 contouring control: a tape's characters to events, one block at a time.
class TektronixInterpreter final : public BlockInterpreter<TektronixInterpreter>, public MovedAxes {
 public:
  TektronixInterpreter(ControlOptions options, ProgramSource& source, EventSink& sink);

  Result<void> begin_next_text() override;
  void find_axes(const Position& at) override;
  ActiveModes modes() const override;
  std::uint32_t next_part() override;
  bool read_on() override;

 private:
  friend BlockInterpreter;

  BlockOutcome run_block();
  void drop_text() { reader_.drop_window(); }
  bool is_at_boundary() const { return true; }
  Result<void> take_answer(const Answer&) { return {}; }  // this control asks nothing
  void after_restore();
  void begin_tape();
  void read_from_place();

  BlockOutcome run_line();
  BlockOutcome run_mdi_block();
  BlockOutcome meet(LineState state);
  BlockOutcome hunt(const SourceLine& line);
  BlockOutcome search();
  BlockOutcome execute();
  BlockOutcome pass();
  BlockOutcome end_of_data(bool is_end_code);
  BlockOutcome end_of_text();
  void end_part(bool is_end_code);
  bool has_more();
  void begin_block(const TextPlace& place);
  void begin_part();
  BlockOutcome lose_block(const SourceLine& line);
  bool has_words_at_stop(std::string_view line) const;
  void warn_of_head(std::uint64_t line);
  void close_block();

  Run run_;
  LineReader reader_;
};

}  // namespace dripline::interpreter::tektronix1704

namespace dripline::interpreter {
extern template class BlockInterpreter<tektronix1704::TektronixInterpreter>;
}
