#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gateway/line/inbound/inbound_splitter.hpp"
#include "gateway/line/inbound/rule_set.hpp"
#include "gateway/line/line_session.hpp"

namespace dripline::line {

/// A line that a control printed.
struct PrintedLine {
  /// Control characters other than TAB are escaped; one that is not whole ends with kCutLine, one
  /// that may be of an earlier transmission with kRestLine, before that.
  std::string text;
  bool is_probe = false;
};

/// Where what a control sends belongs.
class InboundSink {
 public:
  virtual ~InboundSink() = default;
  /// Every text from this control is a program: it prints nothing.
  virtual bool sends_programs_only() const = 0;
  /// Whether what comes in may be a program.
  virtual void note_kind(bool may_be_program) = 0;
  /// `kept` is called once they are where they stay.
  virtual void print(std::vector<PrintedLine> lines, std::function<void()> kept) = 0;

  virtual void begin_program() = 0;
  virtual void add_text(const std::string& text) = 0;
  /// Part of the program was received damaged.
  virtual void damage(const std::string& how) = 0;
  /// It is complete. `name` as a rule, the protocol or its own text has it; may be empty.
  virtual void store_program(const std::string& name) = 0;
  virtual void drop_program() = 0;
  /// It is not complete, and dropped.
  virtual void cut_off_program(const std::string& /*why*/) { drop_program(); }

  /// To monitors of the line.
  virtual void note(const std::string& words) = 0;
  /// What was requested at the control; the line is free.
  virtual void carry_out(RuleAction action, const std::string& argument) = 0;
  /// Words for the control, where its rules define how; the line is free.
  virtual void answer(const std::string& words) = 0;
};

/// Sorts everything a control sends by the port's rules: printed lines, programs, requests. One
/// thread.
class InboundRouter {
 public:
  /// The sink must outlive it.
  InboundRouter(std::shared_ptr<const RuleSet> rules, bool extracts_programs, InboundSink& sink)
      : rules_(std::move(rules)), splitter_(*rules_, extracts_programs), sink_(sink) {}

  /// `kept` is called when the text is stored, or needs not be.
  void take(const Incoming& incoming, std::function<void()> kept);
  /// To monitors, and to the control at the end of the transfer that comes in.
  void report(const std::string& words);
  /// The same from outside; now, if nothing comes in.
  void tell(const std::string& words);

 private:
  struct Call {
    RuleAction action = RuleAction::Ignore;
    std::string argument;
  };
  std::vector<InboundSplitter::Item> split(const Incoming& incoming);
  void handle(InboundSplitter::Item& item, std::vector<PrintedLine>& lines);
  void handle_line(const InboundSplitter::Item& line, std::vector<PrintedLine>& lines);
  void begin_program(const std::string& name);
  void end_program(const std::string& head);
  void call(RuleAction action, const std::string& argument);
  void do_calls();

  const std::shared_ptr<const RuleSet> rules_;
  InboundSplitter splitter_;
  InboundSink& sink_;
  bool has_program_ = false;
  std::string program_name_;  ///< as the protocol carried it
  bool is_in_transfer_ = false;
  std::string failure_;        ///< why the transfer that comes in has failed
  std::string early_damage_;   ///< since the last program began; the next may begin after it
  std::vector<Call> waiting_;  ///< for the end of the transfer they came in; at most kMaxWaiting
};

}  // namespace dripline::line
