#include "clients/tools/post/post_processor.hpp"

#include <fmt/format.h>
#include <cmath>

#include "clients/tools/post/arc_fit.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::post {
namespace {

using interpreter::Axis;
using interpreter::Origin;
using interpreter::Position;
using interpreter::SpindleState;

constexpr std::size_t kPiece = 64 * 1024;
constexpr std::size_t kMaxPending = 64;

constexpr std::size_t index_of(Axis axis) {
  return static_cast<std::size_t>(axis);
}

bool is_same(const interpreter::Spindle& a, const interpreter::Spindle& b) {
  if (a.state != b.state) return false;
  if (a.state == SpindleState::Off) return true;
  return a.revolutions_per_minute == b.revolutions_per_minute &&
         a.surface_speed == b.surface_speed && a.max_revolutions == b.max_revolutions;
}

}  // namespace

PostProcessor::PostProcessor(Parts parts) : parts_(std::move(parts)), at_(parts_.start) {
  for (const Axis axis : interpreter::kAllAxes)
    counts_[index_of(axis)] = parts_.grid.counts(axis, at_.raw(axis));
  parts_.writer.head(text_, parts_.head);
}

WrittenCounts PostProcessor::counts() const {
  WrittenCounts counts = written_;
  counts.blocks = parts_.writer.blocks();
  return counts;
}

void PostProcessor::flush_if_large() {
  if (text_.size() < kPiece || error_) return;
  if (auto written = parts_.output(text_); !written) error_ = written.error();
  text_.clear();
}

Result<void> PostProcessor::finish() {
  if (error_) return fail(*error_);
  auto written = parts_.output(text_);
  text_.clear();
  return written;
}

void PostProcessor::check(const Origin& origin, const Result<void>& written) {
  if (!written && !refusal_) refusal_ = Refusal{written.error().what, origin};
  check_size(origin);
}

void PostProcessor::check_size(const Origin& origin) {
  const Target& target = parts_.grid.target();
  if (target.max_blocks == 0 || parts_.writer.blocks() <= target.max_blocks || refusal_) return;
  refusal_ = Refusal{
      fmt::format("more than {} blocks: {} numbers no more", target.max_blocks, target.name),
      origin};
}

/// False: nothing more is written.
bool PostProcessor::begin(const Origin& origin) {
  if (refusal_ || error_ || has_ended_) return false;
  write_pending();
  write_comments(origin);
  flush_if_large();
  check_size(origin);
  return !refusal_;
}

void PostProcessor::write_comment(std::string_view text) {
  if (!parts_.grid.target().has_comments) {
    ++written_.comments_left_out;
    return;
  }
  parts_.writer.comment(text_, text);
  ++written_.comments;
}

void PostProcessor::write_comments(const Origin& origin) {
  if (origin.program != interpreter::kMainProgram) return;
  new_comments_.clear();
  parts_.comments.take_up_to(origin.offset, new_comments_);
  for (const std::string& comment : new_comments_) write_comment(comment);
}

/// In the order in which they came.
void PostProcessor::write_pending() {
  for (const PendingState& state : pending_) {
    if (state.spindle) write_spindle(*state.spindle);
    if (state.coolant) write_coolant(*state.coolant);
  }
  pending_.clear();
}

/// An axis that has moved has a word where its count changes, and where it has had none before.
void PostProcessor::name_axes(const Origin& origin, const Position& to, MoveWords& move) {
  if (parts_.compensation != nullptr) move.compensation = parts_.compensation->at(origin.block);
  move.from = counts_;
  for (const Axis axis : interpreter::kAllAxes) {
    const std::size_t i = index_of(axis);
    move.at[i] = parts_.grid.counts(axis, to.raw(axis));
    if (to.has(axis) && (move.at[i] != counts_[i] || !known_.test(i))) {
      // One that the target does not have has not moved: the adaptation looks after that.
      if (parts_.grid.target().axes.find(letter(axis)) != std::string_view::npos) move.named.set(i);
    }
  }
}

