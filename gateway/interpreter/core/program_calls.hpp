#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "gateway/interpreter/core/language/line_reader.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter {

/// A call of another program, as a text has it. Branches that a run may not take are part of it.
struct ProgramCall {
  std::string name;           ///< the control's ("O0002", "2", "pocket"); empty: a run computes it
  std::string earlier = {};   ///< a name that the control looks for before `name`; often empty
  std::uint64_t line = 0;     ///< of the first such call
  bool is_contained = false;  ///< the text has such a program too, and a run takes that without one
  friend bool operator==(const ProgramCall&, const ProgramCall&) = default;
};

struct ProgramCalls {
  std::vector<ProgramCall> calls;  ///< each name once, in the order of their lines
  /// Programs that the text itself has. Where it was started, a call of one does not leave it.
  std::set<std::string> contained;
};

/// The other programs that a text of the source calls, found without executing it: `source` must
/// hold all of it. Setups bind codes to programs. Errors: those of the control's options, Syntax
/// (text whose end of block is not known), LimitExceeded.
using CallReader = Result<ProgramCalls> (*)(const Setup& setup, ProgramSource& source,
                                            ProgramIndex program);

/// Adds calls without repeating them.
class CallCollector {
 public:
  /// Different calls of one text; a text with more is refused.
  static constexpr std::size_t kMaxCalls = 1024;

  void add(ProgramCall call);
  void add_contained(std::string name) { found_.contained.insert(std::move(name)); }
  bool contains(const std::string& name) const { return found_.contained.contains(name); }
  /// Errors: LimitExceeded.
  Result<ProgramCalls> take();

 private:
  ProgramCalls found_;
  std::set<std::string> names_;
};

/// The lines of a text, each ended with LF, for dialects that look at one at a time. The source
/// must outlive it.
class CallLines {
 public:
  CallLines(ProgramSource& source, ProgramIndex program);
  /// False: there are no more. Errors: Io (the source's), LimitExceeded (a line of nearly a
  /// window), Unsupported (the source does not hold all of the text).
  Result<bool> next();
  const char* begin() const { return line_.data(); }
  /// The LF.
  const char* end() const { return line_.data() + line_.size() - 1; }
  std::uint64_t number() const { return number_; }

 private:
  LineReader reader_;
  std::string line_;
  std::uint64_t number_ = 0;
};

}  // namespace dripline::interpreter
