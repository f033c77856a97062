#pragma once

#include <memory>
#include <string>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"
#include "tests/support/event_log.hpp"

namespace dripline::interpreter::rs274ngc {

/// A program on this control, with a setup file's text.
class ControlRun {
 public:
  explicit ControlRun(std::string text, std::string_view setup = "")
      : text_(std::move(text)), source_(text_) {
    const auto parsed = parse_setup(setup);
    auto made = (*find_dialect("rs274ngc"))->make(*parsed, source_, log_);
    interpreter_ = std::move(*made);
  }
  StepState step(std::uint64_t blocks = 1'000'000) { return interpreter_->step(blocks); }
  Interpreter& interpreter() { return *interpreter_; }
  const EventLog& log() const { return log_; }
  /// The last event, without the place it comes from.
  std::string last() const { return log_.lines().empty() ? "" : log_.lines().back(); }

 private:
  std::string text_;
  MemorySource source_;
  EventLog log_;
  std::unique_ptr<Interpreter> interpreter_;
};

}  // namespace dripline::interpreter::rs274ngc
