#include "clients/tools/offline/forecast.hpp"

#include <algorithm>

namespace dripline::interpreter {
namespace {

constexpr double kNoWait = 1e-9;

bool waits_longer(const StarvedBlock& a, const StarvedBlock& b) {
  return a.wait_seconds > b.wait_seconds;
}

}  // namespace

Forecast::Forecast(const FeedLine& line, std::uint64_t text_size, const Position& start,
                   CheckRates rates, const MachineData& machine)
    : line_(line), text_size_(text_size), times_(start, rates, machine) {
  times_.time_blocks(
      [this](std::uint64_t block, double seconds) { block_at(block).seconds += seconds; });
}

Forecast::Block& Forecast::block_at(std::uint64_t number) {
  while (open_.size() <= number - first_) open_.emplace_back();
  return open_[number - first_];
}

/// The text of a block reaches to that of its successor.
void Forecast::count_characters(Block& block, std::uint64_t next) {
  const bool is_new = block.origin.program == kMainProgram && next > furthest_;
  block.characters = is_new ? next - std::max(furthest_, block.origin.offset) : 0;
  furthest_ = std::max(furthest_, next);
}

void Forecast::on_block_end(const Origin& origin) {
  times_.on_block_end(origin);
  Block& block = block_at(ended_);
  block.origin = origin;
  block.fed = times_.summary().feed_length - fed_before_;
  fed_before_ = times_.summary().feed_length;
  if (ended_ > first_) {
    Block& before = block_at(ended_ - 1);
    const bool is_further = origin.program == kMainProgram && origin.offset > before.origin.offset;
    count_characters(before, is_further ? origin.offset : before.origin.offset);
  }
  ++ended_;
  if (open_.size() > kMaxOpen) times_.rest();
  take_timed(std::min(times_.first_open(), ended_ - 1));
}

void Forecast::take_timed(std::uint64_t until) {
  for (; first_ < until; ++first_) {
    take(open_.front());
    open_.pop_front();
  }
}

void Forecast::on_end(const End& event) {
  times_.on_end(event);
}

const ForecastResult& Forecast::finish() {
  times_.rest();
  if (first_ < ended_) {
    Block& last = block_at(ended_ - 1);
    const bool is_main = last.origin.program == kMainProgram;
    count_characters(last, is_main ? text_size_ : last.origin.offset);
    take_timed(ended_);
  }
  std::sort(result_.worst.begin(), result_.worst.end(), waits_longer);
  return result_;
}

/// When the line has brought so many more characters: it continues while there is room for them.
Forecast::Arrival Forecast::arrival(std::uint64_t characters) {
  double begins = received_;
  const auto has_room = [&] {
    return held_.empty() || held_characters_ + characters <= line_.buffer;
  };
  while (!has_room()) {
    begins = std::max(begins, held_.front().leaves);
    held_characters_ -= held_.front().characters;
    held_.pop_front();
  }
  const bool stood = begins > received_ || received_ == 0;
  const double start = line_.buffer == 0 || stood ? line_.start_seconds : 0;
  // The first character is under the reader when it starts.
  const double count = static_cast<double>(characters) - (line_.start_seconds > 0 ? 1 : 0);
  const double reading = start + std::max(0.0, count) / line_.characters_per_second;
  return {begins + reading, reading};
}

void Forecast::take(const Block& block) {
  const std::uint64_t characters = block.characters;
  ++result_.blocks;
  result_.move_seconds += block.seconds;
  double begins = finish_;
  if (characters > 0) {
    const auto [there, reading] = arrival(characters);
    received_ = there;
    if (has_previous_ && there > finish_ + kNoWait)
      note(previous_, characters, there - finish_, reading);
    begins = std::max(finish_, there);
    held_.push_back({begins, characters});
    held_characters_ += characters;
  }
  finish_ = begins + block.seconds;
  previous_ = block;
  has_previous_ = true;
}

/// Waiting after a block that does not feed (a tool change, the end of a rapid) is no harm to the
/// part, but it is time all the same; only feeding blocks are listed.
void Forecast::note(const Block& before, std::uint64_t characters, double wait, double reading) {
  result_.wait_seconds += wait;
  if (before.fed <= Length{}) return;
  ++result_.starved;
  StarvedBlock starved;
  starved.program = before.origin.program;
  starved.line = before.origin.line;
  starved.sequence = before.origin.sequence;
  starved.characters = characters;
  starved.wait_seconds = wait;
  starved.moved = before.fed;
  starved.move_seconds = before.seconds;
  starved.feed_that_would_do =
      before.fed * (kSecondsPerMinute / std::max(reading, before.seconds + wait));
  auto& worst = result_.worst;
  if (worst.size() < ForecastResult::kMaxWorst) {
    worst.push_back(starved);
    std::push_heap(worst.begin(), worst.end(), waits_longer);
  } else if (waits_longer(starved, worst.front())) {
    std::pop_heap(worst.begin(), worst.end(), waits_longer);
    worst.back() = starved;
    std::push_heap(worst.begin(), worst.end(), waits_longer);
  }
}

}  // namespace dripline::interpreter