/// False: more axes than one move of the target has.
bool PostProcessor::check_axes(const Origin& origin, const MoveWords& move) {
  const Target& target = parts_.grid.target();
  if (move.named.count() <= target.max_axes) return true;
  refusal_ = Refusal{fmt::format("move of {} axes: {} has up to {} in a block", move.named.count(),
                                 target.name, target.max_axes),
                     origin};
  return false;
}

/// False: per revolution of a spindle that has had no speed, at a target that refuses it.
bool PostProcessor::name_feed(const Origin& origin, Feed feed, MoveWords& move) {
  const Grid& grid = parts_.grid;
  FeedWord word;
  word.is_per_revolution = feed.per() == Feed::Per::Revolution;
  if (word.is_per_revolution && grid.target().needs_speed_per_revolution && !has_speed()) {
    refusal_ = Refusal{
        fmt::format("feed per revolution: {} needs a spindle speed for it", grid.target().name),
        origin};
    return false;
  }
  const auto& ranges =
      word.is_per_revolution ? grid.target().feed_per_revolution : grid.target().feed;
  word.counts = counts_of(feed.length().mm() / mm_per_unit(grid.units()),
                          range_of(ranges, grid.units()).decimals);
  if (feed_ != word) feed_ = move.feed = word;
  return true;
}

bool PostProcessor::has_speed() const {
  return spindle_ && (spindle_->surface_speed || spindle_->revolutions_per_minute != 0);
}

void PostProcessor::arrive(const Position& to, const MoveWords& move) {
  at_ = to;
  counts_ = move.at;
  known_ |= move.named;
  if (move.named.any()) ++written_.moves;
}

void PostProcessor::on_rapid(const interpreter::Rapid& event) {
  if (!begin(event.origin)) return;
  MoveWords move;
  name_axes(event.origin, event.to, move);
  if (!check_axes(event.origin, move)) return;
  if (move.named.any()) parts_.writer.rapid(text_, move);
  arrive(event.to, move);
}

void PostProcessor::on_line(const interpreter::Line& event) {
  if (!begin(event.origin)) return;
  MoveWords move;
  name_axes(event.origin, event.to, move);
  if (!check_axes(event.origin, move)) return;
  if (!name_feed(event.origin, event.feed, move)) return;
  if (move.named.any()) parts_.writer.line(text_, move);
  arrive(event.to, move);
}

void PostProcessor::on_arc(const interpreter::Arc& event) {
  if (!begin(event.origin)) return;
  const Grid& grid = parts_.grid;
  const auto axes = interpreter::axes_of(event.plane);
  const FittedArc fitted = fit_arc(grid, at_, event, parts_.tolerance);
  ArcWords arc;
  arc.is_helix = false;
  name_axes(event.origin, event.to, arc);
  for (const Axis axis : interpreter::kAllAxes) {
    const bool is_in_plane = axis == axes.first || axis == axes.second;
    const bool changes = arc.at[index_of(axis)] != counts_[index_of(axis)];
    if (is_in_plane) arc.named.set(index_of(axis));
    if (!is_in_plane && changes) arc.is_helix = true;
    // C has the axes of its plane alone.
    const bool is_plain = grid.target().form == Form::PlainLanguage;
    if (!is_in_plane && !changes && is_plain) arc.named.reset(index_of(axis));
  }
  if (!name_feed(event.origin, event.feed, arc)) return;
  arc.plane = event.plane;
  arc.turn = event.turn;
  arc.center = {fitted.first, fitted.second};
  arc.absolute_center = {counts_[index_of(axes.first)] + fitted.first,
                         counts_[index_of(axes.second)] + fitted.second};
  arc.sweep = fitted.sweep;
  const bool is_exact = parts_.writer.arc(text_, arc);
  arrive(event.to, arc);
  ++written_.arcs;
  if (is_exact) return;
  known_.reset(index_of(axes.first));
  known_.reset(index_of(axes.second));
}

