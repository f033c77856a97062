#include <algorithm>
#include <cmath>

#include "gateway/machine/grbl/grbl_machine.hpp"

/// The part of the machine that sends motion ahead.
namespace dripline::machine::grbl {

/// Sends the motion that may be sent, up to the first action that must wait for it.
void GrblMachine::pump() {
  if (!is_released_ || !may_begin() || !prepare()) return;
  for (; next_ < queue_.size(); ++next_) {
    Action& action = queue_[next_];
    if (is_single_block_ && action.origin.block != queue_.front().origin.block) return;
    if (std::holds_alternative<BlockEnd>(action.body)) continue;
    auto* motion = std::get_if<Motion>(&action.body);
    if (motion == nullptr) return;
    for (; motion->sent < motion->lines.size(); ++motion->sent) {
      const std::string& line = motion->lines[motion->sent];
      if (!session_.may_send(line.size() + LineWriter::kAdded)) return;
      const bool moves = !line.starts_with("G4");
      motion->last_serial = session_.send(line, moves);
    }
    expected_ = motion->end;
  }
}

/// The modes that all lines rely on are set and read back before the first line of a program.
bool GrblMachine::prepare() {
  const LineWriter& writer = builder_.writer();
  const bool is_current = preamble_resets_ == session_.resets();
  if (preamble_ == Preamble::Done && is_current) return true;
  if (preamble_ == Preamble::None || !is_current) {
    if (!session_.is_empty() || !session_.may_send(80) || !check_position(expected_)) return false;
    for (const std::string& line : writer.preamble()) session_.send(line, false);
    session_.drop_modes();
    preamble_ = Preamble::Sent;
    preamble_resets_ = session_.resets();
    return false;
  }
  if (!session_.is_empty() || !session_.may_send(8)) return false;
  if (preamble_ == Preamble::Sent) {
    session_.send_system("$G");
    preamble_ = Preamble::Asked;
    return false;
  }
  const auto& modes = session_.modes();
  for (const std::string& word : writer.preamble_words()) {
    if (modes && std::ranges::find(modes->words, word) != modes->words.end()) continue;
    session_.raise("GRB0007", fmt::format("the board does not take the mode {}", word),
                   clock_->steady_now());
    return false;
  }
  preamble_ = Preamble::Done;
  return true;
}

/// With nothing in motion the axes must be where the program has sent them.
bool GrblMachine::check_position(const Coordinates& expected) {
  const BoardInfo& board = session_.board();
  const auto& report = session_.report();
  if (!report || report->state != BoardState::Idle) return false;
  for (std::size_t i = 0; i < board.axes(); ++i) {
    if (std::fabs(session_.position()[i] - expected[i]) <= board.tolerance(i)) continue;
    session_.raise(
        "GRB0003",
        fmt::format("{} is at {:.3f}, the program has it at {:.3f}: the board does not do "
                    "what it was sent",
                    letter_of(i), session_.position()[i], expected[i]),
        clock_->steady_now());
    return false;
  }
  return true;
}

}  // namespace dripline::machine::grbl
