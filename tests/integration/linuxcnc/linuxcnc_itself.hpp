#pragma once

#include <gtest/gtest.h>
#include <fstream>
#include <optional>
#include <thread>

#include "gateway/machine/linuxcnc/helper_process.hpp"
#include "gateway/machine/linuxcnc/helper_reply.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::integration {

/// LinuxCNC as it executes a program file by itself: its own interpreter, without the back end.
class LinuxCncItself {
 public:
  explicit LinuxCncItself(const std::string& ini)
      : helper_(std::move(machine::linuxcnc::HelperProcess::start(ini).value())) {}

  /// The machine is on and homed, and executes nothing.
  void run(const std::string& text, std::chrono::milliseconds limit = test_support::kPatience) {
    const std::string file = folder_.path() / fmt::format("p{}.ngc", ++number_);
    std::ofstream(file) << text;
    status_.reset();
    done_ = 0;
    messages_.clear();
    std::string command =
        fmt::format("{{\"n\":{},\"do\":\"run\",\"file\":\"{}\"}}\n", number_, file);
    ASSERT_TRUE(helper_.write(command));
    // It is read before anything moves: reading, and then idle again.
    bool has_begun = false;
    ASSERT_TRUE(test_support::eventually(
        [&] {
          take(has_begun);
          return has_begun && rests();
        },
        limit))
        << messages_ << text;
    EXPECT_EQ(messages_, "") << text;
  }
  bool is_adaptive() const { return status_ && status_->is_adaptive; }

 private:
  using InterpreterState = machine::linuxcnc::InterpreterState;

  bool rests() const {
    return status_ && status_->interpreter == InterpreterState::Idle && status_->queue == 0 &&
           status_->is_in_position;
  }
  void take(bool& has_begun) {
    std::string received;
    ASSERT_TRUE(helper_.read(received)) << "the helper has ended";
    for (const auto& line : lines_.feed(std::as_bytes(std::span(received)))) {
      const auto reply = machine::linuxcnc::parse_helper_reply(line);
      if (const auto* done = std::get_if<machine::linuxcnc::DoneReply>(&reply)) {
        done_ = done->number;
        messages_ += done->problem;
      } else if (const auto* message = std::get_if<machine::linuxcnc::MessageReply>(&reply)) {
        if (message->is_error()) messages_ += message->text;
      } else if (const auto* status = std::get_if<machine::linuxcnc::StatusReply>(&reply)) {
        status_ = *status;
        has_begun |= status_->interpreter != InterpreterState::Idle || done_ == number_;
      }
    }
  }

  test_support::TemporaryFolder folder_;
  machine::linuxcnc::HelperProcess helper_;
  machine::linuxcnc::HelperLines lines_;
  std::optional<machine::linuxcnc::StatusReply> status_;
  std::string messages_;
  std::uint64_t number_ = 0, done_ = 0;
};

}  // namespace dripline::integration
