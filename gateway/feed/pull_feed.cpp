#include "gateway/feed/pull_feed.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace dripline::feed {
namespace {

constexpr std::uint64_t kChunk = ChunkCache::kChunkBytes;
/// A stitched window holds at least this much when the text is there, so that the lines around a
/// chunk's end are not stitched one by one.
constexpr std::size_t kStitchedBytes = 4096;

std::uint64_t chunk_begin(std::uint64_t offset) {
  return offset - offset % kChunk;
}

std::string_view as_text(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// In the order of BlockStatus.
constexpr std::array<std::string_view, 6> kMeanings{"ok",
                                                    "the server does not know this run",
                                                    "the server has no such program",
                                                    "the server's program is shorter",
                                                    "the stored program is corrupt",
                                                    "the server cannot read the program"};
std::string_view meaning_of(dds::BlockStatus status) {
  const auto at = static_cast<std::size_t>(status);
  return at < kMeanings.size() ? kMeanings[at] : "the server refuses";
}

interpreter::TextWindow ready(std::string_view text, bool reaches_end) {
  return {interpreter::TextWindow::State::Ready, text, reaches_end, {}};
}

}  // namespace

PullFeed::PullFeed(FeedRun run, PullFeedOptions options, Ask ask)
    : run_(std::move(run)),
      options_(options),
      ask_(std::move(ask)),
      cache_(options.cache_bytes),
      window_(options.max_window) {
  Program& main = programs_.emplace_back();
  main.size = run_.size;
}

interpreter::TextWindow PullFeed::fetch(interpreter::ProgramIndex program, std::uint64_t offset,
                                        std::size_t min_bytes) {
  if (!failure_.empty()) return {interpreter::TextWindow::State::Failed, {}, false, failure_};
  if (program != cursor_program_ || offset < cursor_) programs_[program].received_to = 0;
  cursor_program_ = program;
  cursor_ = offset;
  const std::uint64_t size = programs_[program].size.value_or(0);
  if (offset >= size) return ready({}, true);

  const std::size_t need = static_cast<std::size_t>(
      std::min<std::uint64_t>(std::max<std::size_t>(min_bytes, 1), size - offset));
  const std::string_view text = cache_.view(program, offset);
  if (text.size() >= need) return ready(text, offset + text.size() == size);
  return stitch(program, offset, need);
}

interpreter::TextWindow PullFeed::stitch(interpreter::ProgramIndex program, std::uint64_t offset,
                                         std::size_t need) {
  const std::uint64_t size = *programs_[program].size;
  const std::size_t wanted = std::max(need, kStitchedBytes);
  stitched_.clear();
  while (stitched_.size() < wanted) {
    const std::string_view text = cache_.view(program, offset + stitched_.size());
    if (text.empty()) break;
    stitched_.append(text.substr(0, wanted - stitched_.size()));
  }
  if (stitched_.size() < need) return {};
  return ready(stitched_, offset + stitched_.size() == size);
}

interpreter::ProgramLookup PullFeed::find(std::string_view name) {
  using State = interpreter::ProgramLookup::State;
  const auto found = std::find_if(programs_.begin() + 1, programs_.end(),
                                  [&](const Program& known) { return known.name == name; });
  const auto index = static_cast<interpreter::ProgramIndex>(found - programs_.begin());
  if (found != programs_.end()) {
    if (found->is_missing) return {State::NotFound, 0};
    return {found->size ? State::Found : State::NotYet, index};
  }
  if (name.empty() || programs_.size() > options_.max_called_programs) return {State::NotFound, 0};
  programs_.emplace_back().name = name;
  return {State::NotYet, index};
}

std::vector<CalledProgram> PullFeed::called_programs() const {
  std::vector<CalledProgram> called;
  for (std::size_t i = 1; i < programs_.size(); ++i)
    called.push_back({programs_[i].name, programs_[i].content, programs_[i].is_missing});
  return called;
}

void PullFeed::on_data(const dds::BlockData& data, SteadyTime now) {
  if (data.session != run_.session || data.run != run_.run || data.machine != run_.machine) return;
  const auto index = program_of(data);
  if (!index) return;
  Program& program = programs_[*index];
  if (data.status != dds::BlockStatus::Ok) return on_error(program, data);
  if (!is_consistent(program, data)) return;

  program.size = data.total_bytes;
  program.failures = 0;
  program.received_to = std::max(program.received_to, data.offset + data.bytes.size());
  last_data_ = now;
  cache_.store(*index, data.offset, as_text(data.bytes));
  drop_asked(*index, data.offset, data.offset + data.bytes.size());
  if (*index == interpreter::kMainProgram) extend_hash();
}

std::optional<interpreter::ProgramIndex> PullFeed::program_of(const dds::BlockData& data) const {
  for (std::size_t i = 0; i < programs_.size(); ++i) {
    if (programs_[i].name == data.program) return static_cast<interpreter::ProgramIndex>(i);
  }
  return std::nullopt;
}

bool PullFeed::is_consistent(Program& program, const dds::BlockData& data) {
  if (program.size && *program.size != data.total_bytes) {
    failure_ = fmt::format("the server reports that program \"{}\" has {} bytes, it began with {}",
                           program.name, data.total_bytes, *program.size);
    return false;
  }
  if (program.content.empty()) program.content = data.content;
  if (!data.content.empty() && program.content != data.content) {
    failure_ = fmt::format("the server has another content for program \"{}\" than it began with",
                           program.name);
    return false;
  }
  return data.offset <= data.total_bytes && data.bytes.size() <= data.total_bytes - data.offset;
}

void PullFeed::on_error(Program& program, const dds::BlockData& data) {
  const bool is_called = !program.name.empty();
  if (is_called && data.status == dds::BlockStatus::NoSuchProgram) {
    program.is_missing = !program.size;
    return;
  }
  // "Failed" is a fault of the server and may pass: the deadline asks again.
  if (data.status == dds::BlockStatus::Failed && ++program.failures < options_.max_failures) return;
  failure_ = fmt::format("program text at byte {}: {}{}{}", data.offset, meaning_of(data.status),
                         data.reason.empty() ? "" : ": ", data.reason);
}

void PullFeed::drop_asked(interpreter::ProgramIndex program, std::uint64_t from, std::uint64_t to) {
  const std::uint64_t size = *programs_[program].size;
  for (std::uint64_t index = from / kChunk; index * kChunk < to; ++index) {
    const std::uint64_t full = std::min(kChunk, size - index * kChunk);
    if (cache_.filled({program, index}) >= full) asked_.erase({program, index});
  }
}

void PullFeed::extend_hash() {
  for (;;) {
    const std::string_view text = cache_.peek(interpreter::kMainProgram, hashed_);
    if (text.empty()) return;
    hash_.update(text);
    hashed_ += text.size();
  }
}

void PullFeed::poll(SteadyTime now) {
  next_poll_.reset();
  if (!failure_.empty()) return;
  for (std::size_t i = 1; i < programs_.size(); ++i) {
    const auto index = static_cast<interpreter::ProgramIndex>(i);
    if (programs_[i].size || programs_[i].is_missing || !is_due({index, 0}, now)) continue;
    send(index, {0, kChunk}, now);
  }
  if (programs_[cursor_program_].size) ask_window(cursor_program_, now);
}

PullFeed::Range PullFeed::window_of(const Program& program) const {
  return {chunk_begin(cursor_), std::min(cursor_ + window_, *program.size)};
}

void PullFeed::ask_window(interpreter::ProgramIndex index, SteadyTime now) {
  const std::uint64_t size = *programs_[index].size;
  const Range window = window_of(programs_[index]);
  const std::uint64_t urgent = cursor_ + window_ / 2;
  std::size_t allowed = options_.max_in_flight;
  allowed -= std::min(allowed, in_flight(index, window, now));
  std::optional<Range> open;
  const auto close = [&](bool is_cut) {
    const bool is_worth = open && (is_cut || open->begin < urgent || open->end == size);
    const bool is_taken = !is_worth || send(index, *open, now);
    if (is_worth && open) allowed -= std::min<std::size_t>(allowed, open->end - open->begin);
    open.reset();
    return is_taken;
  };
  for (std::uint64_t begin = window.begin; begin < window.end; begin += kChunk) {
    const std::uint64_t end = std::min(begin + kChunk, size);
    const std::uint64_t held = begin + cache_.filled({index, begin / kChunk});
    const bool is_wanted = held < end && is_due({index, begin / kChunk}, now);
    if (open && (!is_wanted || held != open->end) && !close(false)) return;
    if (!is_wanted) continue;
    if (allowed < kChunk + (open ? open->end - open->begin : 0)) break;
    if (!open) open = Range{held, held};
    open->end = end;
    if (open->end - open->begin + kChunk > options_.request_bytes && !close(true)) return;
  }
  close(false);
}

std::size_t PullFeed::in_flight(interpreter::ProgramIndex index, Range window, SteadyTime now) {
  std::size_t bytes = 0;
  const auto end = asked_.lower_bound({index, (window.end + kChunk - 1) / kChunk});
  for (auto it = asked_.lower_bound({index, window.begin / kChunk}); it != end; ++it) {
    if (!is_due(it->first, now)) bytes += kChunk;
  }
  return bytes;
}

bool PullFeed::is_due(ChunkCache::Key key, SteadyTime now) {
  const auto asked = asked_.find(key);
  if (asked == asked_.end()) return true;
  // While answers arrive, later pieces are not overdue; a piece that was overtaken is.
  const bool is_overtaken = programs_[key.program].received_to > (key.index + 1) * kChunk;
  const SteadyTime quiet = last_data_ + options_.retry;
  const SteadyTime deadline =
      is_overtaken ? asked->second.deadline : std::max(asked->second.deadline, quiet);
  if (now >= deadline) return true;
  note_deadline(deadline);
  return false;
}

bool PullFeed::send(interpreter::ProgramIndex index, Range range, SteadyTime now) {
  dds::BlockRequest request{run_.machine, run_.session,
                            run_.run,     programs_[index].name,
                            range.begin,  static_cast<std::uint32_t>(range.end - range.begin)};
  if (!ask_(request)) {
    note_deadline(now + std::chrono::milliseconds(5));
    return false;
  }
  for (std::uint64_t at = range.begin / kChunk; at * kChunk < range.end; ++at) {
    Asked& asked = asked_[{index, at}];
    const auto wait = options_.retry * (1 << std::min(asked.attempts, 6));
    asked.deadline = now + std::min<std::chrono::milliseconds>(wait, options_.max_retry);
    ++asked.attempts;
    note_deadline(asked.deadline);
  }
  return true;
}

void PullFeed::note_deadline(SteadyTime deadline) {
  next_poll_ = next_poll_ ? std::min(*next_poll_, deadline) : deadline;
}

void PullFeed::ask_again() {
  asked_.clear();
  for (Program& program : programs_) program.failures = 0;
}

void PullFeed::set_consumption(std::optional<double> bytes_per_second) {
  if (!bytes_per_second) {
    window_ = options_.max_window;
    return;
  }
  const double wanted = *bytes_per_second * options_.target_seconds;
  window_ = static_cast<std::size_t>(std::clamp(wanted, static_cast<double>(options_.min_window),
                                                static_cast<double>(options_.max_window)));
}

std::uint64_t PullFeed::bytes_ahead() const {
  std::uint64_t ahead = 0;
  while (ahead < options_.max_window) {
    const std::string_view text = cache_.peek(cursor_program_, cursor_ + ahead);
    if (text.empty()) break;
    ahead += text.size();
  }
  return ahead;
}

}  // namespace dripline::feed
