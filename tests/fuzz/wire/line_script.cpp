#include "tests/fuzz/wire/line_script.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace dripline::fuzz {
namespace {

using wire::LineTime;

void require(bool is_true, const char* what) {
  if (is_true) return;
  std::fprintf(stderr, "line script: %s\n", what);
  std::abort();
}

/// The script's bytes, one decision after the other; zeros after its end.
class Script {
 public:
  explicit Script(std::span<const std::byte> bytes) : bytes_(bytes) {}
  bool is_over() const { return bytes_.empty(); }
  unsigned next() {
    if (bytes_.empty()) return 0;
    const auto value = static_cast<unsigned>(bytes_.front());
    bytes_ = bytes_.subspan(1);
    return value;
  }
  std::span<const std::byte> take(std::size_t count) {
    const auto taken = bytes_.first(std::min(count, bytes_.size()));
    bytes_ = bytes_.subspan(taken.size());
    return taken;
  }

 private:
  std::span<const std::byte> bytes_;
};

class Player {
 public:
  Player(const wire::LineSettings& settings, wire::Role role, bool is_cut)
      : line_(wire::make_discipline(settings, role).value()), is_cut_(is_cut) {}

  /// All events and everything sent, as text.
  std::string play(Script script) {
    for (unsigned steps = 0; !script.is_over() && steps < 2000; ++steps) step(script);
    return std::move(log_);
  }

 private:
  void step(Script& script) {
    const unsigned what = script.next();
    switch (what % 12) {
      case 0:
      case 1:
      case 2:
        hear(script.take(script.next() % 64));
        break;
      case 3:
        line_->fault(static_cast<wire::LineFault>(script.next() % 4), now_);
        break;
      case 4: {
        const unsigned bits = script.next();
        line_->lines({(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0}, now_);
        break;
      }
      case 5:
        pass_time(script.next());
        break;
      case 6:
        transmit(script.next() % 40);
        break;
      case 7:
        begin(script.next());
        break;
      case 8:
        offer(script);
        break;
      case 9:
        line_->set_ready(what < 128, now_);
        break;
      case 10:
        ask(script.next());
        break;
      default:
        if (what > 200) line_->abort(now_);
        transmit(2);
        break;
    }
    take_events();
    check();
  }

  void hear(std::span<const std::byte> characters) {
    if (!is_cut_) return line_->receive(characters, now_);
    for (const auto& character : characters) line_->receive({&character, 1}, now_);
  }

  /// To the next deadline, or a while on.
  void pass_time(unsigned how) {
    const auto deadline = line_->deadline();
    if (how % 2 == 0 && deadline) {
      now_ = std::max(now_, *deadline);
    } else {
      now_ += std::chrono::milliseconds(how * how / 4);
    }
    for (unsigned tries = 0; due(); ++tries) {
      require(tries < 1000, "a deadline that has passed is never moved");
      line_->tick(now_);
      transmit(64);
    }
  }
  bool due() const {
    const auto deadline = line_->deadline();
    return deadline && *deadline <= now_;
  }

  void transmit(std::size_t count) {
    std::array<std::byte, 64> room{};
    const auto sent = line_->transmit(std::span(room).first(count), now_);
    require(sent <= count, "more was sent than there is room for");
    for (const auto byte : std::span(room).first(sent)) {
      log_ += '>';
      log_ += static_cast<char>(byte);
    }
  }

  void begin(unsigned how) {
    const char* names[] = {"", "7", "N2", "%"};
    const auto name = names[how / 2 % 4];
    note(how % 2 == 0 ? line_->begin_send(name, now_) : line_->begin_receive(name, now_));
  }

  void offer(Script& script) {
    const unsigned how = script.next();
    static constexpr std::array<const char*, 8> kPieces{
        "N1G1X7\n", "%\n",  "0 BEGIN PGM 7 MM\n", "2 END PGM 7 MM\n", "", "N3 (A",
        "O0007\n",  "M30\n"};
    note(line_->offer(kPieces[how % kPieces.size()], how > 200, now_));
  }

  void ask(unsigned how) {
    using Kind = wire::TransferRequest::Kind;
    if (how % 4 == 3) return note(line_->refuse(how > 100 ? "no such program" : "", now_));
    note(line_->request({static_cast<Kind>(how % 3), how > 100 ? "7" : ""}, now_));
  }

  void note(const Result<void>& result) { log_ += result ? "|ok" : "|" + result.error().what; }

  void take_events() {
    for (const auto& event : line_->take_events()) {
      if (const auto* text = std::get_if<wire::TextReceived>(&event)) {
        if (!was_text_) log_ += "|text ";
        log_ += text->text;
        was_text_ = true;
        continue;
      }
      was_text_ = false;
      log_ += "|" + std::to_string(event.index());
      if (const auto* failed = std::get_if<wire::TransferFailed>(&event))
        log_ += failed->error.what;
      if (const auto* error = std::get_if<wire::LineError>(&event)) log_ += error->error.what;
      if (const auto* asked = std::get_if<wire::TransferRequest>(&event)) log_ += asked->name;
    }
  }

  void check() const {
    require(line_->room() <= std::size_t{64} * 1024, "more room than is ever kept");
    const auto state = line_->state();
    require(line_->room() == 0 || state.phase == wire::Phase::Sending,
            "room while nothing is sent");
  }

  std::unique_ptr<wire::Discipline> line_;
  bool is_cut_;
  LineTime now_{};
  std::string log_;
  bool was_text_ = false;
};

}  // namespace

void play_line_script(const wire::LineSettings& settings, wire::Role role,
                      std::span<const std::byte> script) {
  const auto whole = Player(settings, role, false).play(Script(script));
  const auto cut = Player(settings, role, true).play(Script(script));
  require(whole == cut, "characters one by one give other events");
}

}  // namespace dripline::fuzz
