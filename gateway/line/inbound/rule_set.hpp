#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace re2 {
class RE2;
}

namespace dripline::line {

enum class RuleAction : std::uint8_t {
  Send,       ///< a program to the control
  Directory,  ///< the list of programs to the control
  Restart,    ///< the machine's last run, from a block on
  NextJob,    ///< a run of the next job in the machine's queue
  Program,    ///< store the text as a new revision, held for acceptance
  Report,     ///< store the line as a record
  Ignore,
};
std::string_view to_string(RuleAction action);

/// What a control sends is either a program or single lines that it prints.
enum class TextKind : std::uint8_t { Program, Line };

/// One rule of a port's rules file: it fires when everything it names is there.
struct Rule {
  std::string name;     ///< "set/rule"
  std::string program;  ///< the program's name, "O9999"; only programs have one. Empty: any text
  std::string trigger;  ///< a comment's key
  std::shared_ptr<const re2::RE2> matches;  ///< found anywhere in a line; linear time
  std::optional<TextKind> kind;
  RuleAction action = RuleAction::Ignore;
  std::string argument = "{}";  ///< `{}`: the trigger's value, or what `matches` matched
  bool is_probe = false;        ///< Report: a probe's result, no output
};

/// What is to be done with a text.
struct RuleHit {
  const Rule* rule = nullptr;  ///< null: no rule fired, this is the default
  RuleAction action = RuleAction::Report;
  std::string argument;
  bool is_probe = false;
};

/// Which rule of a port's rules file a received text meets, and what would be done.
struct RuleVerdict {
  std::string rule;              ///< its name; empty: none, the default
  std::string action;            ///< send, directory, restart, program, report, ignore
  std::string argument;          ///< program, file name, block ...
  std::vector<std::string> why;  ///< one line per rule that was tried, in order
};

/// The rules of one port, in order; the first that fires decides. Without one a program is stored
/// and a line is reported. Immutable; any thread.
class RuleSet {
 public:
  static constexpr std::size_t kMaxRules = 64;
  RuleSet() = default;
  RuleSet(std::vector<Rule> rules, std::string reply)
      : rules_(std::move(rules)), reply_(std::move(reply)) {}

  /// At most the first kProgramHead bytes of a text are looked at. `why`, where given, gets one
  /// line for every rule looked at.
  RuleHit judge(TextKind kind, std::string_view text,
                std::vector<std::string>* why = nullptr) const;
  /// For people: cuts the text as it would be on the line and judges it, program or line by line.
  /// `extracts`: as InboundSplitter's.
  RuleVerdict explain(const std::string& text, bool extracts = false) const;

  /// The program number that answers to the control bear ("O9998"); empty: it gets none.
  const std::string& reply() const { return reply_; }
  std::size_t size() const { return rules_.size(); }

 private:
  std::vector<Rule> rules_;
  std::string reply_;
};

}  // namespace dripline::line
