#include "gateway/machine/linuxcnc/linuxcnc_machine.hpp"

#include <utility>

#include "gateway/machine/linuxcnc/command_writer.hpp"
#include "gateway/machine/linuxcnc/helper_link.hpp"

namespace dripline::machine::linuxcnc {

namespace {

constexpr MotionCapabilities kCapabilities{.axes = {},
                                           .arcs = true,
                                           .threads = false,
                                           .spindle_feedback = false,
                                           .probing = true,
                                           .feed_override = true,
                                           .rapid_override = true,
                                           .spindle_override = true,
                                           .single_block = true,
                                           .handwheel = false,
                                           .simulated_time = false,
                                           .places_axes = false,
                                           .tool_lengths = true,
                                           .adds_lengths = true,
                                           .jog = true};

std::unique_ptr<streamed::CommandWriter> make_commands() {
  return std::make_unique<LinuxCncCommands>();
}

}  // namespace

LinuxCncMachine::LinuxCncMachine(const Settings& settings)
    : LinuxCncMachine(settings, std::make_unique<Session>(settings.limits)) {}

LinuxCncMachine::LinuxCncMachine(Settings settings, std::unique_ptr<Session> session)
    : StreamedMachine({.sink = settings.sink,
                       .clock = std::move(settings.clock),
                       .make_commands = make_commands,
                       .machine = settings.machine,
                       .capabilities = kCapabilities},
                      *session),
      session_(std::move(session)) {}

LinuxCncMachine::~LinuxCncMachine() {
  link_.reset();  // its thread uses this object, which is whole until here
}

void LinuxCncMachine::connect(const std::string& ini) {
  link_ = std::make_unique<HelperLink>(*this, ini);
}

void LinuxCncMachine::wake() {
  if (link_) link_->wake();
}

void LinuxCncMachine::link_opened() {
  const Lock lock = lock_device();
  session_->opened(now());
}

void LinuxCncMachine::link_lost(const std::string& reason) {
  const Lock lock = lock_device();
  session_->lost(reason);
}

LinuxCncMachine::Outgoing LinuxCncMachine::exchange(std::span<const std::byte> bytes, bool is_dry) {
  const Lock lock = lock_device();
  if (!bytes.empty()) session_->receive(bytes, now());
  pump(lock);
  session_->tick(now(), is_dry);
  return {.text = session_->take_text(),
          .commands = session_->take_commands(),
          .wants_feed = session_->wants_feed(),
          .has_feed = session_->has_feed(),
          .is_reading = session_->is_reading(),
          .reopen_reason = session_->reopen_reason()};
}

void LinuxCncMachine::feed_opened(const std::string& path) {
  const Lock lock = lock_device();
  session_->feed_opened(path, now());
}

void LinuxCncMachine::link_closing() {
  const Lock lock = lock_device();
  forbid(lock);
}

}  // namespace dripline::machine::linuxcnc
