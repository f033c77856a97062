#pragma once

#include <memory>
#include <string>

#include "server/library/control_words.hpp"
#include "server/serial/line_directory.hpp"
#include "server/serial/rule_set.hpp"
#include "server/serial/serial_feed.hpp"

namespace dripline::ports {

/// Does what an operator asks for from the control: sends a program, lists them, begins the last
/// run again at a block. What can not be done is said to the control where it can show it: a
/// refused request, or a program of comments when the rules name one. On the machine's strand.
class CallDesk {
 public:
  /// A control that asks for "the next program" after this begins with the first one again.
  static constexpr std::chrono::seconds kOfferLife{60};

  struct Parts {
    storage::Store& store;
    SerialFeed& feed;
    const LineDirectory& directory;
    const Clock& clock;
    std::string machine;
    std::shared_ptr<const RuleSet> rules;
  };
  explicit CallDesk(Parts parts) : parts_(std::move(parts)) {}

  /// Send, Directory or Restart.
  void carry_out(RuleAction action, const std::string& argument);
  /// The protocol's own way to ask.
  void answer(const wire::TransferRequest& request);
  /// Short messages to the control, as a program; nothing when the rules name no program for it.
  void report(const std::vector<std::string>& words) const;

 private:
  void send(const std::string& name, bool is_request);
  void restart(const std::string& block);
  void send_listing(bool is_request);
  void send_next();
  /// `refusal`: what the control has a message of its own for.
  void say_no(const std::string& why, bool is_request,
              library::Refusal refusal = library::Refusal::None) const;
  void send_answer(std::string name, std::string text) const;
  void put_on_line(SendJob job) const;
  SerialFeed::Started on_started(bool is_request) const;
  /// The library's name for what the control calls `name`. Errors: NotFound.
  Result<std::string> find_program(const std::string& name) const;
  std::string control() const;

  Parts parts_;
  /// Of a control that asks for one program after the other (its directory, all programs).
  std::vector<storage::Revision> offered_;
  std::size_t next_offered_ = 0;
  SteadyTime offered_at_{};
};

}  // namespace dripline::ports
