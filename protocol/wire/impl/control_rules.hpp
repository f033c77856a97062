#pragma once

#include <memory>
#include <string>

#include "protocol/wire/discipline.hpp"

namespace dripline::wire {

/// The destination of received text.
class TextSink {
 public:
  virtual ~TextSink() = default;
  virtual void text(std::string_view text) = 0;
  virtual void report(Error error) = 0;
  /// The delivered text is a program; the following text is the next one.
  virtual void next_program(std::string name) = 0;
};

/// The rules of one control for the characters of a program: it drops, refuses and splits as the
/// real one does, and reports errors in its words. The base is an end without rules.
class ControlRules {
 public:
  virtual ~ControlRules() = default;
  virtual void begin() {}
  /// One character of the text. Errors: the reception fails.
  virtual Result<void> take(char character, TextSink& sink) {
    sink.text({&character, 1});
    return {};
  }
  /// The reception is complete.
  virtual void finish(TextSink& /*sink*/) {}
  /// A control character that ends the program besides the line's end character.
  virtual bool ends_at(char /*character*/) const { return false; }
  /// The control's error for it, which ends the reception; nullopt: '?' replaces the character.
  virtual std::optional<Error> fault(LineFault /*fault*/) const { return std::nullopt; }
  /// More than `limit` characters came after it stopped the host. nullopt: it accepts them all.
  virtual std::optional<Error> overrun(unsigned /*limit*/) const { return std::nullopt; }
  /// The other end's DTR went off.
  virtual std::optional<Error> not_ready() const { return std::nullopt; }
  /// Its own sending failed.
  virtual Error sending_failed(Error error) const { return error; }
  /// A reception is requested while one is in progress.
  virtual Error busy() const { return {Errc::Busy, "the line is receiving"}; }
  /// Whether a reception can begin with these settings. Errors: Unsupported.
  virtual Result<void> check_begin() const { return {}; }
};

/// A host has no rules of a control.
std::unique_ptr<ControlRules> make_rules(const LineSettings& settings, Role role);
std::unique_ptr<ControlRules> make_prototrak_rules();
std::unique_ptr<ControlRules> make_centurion_rules(const ControlSettings& settings);

std::string_view fault_text(LineFault fault);

}  // namespace dripline::wire