void PostProcessor::on_thread(const interpreter::Thread& event) {
  if (!begin(event.origin)) return;
  const Grid& grid = parts_.grid;
  ThreadWords thread;
  name_axes(event.origin, event.to, thread);
  const Length lead = lead_word(grid, at_, event.to, event.lead);
  thread.lead = counts_of(lead.mm() / mm_per_unit(grid.units()),
                          range_of(grid.target().feed_per_revolution, grid.units()).decimals);
  if (event.start_angle) thread.start = counts_of(event.start_angle->degrees(), 3);
  if (thread.named.any()) parts_.writer.thread(text_, thread);
  feed_.reset();  // F of the thread may be the feed now
  arrive(event.to, thread);
}

void PostProcessor::on_dwell(const interpreter::Dwell& event) {
  if (!begin(event.origin)) return;
  parts_.writer.dwell(text_, counts_of(event.seconds, parts_.grid.target().dwell.decimals));
  if (parts_.writer.has_lost_feed()) feed_.reset();
  ++written_.actions;
}

void PostProcessor::on_spindle(const interpreter::Spindle& event) {
  if (refusal_ || has_ended_) return;
  if (pending_.size() >= kMaxPending) write_pending();
  pending_.push_back({event, {}});
}

void PostProcessor::on_coolant(const interpreter::Coolant& event) {
  if (refusal_ || has_ended_) return;
  if (pending_.size() >= kMaxPending) write_pending();
  pending_.push_back({{}, event});
}

/// A state that is in force already is not written again.
void PostProcessor::write_spindle(const interpreter::Spindle& spindle) {
  if (spindle_ && is_same(*spindle_, spindle)) return;
  check(spindle.origin, parts_.writer.spindle(text_, spindle));
  spindle_ = spindle;
  ++written_.actions;
}

void PostProcessor::write_coolant(const interpreter::Coolant& coolant) {
  if (coolant_ && coolant_->flood == coolant.flood && coolant_->mist == coolant.mist) return;
  check(coolant.origin, parts_.writer.coolant(text_, coolant.flood, coolant.mist));
  coolant_ = coolant;
  ++written_.actions;
}

void PostProcessor::on_tool(const interpreter::ToolChange& event) {
  if (!begin(event.origin)) return;
  parts_.writer.tool(text_, event);
  tools_.insert(event.number);
  known_.reset();  // a target may move to its tool change position
  ++written_.actions;
}

void PostProcessor::on_miscellaneous(const interpreter::Miscellaneous& event) {
  if (!begin(event.origin)) return;
  parts_.writer.machine_function(text_, event.code);
  ++written_.actions;
}

void PostProcessor::on_message(const interpreter::Message& event) {
  if (!begin(event.origin)) return;
  std::string text;
  for (const char c : event.text.substr(0, CarriedComments::kMaxLength))
    text += c < ' ' || c > '~' || c == '(' || c == ')' ? ' ' : c;
  write_comment(text);
}

void PostProcessor::on_stop(const interpreter::Stop& event) {
  if (!begin(event.origin)) return;
  parts_.writer.stop(text_, event.kind);
  ++written_.actions;
}

/// What the end's own block switches off, the target's end switches off as well.
void PostProcessor::on_end(const interpreter::End& event) {
  const auto is_of_end = [&](const Origin& origin) {
    return origin.line == event.origin.line && origin.program == event.origin.program;
  };
  while (!pending_.empty()) {
    const PendingState& last = pending_.back();
    if (!is_of_end(last.spindle ? last.spindle->origin : last.coolant->origin)) break;
    pending_.pop_back();
  }
  if (!begin(event.origin)) return;
  parts_.writer.end(text_);
  check_size(event.origin);
  has_ended_ = true;
}

}  // namespace dripline::post
