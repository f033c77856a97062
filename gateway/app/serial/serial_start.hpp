#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "gateway/app/run/start_argument.hpp"
#include "gateway/line/heads/head_scan.hpp"
#include "gateway/line/text_source.hpp"

namespace dripline::gateway {

/// Looks through a program for the place where a run begins, and for what has to be sent before it.
/// The text may come while it works. One thread.
class SerialStart {
 public:
  struct Program {
    std::string control;
    std::uint64_t size = 0;
  };
  /// Errors: Unsupported (a place or a choice that only an interpreter knows), Syntax.
  static Result<SerialStart> make(const StartArgument& argument, Program program);

  enum class State : std::uint8_t { Working, NeedsText, Ready, Failed };
  /// A bounded piece of work.
  State work(line::TextSource& text);
  bool is_ready() const { return state_ == State::Ready; }
  /// Why it failed, for people.
  const std::string& fault() const { return fault_; }
  std::uint64_t looked_at() const { return at_; }
  // When it is ready.
  const line::ProgramPlace& place() const { return place_; }
  const std::string& head() const { return head_; }

 private:
  SerialStart(const line::WantedPlace& wanted, line::HeadChoice choice, Program program)
      : wanted_(wanted),
        choice_(choice),
        program_(std::move(program)),
        finder_(wanted, program_.control) {
    if (wanted.is_beginning()) state_ = State::Ready;
  }
  bool take(std::string_view piece);
  State find_end(bool is_found);
  State scan_end();
  State fail_with(std::string fault);

  line::WantedPlace wanted_;
  line::HeadChoice choice_;
  Program program_;
  line::PlaceFinder finder_;
  std::optional<line::HeadScan> scan_;  ///< none: the place is not found yet
  State state_ = State::Working;
  std::uint64_t at_ = 0;
  line::ProgramPlace place_;
  std::string head_, fault_;
};

}  // namespace dripline::gateway
