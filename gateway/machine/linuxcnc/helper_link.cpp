#include "gateway/machine/linuxcnc/helper_link.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <array>
#include <chrono>
#include <filesystem>
#include <optional>
#include <span>

#include "gateway/machine/linuxcnc/helper_process.hpp"
#include "gateway/machine/linuxcnc/linuxcnc_machine.hpp"
#include "gateway/machine/linuxcnc/program_fifo.hpp"
#include "protocol/base/invariant.hpp"

namespace dripline::machine::linuxcnc {

using namespace std::chrono_literals;

namespace {

constexpr auto kStartAgain = 1000ms;
/// How long LinuxCNC does nothing but wait for a line: as long as it takes to write an empty one.
constexpr int kFeedTickMs = 2, kTickMs = 20;

/// The helper and the FIFO that are open now.
class Wires {
 public:
  explicit Wires(LinuxCncMachine& machine) : machine_(machine) {}

  bool has_helper() const { return helper_.has_value(); }
  bool has_feed() const { return fifo_.has_value(); }
  int descriptor() const { return helper_ ? helper_->descriptor() : -1; }

  void start(const std::string& ini) {
    auto helper = HelperProcess::start(ini);
    if (!helper) return lose(helper.error().what);
    helper_.emplace(*std::move(helper));
    machine_.link_opened();
  }
  void lose(const std::string& reason) {
    machine_.link_lost(reason);
    helper_.reset();
    commands_.clear();
  }
  /// Returns why the helper is lost, or nothing.
  std::string exchange() {
    std::string received;
    const bool lives = !helper_ || helper_->read(received);
    const bool is_dry = fifo_ && fifo_->is_dry();
    auto out = machine_.exchange(std::as_bytes(std::span(received)), is_dry);
    if (!out.wants_feed) fifo_.reset();
    if (fifo_ && out.has_feed) fifo_->write(out.text);
    if (fifo_ && out.is_reading) fifo_->remove_name();
    commands_ += out.commands;
    const bool takes = !helper_ || helper_->write(commands_);
    if (out.wants_feed && !out.has_feed) open_feed();
    if (!out.reopen_reason.empty()) return out.reopen_reason;
    return lives && takes ? "" : "the helper has ended";
  }

 private:
  void open_feed() {
    auto fifo = ProgramFifo::create();
    if (!fifo) return lose(fifo.error().what);
    fifo_.reset();
    fifo_.emplace(*std::move(fifo));
    machine_.feed_opened(fifo_->path());
  }

  LinuxCncMachine& machine_;
  std::optional<HelperProcess> helper_;
  std::optional<ProgramFifo> fifo_;
  std::string commands_;
};

}  // namespace

Result<void> check_ini_path(const std::string& path) {
  if (path.empty()) return fail(Errc::Syntax, "the INI file of the running LinuxCNC is missing");
  std::error_code fault;
  if (std::filesystem::is_regular_file(path, fault)) return {};
  return fail(Errc::NotFound, "{} is no file: name the INI file of the running LinuxCNC", path);
}

HelperLink::HelperLink(LinuxCncMachine& machine, std::string ini)
    : machine_(machine), ini_(std::move(ini)), wake_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  invariant(static_cast<bool>(wake_), "an eventfd");
  thread_ = std::thread(&HelperLink::run, this);
}

HelperLink::~HelperLink() {
  stops_ = true;
  wake();
  thread_.join();
}

void HelperLink::wake() {
  const std::uint64_t one = 1;
  (void)!::write(wake_.get(), &one, sizeof one);
}

void HelperLink::run() {
  Wires wires(machine_);
  auto next_start = std::chrono::steady_clock::now();
  while (!stops_) {
    if (!wires.has_helper() && std::chrono::steady_clock::now() >= next_start) {
      next_start = std::chrono::steady_clock::now() + kStartAgain;
      wires.start(ini_);
    }
    std::array<pollfd, 2> entries{pollfd{wake_.get(), POLLIN, 0},
                                  pollfd{wires.descriptor(), POLLIN, 0}};
    (void)::poll(entries.data(), entries.size(), wires.has_feed() ? kFeedTickMs : kTickMs);
    std::uint64_t count = 0;
    (void)!::read(wake_.get(), &count, sizeof count);
    if (const std::string reason = wires.exchange(); !reason.empty()) wires.lose(reason);
  }
  // The helper aborts what it has begun when its socket closes.
  machine_.link_closing();
}

}  // namespace dripline::machine::linuxcnc
