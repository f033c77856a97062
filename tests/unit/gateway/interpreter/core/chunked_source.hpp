#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "gateway/interpreter/core/program_source.hpp"

namespace dripline::interpreter {

/// A source as mean as its contract allows: windows are no longer than asked for in steps of
/// `chunk`, live in memory that is freed at the next call, and each text is NotYet `delays` times.
class ChunkedSource final : public ProgramSource {
 public:
  ChunkedSource(std::string text, std::size_t chunk, int delays = 0)
      : text_(std::move(text)), chunk_(chunk), delays_(delays), left_(delays) {}

  TextWindow fetch(ProgramIndex, std::uint64_t offset, std::size_t min_bytes) override {
    ++fetches;
    TextWindow window;
    window_.reset();
    if (left_-- > 0) return window;
    left_ = delays_;
    window.state = TextWindow::State::Ready;
    const std::size_t from = std::min<std::size_t>(offset, text_.size());
    const std::size_t wanted = (min_bytes + chunk_ - 1) / chunk_ * chunk_;
    const std::size_t size = std::min(wanted, text_.size() - from);
    window_ = std::make_unique<std::vector<char>>(text_.begin() + static_cast<long>(from),
                                                  text_.begin() + static_cast<long>(from + size));
    window.text = {window_->data(), window_->size()};
    window.reaches_end = from + size == text_.size();
    return window;
  }
  ProgramLookup find(std::string_view) override { return {ProgramLookup::State::NotFound, 0}; }

  int fetches = 0;

 private:
  std::string text_;
  std::size_t chunk_;
  int delays_;
  int left_;
  std::unique_ptr<std::vector<char>> window_;
};

}  // namespace dripline::interpreter
