#include "gateway/machine/grbl/grbl_machine.hpp"

#include <utility>

#include "gateway/machine/grbl/board_link.hpp"
#include "gateway/machine/grbl/command_writer.hpp"

namespace dripline::machine::grbl {

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
  return std::make_unique<BoardCommands>();
}

}  // namespace

GrblMachine::GrblMachine(const Settings& settings)
    : GrblMachine(settings, std::make_unique<BoardSession>(settings.limits)) {}

GrblMachine::GrblMachine(const Settings& settings, std::unique_ptr<BoardSession> session)
    : StreamedMachine({.sink = settings.sink,
                       .clock = settings.clock,
                       .make_commands = make_commands,
                       .machine = settings.machine,
                       .capabilities = kCapabilities},
                      *session),
      tool_change_(StreamedMachine::events()),
      session_(std::move(session)) {}

GrblMachine::~GrblMachine() {
  link_.reset();  // its thread uses this object, which is whole until here
}

void GrblMachine::connect(const std::string& address) {
  link_ = std::make_unique<BoardLink>(*this, address);
}

void GrblMachine::wake() {
  if (link_) link_->wake();
}

void GrblMachine::line_opened() {
  const Lock lock = lock_device();
  session_->opened(now());
}

void GrblMachine::line_lost(const std::string& reason) {
  const Lock lock = lock_device();
  session_->lost(reason);
}

BoardOutput GrblMachine::exchange(std::span<const std::byte> bytes) {
  const Lock lock = lock_device();
  if (!bytes.empty()) session_->receive(bytes, now());
  session_->tick(now());
  pump(lock);
  return session_->take_output();
}

void GrblMachine::line_closing() {
  const Lock lock = lock_device();
  forbid(lock);
  session_->stop_jog(now());
  session_->stop_homing(now());
  if (!session_->is_empty()) session_->hold(now());
}

std::string GrblMachine::reopen_reason() const {
  const Lock lock = lock_device();
  return session_->wants_reopen() ? session_->not_ready() : std::string();
}

bool GrblMachine::may_open() const {
  const Lock lock = lock_device();
  return session_->may_open();
}

void GrblMachine::begin(const interpreter::Position& at) {
  StreamedMachine::begin(at);
  tool_change_.begin();
}

void GrblMachine::begin_probe(const interpreter::Probe& probe) {
  tool_change_.before_motion(probe.origin);
  StreamedMachine::begin_probe(probe);
}

}  // namespace dripline::machine::grbl
