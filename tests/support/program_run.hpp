#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"
#include "tests/support/event_log.hpp"

namespace dripline::interpreter {

/// A program on a fresh control, with what it did as text.
template <const Dialect& kDialect>
class DialectRun {
 public:
  explicit DialectRun(std::string text, const Setup& setup = {})
      : text_(std::move(text)), source_(text_) {
    auto made = kDialect.make(setup, source_, log_);
    interpreter_ = std::move(*made);
  }
  StepState step(std::uint64_t blocks = 100'000) { return interpreter_->step(blocks); }
  Interpreter& interpreter() { return *interpreter_; }

  /// Events whose line begins with `kind`, without their origin.
  std::vector<std::string> events(std::string_view kind) const {
    std::vector<std::string> found;
    for (const std::string& line : log_.lines()) {
      if (!line.starts_with(kind)) continue;
      const auto origin = line.find(' ');
      const auto members = line.find(' ', origin + 1);
      found.push_back(members == std::string::npos ? "" : line.substr(members + 1));
    }
    return found;
  }
  /// The texts that the program put out.
  std::vector<std::string> printed() const {
    std::vector<std::string> texts = events("output");
    for (std::string& text : texts) text.erase(0, 2);
    return texts;
  }
  /// Id, line:column and text of the alarm; empty when there was none.
  std::string alarm() const {
    const auto alarms = events("alarm");
    return alarms.empty() ? "" : alarms.front();
  }

 private:
  std::string text_;
  MemorySource source_;
  EventLog log_;
  std::unique_ptr<Interpreter> interpreter_;
};

}  // namespace dripline::interpreter
